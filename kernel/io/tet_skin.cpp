#include "io/tet_skin.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "geometry/tetrahedron.h"
#include "mesh/faces.h"

namespace kerf {

namespace {

namespace skin {

Triangle face_of(const std::vector<Tetrahedron>& tets, const FaceSide& side) {
    const Tetrahedron& tet = tets[static_cast<std::size_t>(side.tet())];
    Triangle face{};
    for (std::size_t i = 0; i < 3; ++i) face[i] = tet[static_cast<std::size_t>(tet_faces[side.corner()][i])];
    return face;
}

bool is_negative(const std::vector<Vec3>& vertices, const Tetrahedron& tet) {
    return six_volumes_of(vertices, tet) < 0;
}

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

std::string names_text(const std::vector<std::string>& volumes) {
    constexpr std::size_t most = 4;
    const std::size_t told = std::min(volumes.size(), most);
    std::string text =
        fmt::format("'{}'", fmt::join(volumes.begin(), volumes.begin() + static_cast<int>(told), "', '"));
    if (told < volumes.size()) text += fmt::format(" and {} more", volumes.size() - told);
    return text;
}

}  // namespace skin

}  // namespace

std::vector<Triangle> skin_of(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets) {
    std::vector<FaceSide> sides;
    match_faces(
        vertices.size(), tets, [](const FaceSide&, const FaceSide&) {},
        [&](const FaceSide& side) { sides.push_back(side); });
    std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) { return a.code < b.code; });
    std::vector<Triangle> facets;
    facets.reserve(sides.size());
    for (const FaceSide& side : sides) {
        facets.push_back(skin::face_of(tets, side));
        if (skin::is_negative(vertices, tets[static_cast<std::size_t>(side.tet())]))
            std::swap(facets.back()[1], facets.back()[2]);
    }
    return facets;
}

std::optional<Wall> find_wall(std::size_t vertex_count, const std::vector<Tetrahedron>& tets,
                              const std::vector<std::int32_t>& volume_of_tet, const std::vector<Triangle>& facets) {
    std::vector<std::pair<Triangle, std::array<std::int32_t, 2>>> between;
    const auto pair = [&](const FaceSide& a, const FaceSide& b) {
        const auto [low, high] = std::minmax(volume_of_tet[static_cast<std::size_t>(a.tet())],
                                             volume_of_tet[static_cast<std::size_t>(b.tet())]);
        if (low != high) between.push_back({skin::sorted(skin::face_of(tets, a)), {low, high}});
    };
    match_faces(vertex_count, tets, pair, [](const FaceSide&) {});
    std::sort(between.begin(), between.end());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Triangle facet = skin::sorted(facets[f]);
        const auto found = std::lower_bound(between.begin(), between.end(), facet,
                                            [](const auto& face, const Triangle& t) { return face.first < t; });
        if (found != between.end() && found->first == facet) return Wall{static_cast<std::int32_t>(f), found->second};
    }
    return {};
}

std::string tell_skin(std::size_t tets, const std::vector<std::string>& volumes) {
    std::string text = fmt::format("There are no triangles: the surface is the skin of the {} tetrahedr{}", tets,
                                   tets == 1 ? "on" : "a");
    if (volumes.size() > 1)
        text += fmt::format(" of {} volumes, {}, which are one body where they touch", volumes.size(),
                            skin::names_text(volumes));
    return text + ".";
}

std::string tell_volumes(const std::vector<std::string>& volumes) {
    return fmt::format("{} volumes are read together: {}.", volumes.size(), skin::names_text(volumes));
}

std::string tell_wall(const std::string& volume, const std::string& other, const Vec3& where) {
    return fmt::format(
        "volumes '{}' and '{}' touch near ({:.9g}, {:.9g}, {:.9g}), but a surface has only one side inside. Save each "
        "in a file of its own, or, to join them, tetrahedra without triangles, whose skin is read then (Gmsh: physical "
        "groups of volumes alone). What lies inside of another volume is left out with --keep-largest.",
        volume, other, where.x(), where.y(), where.z());
}

}  // namespace kerf
