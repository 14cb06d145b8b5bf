// match_faces() (fill/mesh/faces.h) finds the one or two tetrahedra at each face, bucket by bucket. A face with two
// tetrahedra of different regions is a wall, one with a single tetrahedron is skin; faces between tetrahedra of one
// region are passed over, so that memory follows the surface. The tetrahedron of the smaller region, or the only one,
// is at the back, and its exact sign turns the face, because files have tetrahedra of both orientations. Both
// tetrahedra of a wall on the same side of it mean that two regions overlap. The faces are sorted by the code of their
// back side, tetrahedron and corner, so that their order does not depend on that of the search.
#include "files/io/inside/tet_skin.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "files/io/inside/tet_sign.h"
#include "fill/mesh/faces.h"

namespace kerf {

namespace {

namespace skin {

class Faces {
 public:
    Faces(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets,
          const std::vector<RegionIndex>& region_of_tet)
        : vertices_(vertices), tets_(tets), region_of_tet_(region_of_tet) {}

    RegionIndex region(const FaceSide& side) const {
        return region_of_tet_.empty() ? RegionIndex(0) : region_of_tet_[side.tet().value()];
    }
    // Returns the exact sign: a rounded one of a flat tetrahedron may tell the wrong side.
    int sign(const FaceSide& side) const { return tet_sign(vertices_, tet(side)); }
    // Returns the corners counter-clockwise seen from outside of the tetrahedron.
    Triangle outward(const FaceSide& side) const {
        Triangle face{};
        for (std::size_t i = 0; i < 3; ++i) face[i] = tet(side)[tet_faces[side.corner()][i]];
        if (sign(side) < 0) std::swap(face[1], face[2]);
        return face;
    }
    // Tells whether the tetrahedra of two sides of a face overlap. Nobody knows of tetrahedra without volume: false.
    bool are_on_same_side(const FaceSide& a, const FaceSide& b) const {
        const int sign_a = sign(a), sign_b = sign(b);
        if (sign_a == 0 || sign_b == 0) return false;
        return (a.is_turned() != (sign_a < 0)) == (b.is_turned() != (sign_b < 0));
    }

 private:
    const Tetrahedron& tet(const FaceSide& side) const { return tets_[side.tet().value()]; }

    const std::vector<Vec3>& vertices_;
    const std::vector<Tetrahedron>& tets_;
    const std::vector<RegionIndex>& region_of_tet_;
};

struct Face {
    FaceSide back;
    RegionIndex front;
};

std::string names_text(const std::vector<std::string>& names) {
    constexpr std::size_t most = 4;
    const std::size_t told = std::min(names.size(), most);
    std::string text = fmt::format("'{}'", fmt::join(names.begin(), names.begin() + told, "', '"));
    if (told < names.size()) text += fmt::format(" and {} more", names.size() - told);
    return text;
}

}  // namespace skin

}  // namespace

RegionFaces region_faces(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets,
                         const std::vector<RegionIndex>& region_of_tet) {
    const skin::Faces of_tets(vertices, tets, region_of_tet);
    RegionFaces found;
    std::vector<skin::Face> faces;
    const auto pair = [&](const FaceSide& a, const FaceSide& b) {
        const RegionIndex of_a = of_tets.region(a), of_b = of_tets.region(b);
        if (of_a == of_b) return;
        faces.push_back(of_a < of_b ? skin::Face{a, of_b} : skin::Face{b, of_a});
        if (!found.overlap && of_tets.are_on_same_side(a, b))
            found.overlap = {of_tets.outward(faces.back().back), {faces.back().front, std::min(of_a, of_b)}};
    };
    match_faces(vertices.size(), tets, pair, [&](const FaceSide& side) {
        faces.push_back({side, RegionIndex::none()});
    });
    std::sort(faces.begin(), faces.end(),
              [](const skin::Face& a, const skin::Face& b) { return a.back.code < b.back.code; });
    found.faces.reserve(faces.size());
    for (const skin::Face& face : faces)
        found.faces.push_back({of_tets.outward(face.back), {face.front, of_tets.region(face.back)}});
    return found;
}

std::string tell_skin(std::size_t tets) {
    return fmt::format("There are no triangles: the surface is the skin of the {} tetrahedr{}.", tets,
                       tets == 1 ? "on" : "a");
}

std::string tell_regions(const std::vector<std::string>& regions, std::size_t walls, std::size_t facets) {
    return fmt::format("There are {} regions, {}: {} of the {} facets {} between two of them.", regions.size(),
                       skin::names_text(regions), walls, facets, walls == 1 ? "is" : "are");
}

std::string tell_joined_volumes(std::size_t volumes, const std::string& region) {
    return fmt::format("{} volumes are one region, '{}'.", volumes, region);
}

std::string tell_overlap(const std::string& region, const std::string& other, const Vec3& where) {
    return fmt::format(
        "tetrahedra of the regions '{}' and '{}' overlap near ({:.9g}, {:.9g}, {:.9g}). Save the mesh with each "
        "tetrahedron once, in one of them.",
        region, other, where.x(), where.y(), where.z());
}

}  // namespace kerf
