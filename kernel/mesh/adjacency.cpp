// Faces are bucketed by their smallest vertex; within a bucket those with the same other two vertices are the same
// face.
#include "mesh/adjacency.h"

#include <algorithm>
#include <tuple>

#include "core/check.h"
#include "core/elements.h"

namespace kerf {

namespace {

struct Face {
    std::int32_t middle, high;  // the vertices above the smallest, ascending
    std::int64_t side;          // 4 x tetrahedron + opposite corner
};

std::array<std::int32_t, 3> sorted_corners(const Tetrahedron& tet, int face) {
    const auto& corner = tet_faces[static_cast<std::size_t>(face)];
    std::array<std::int32_t, 3> v = {tet[corner[0]], tet[corner[1]], tet[corner[2]]};
    std::sort(v.begin(), v.end());
    return v;
}

void join(TetMesh& mesh, const Face& a, const Face& b) {
    mesh.neighbours[a.side / 4][a.side % 4] = static_cast<std::int32_t>(b.side / 4);
    mesh.neighbours[b.side / 4][b.side % 4] = static_cast<std::int32_t>(a.side / 4);
}

}  // namespace

void connect_tets(TetMesh& mesh) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    mesh.neighbours.assign(mesh.tets.size(), {-1, -1, -1, -1});
    std::vector<std::int64_t> first(mesh.vertices.size() + 1, 0);
    for (const Tetrahedron& tet : mesh.tets)
        for (int i = 0; i < 4; ++i) ++first[sorted_corners(tet, i)[0] + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<Face> faces(4 * mesh.tets.size());
    std::vector<std::int64_t> end(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        for (int i = 0; i < 4; ++i) {
            const auto v = sorted_corners(mesh.tets[t], i);
            faces[end[v[0]]++] = {v[1], v[2], static_cast<std::int64_t>(4 * t) + i};
        }
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
        const auto begin = faces.begin() + first[v], stop = faces.begin() + first[v + 1];
        std::sort(begin, stop, [](const Face& a, const Face& b) {
            return std::tie(a.middle, a.high, a.side) < std::tie(b.middle, b.high, b.side);
        });
        for (auto it = begin; it != stop;) {
            const auto same_face = [&](const Face& face) { return face.middle == it->middle && face.high == it->high; };
            const auto next = std::find_if_not(it, stop, same_face);
            if (next - it >= 2) join(mesh, *it, *(it + 1));
            it = next;
        }
    }
}

}  // namespace kerf
