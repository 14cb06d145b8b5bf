// Faces are bucketed by their smallest vertex; within a bucket those with the same other two vertices are the same
// face. A tetrahedron a < b < c < d has three faces in the bucket of a and one in that of b.
#include "mesh/adjacency.h"

#include <algorithm>

#include "core/check.h"
#include "core/elements.h"

namespace kerf {

namespace {

struct Face {
    std::uint64_t others;  // vertices above the smallest: the lower one in the upper half
    std::int64_t side;     // 4 x tetrahedron + opposite corner
    auto operator<=>(const Face&) const = default;
};

// 4 x vertex + its place in the tetrahedron.
using Corner = std::uint64_t;

std::size_t vertex_of(Corner corner) { return static_cast<std::size_t>(corner >> 2); }

// A network without branches: which corner is the smallest cannot be foretold.
std::array<Corner, 4> sorted_corners(const Tetrahedron& tet) {
    std::array<Corner, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = static_cast<Corner>(tet[i]) << 2 | i;
    const auto order = [&](std::size_t i, std::size_t j) {
        const Corner low = std::min(corners[i], corners[j]), high = std::max(corners[i], corners[j]);
        corners[i] = low;
        corners[j] = high;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
    return corners;
}

Face face_above_smallest(std::size_t t, Corner middle, Corner high, Corner opposite) {
    return {static_cast<std::uint64_t>(vertex_of(middle)) << 32 | vertex_of(high),
            static_cast<std::int64_t>(4 * t + (opposite & 3))};
}

void join(TetMesh& mesh, const Face& a, const Face& b) {
    mesh.neighbours[a.side / 4][a.side % 4] = static_cast<std::int32_t>(b.side / 4);
    mesh.neighbours[b.side / 4][b.side % 4] = static_cast<std::int32_t>(a.side / 4);
}

// Where the bucket of each vertex begins; last the number of all faces.
std::vector<std::int64_t> beginnings_of_buckets(const TetMesh& mesh) {
    std::vector<std::int64_t> first(mesh.vertices.size() + 1, 0);
    for (const Tetrahedron& tet : mesh.tets) {
        const std::array<Corner, 4> corners = sorted_corners(tet);
        first[vertex_of(corners[0]) + 1] += 3;
        first[vertex_of(corners[1]) + 1] += 1;
    }
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    return first;
}

std::vector<Face> faces_in_buckets(const TetMesh& mesh, const std::vector<std::int64_t>& first) {
    std::vector<Face> faces(4 * mesh.tets.size());
    std::vector<std::int64_t> end(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto [a, b, c, d] = sorted_corners(mesh.tets[t]);
        std::int64_t& at = end[vertex_of(a)];
        faces[at++] = face_above_smallest(t, b, c, d);
        faces[at++] = face_above_smallest(t, b, d, c);
        faces[at++] = face_above_smallest(t, c, d, b);
        faces[end[vertex_of(b)]++] = face_above_smallest(t, c, d, a);
    }
    return faces;
}

}  // namespace

void connect_tets(TetMesh& mesh) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    mesh.neighbours.assign(mesh.tets.size(), {-1, -1, -1, -1});
    const std::vector<std::int64_t> first = beginnings_of_buckets(mesh);
    std::vector<Face> faces = faces_in_buckets(mesh, first);
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
        const auto begin = faces.begin() + first[v], stop = faces.begin() + first[v + 1];
        std::sort(begin, stop);
        for (auto it = begin; it != stop;) {
            auto next = it + 1;
            while (next != stop && next->others == it->others) ++next;
            if (next - it >= 2) join(mesh, *it, *(it + 1));
            it = next;
        }
    }
}

}  // namespace kerf
