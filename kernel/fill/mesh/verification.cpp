// One pass over the cells tells whether all are positive, the sum of their volumes, and by a sum
// (fill/mesh/inside/boundary_chain.h) whether the surface is their boundary. Where all of that holds no face needs to
// be looked for. Each point inside lies in as many cells as the surface winds around it, that is in one; so at most two
// cells have a face, and from different sides.
//
// Else, and for a mesh that names its neighbours, broken laws are counted face by face. Interior faces: tetrahedron t
// and the one across its face i, n = neighbours[t][i], must name each other over a face with the same corners in
// opposite rotation. Two positive tetrahedra then lie on opposite sides of it. Boundary faces (neighbour -1) must be
// the facets of the surface. A mesh that names no neighbours has interior faces where two sides are the same face
// (fill/mesh/faces.h): they must be turned opposite ways. Boundary faces and facets are written with their smallest
// vertex first, which keeps the rotation, and sorted by three counting sorts, last corner first; equal ones then meet
// in a merge.
#include "fill/mesh/verification.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/predicates.h"
#include "base/geometry/tetrahedron.h"
#include "fill/mesh/faces.h"
#include "fill/mesh/inside/boundary_chain.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

namespace {

// A boundary face or a facet, with the number of its tetrahedron or its own.
struct OwnedFace {
    Triangle corners;
    std::int32_t owner;
};

Triangle corners_of_face(const Tetrahedron& tet, int face) {
    const auto& [i, j, k] = tet_faces[face];
    return {tet[i], tet[j], tet[k]};
}

Triangle smallest_first(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

// Whether both triangles have the same corners in opposite rotation.
bool opposite(const Triangle& s, const Triangle& t) {
    const auto& [a, b, c] = t;
    return s == Triangle{a, c, b} || s == Triangle{b, a, c} || s == Triangle{c, b, a};
}

std::vector<OwnedFace> sorted_by_corner(const std::vector<OwnedFace>& faces, int corner, std::size_t vertex_count) {
    std::vector<std::size_t> place(vertex_count + 1, 0);
    for (const OwnedFace& face : faces) ++place[face.corners[corner] + 1];
    for (std::size_t v = 0; v < vertex_count; ++v) place[v + 1] += place[v];
    std::vector<OwnedFace> sorted(faces.size());
    for (const OwnedFace& face : faces) sorted[place[face.corners[corner]]++] = face;
    return sorted;
}

std::vector<OwnedFace> sorted_faces(std::vector<OwnedFace> faces, std::size_t vertex_count) {
    for (int corner : {2, 1, 0}) faces = sorted_by_corner(faces, corner, vertex_count);
    return faces;
}

std::vector<OwnedFace> sorted_facets(const std::vector<Triangle>& facets, std::size_t vertex_count) {
    std::vector<OwnedFace> faces;
    faces.reserve(facets.size());
    for (std::int32_t f = 0; f < count_of(facets); ++f) faces.push_back({smallest_first(facets[f]), f});
    return sorted_faces(std::move(faces), vertex_count);
}

// The faces all of whose corners lie on the boundary: the boundary faces are among them.
std::vector<OwnedFace> sorted_faces_over_boundary(const TetMesh& mesh) {
    std::vector<OwnedFace> faces;
    for (const CellId t : mesh.tets.ids()) {
        const Tetrahedron& tet = mesh.tets[t];
        const auto is_inside = [&](std::int32_t v) { return v >= mesh.boundary_vertex_count; };
        if (std::count_if(tet.begin(), tet.end(), is_inside) > 1) continue;
        for (int i = 0; i < 4; ++i) {
            const Triangle face = corners_of_face(tet, i);
            if (std::none_of(face.begin(), face.end(), is_inside)) faces.push_back({smallest_first(face), t.value()});
        }
    }
    return sorted_faces(std::move(faces), mesh.boundary_vertex_count);
}

// Calls found(facet, face) for every facet that is a face, both sorted.
template <class Found>
void match_facets(const std::vector<OwnedFace>& facets, const std::vector<OwnedFace>& faces, Found found) {
    auto face = faces.begin();
    for (const OwnedFace& facet : facets) {
        while (face != faces.end() && face->corners < facet.corners) ++face;
        if (face == faces.end() || face->corners != facet.corners) continue;
        found(facet, *face);
        ++face;
    }
}

// Whether tetrahedron n names t over the same face as t names n.
bool names_back(const TetMesh& mesh, CellId n, CellId t, const Triangle& face) {
    for (int j = 0; j < 4; ++j)
        if (mesh.neighbours[n][j] == t && opposite(corners_of_face(mesh.tets[n], j), face)) return true;
    return false;
}

// Each pair of sides is looked at from the smaller tetrahedron only, because the other may lie far away in memory.
std::int64_t count_mismatched_neighbours(const TetMesh& mesh) {
    const CellId end(count_of(mesh.tets));
    std::int64_t inner_sides = 0, pairs = 0;
    for (const CellId t : mesh.tets.ids())
        for (int i = 0; i < 4; ++i) {
            const CellId n = mesh.neighbours[t][i];
            inner_sides += n != CellId::none();
            pairs += t < n && n < end && names_back(mesh, n, t, corners_of_face(mesh.tets[t], i));
        }
    return inner_sides - 2 * pairs;
}

// The boundary faces, and the count of wrong faces inside.
struct Faces {
    std::vector<OwnedFace> boundary;
    std::int64_t mismatched_sides = 0;  // sides of all other faces

    void add_boundary(const TetMesh& mesh, CellId t, int i) {
        boundary.push_back({smallest_first(corners_of_face(mesh.tets[t], i)), t.value()});
    }
};

Faces faces_as_named(const TetMesh& mesh) {
    Faces faces;
    for (const CellId t : mesh.tets.ids())
        for (int i = 0; i < 4; ++i)
            if (mesh.neighbours[t][i] == CellId::none()) faces.add_boundary(mesh, t, i);
    faces.mismatched_sides = count_mismatched_neighbours(mesh);
    return faces;
}

Faces faces_as_found(const TetMesh& mesh) {
    Faces faces;
    match_faces(
        mesh, [&](FaceSide a, FaceSide b) { faces.mismatched_sides += a.is_turned() == b.is_turned() ? 2 : 0; },
        [&](FaceSide side) { faces.add_boundary(mesh, side.tet(), side.corner()); });
    return faces;
}

std::int64_t count_moved_vertices(const TetMesh& mesh, const SurfaceArrays& surface) {
    const std::size_t counted = std::max(mesh.boundary_vertex_count, 0);
    const std::size_t common = std::min({counted, mesh.vertices.size(), surface.vertices.size()});
    std::int64_t moved = std::max(counted, surface.vertices.size()) - common;
    for (std::size_t v = 0; v < common; ++v) moved += mesh.vertices[v] != surface.vertices[v];
    return moved;
}

// Neumaier's compensated sum: millions of small volumes would lose digits in a plain one.
class CompensatedSum {
 public:
    void add(double term) {
        const double next = sum_ + term;
        compensation_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
        sum_ = next;
    }
    double value() const { return sum_ + compensation_; }

 private:
    double sum_ = 0, compensation_ = 0;
};

// Sums over all cells.
struct Cells {
    std::int64_t inverted = 0, without_volume = 0;
    double volume = 0, volume_error = 0;
    BoundaryChain boundary;
};

Cells sum_cells(const TetMesh& mesh) {
    // A determinant of rounded differences has the right sign if it is beyond its own error, which is below
    // (7 + 56 e) e times the sum of its six products (shewchuk1997), e = 2^-53, but for underflow.
    constexpr double doubt = 6 * 8 * 0x1p-53, underflow = 1e-290;
    Cells cells;
    CompensatedSum volume;
    double sum_of_largest = 0;
    for (const Tetrahedron& tet : mesh.tets) {
        const Vec3 &a = mesh.vertices[tet[0]], &b = mesh.vertices[tet[1]];
        const Vec3 &c = mesh.vertices[tet[2]], &d = mesh.vertices[tet[3]];
        const Vec3 u = b - a, v = c - a, w = d - a;
        const double det = u.cross(v).dot(w);
        const double largest = u.cwiseAbs().maxCoeff() * v.cwiseAbs().maxCoeff() * w.cwiseAbs().maxCoeff();
        const bool is_inverted = !(det > doubt * largest + underflow) && orientation(a, b, c, d) <= 0;
        cells.inverted += is_inverted;
        cells.without_volume += !is_inverted && !has_volume_in_any_order(a, b, c, d);
        volume.add(det);
        sum_of_largest += largest;
        cells.boundary.add(tet);
    }
    cells.volume = volume.value() / 6;
    const double count = mesh.tets.size();
    const double of_sum = 6 * count * count * 0x1p-106;  // error of a sum of terms of six products each
    cells.volume_error = 1.01 * ((doubt + of_sum) * sum_of_largest / 6 + 4 * 0x1p-53 * std::abs(cells.volume)) +
                         8 * (count + 1) * std::numeric_limits<double>::denorm_min();
    return cells;
}

BoundaryChain chain_of(const std::vector<Triangle>& facets) {
    BoundaryChain chain;
    for (const Triangle& facet : facets) chain.add(facet);
    return chain;
}

void count_broken_faces(const TetMesh& mesh, const SurfaceArrays& surface, MeshLaws& laws) {
    Faces faces = mesh.neighbours.empty() ? faces_as_found(mesh) : faces_as_named(mesh);
    const auto boundary_faces = std::ssize(faces.boundary);
    const std::size_t vertex_count = std::max(mesh.vertices.size(), surface.vertices.size());
    std::int64_t matched = 0;
    match_facets(sorted_facets(surface.facets, vertex_count), sorted_faces(std::move(faces.boundary), vertex_count),
                 [&](const OwnedFace&, const OwnedFace&) { ++matched; });
    laws.missing_facets = std::ssize(surface.facets) - matched;
    laws.extra_boundary_faces = boundary_faces - matched;
    laws.mismatched_neighbours = faces.mismatched_sides;
}

}  // namespace

bool MeshLaws::hold() const {
    const auto holds = [&](const MeshLaw& law) { return this->*law.count == 0; };
    return std::all_of(mesh_laws.begin(), mesh_laws.end(), holds) && std::abs(volume - surface_volume) <= volume_error;
}

MeshLaws verify_mesh(const TetMesh& mesh, const SurfaceArrays& surface, FaceProof proof) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    KERF_CHECK(are_in_range(surface.facets, surface.vertices.size()));
    KERF_CHECK(mesh.neighbours.empty() || mesh.neighbours.size() == mesh.tets.size());
    const Cells cells = sum_cells(mesh);
    MeshLaws laws;
    laws.inverted_tets = cells.inverted;
    laws.tets_without_volume = cells.without_volume;
    laws.moved_vertices = count_moved_vertices(mesh, surface);
    laws.volume = cells.volume;
    const BoundedVolume enclosed = bounded_volume(surface.vertices, surface.facets);
    laws.surface_volume = enclosed.value;
    laws.volume_error = cells.volume_error + enclosed.error;
    const bool is_proven =
        proof == FaceProof::sum && mesh.neighbours.empty() && laws.hold() && cells.boundary == chain_of(surface.facets);
    if (!is_proven) count_broken_faces(mesh, surface, laws);
    return laws;
}

std::vector<std::int32_t> tets_at_facets(const TetMesh& mesh, const std::vector<Triangle>& facets) {
    const std::size_t boundary = mesh.boundary_vertex_count;
    KERF_CHECK(are_in_range(facets, boundary));
    KERF_CHECK(are_in_range(mesh.tets, std::numeric_limits<std::int32_t>::max()));
    std::vector<std::int32_t> tet_at_facet(facets.size(), -1);
    match_facets(sorted_facets(facets, boundary), sorted_faces_over_boundary(mesh),
                 [&](const OwnedFace& facet, const OwnedFace& face) { tet_at_facet[facet.owner] = face.owner; });
    return tet_at_facet;
}

}  // namespace kerf
