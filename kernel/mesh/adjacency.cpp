// Faces are bucketed by their smallest vertex; within a bucket those with the same other two vertices are the same
// face, and meet in a small table. A tetrahedron a < b < c < d has three faces in the bucket of a and one in that of b.
// Never more buckets are filled at once than take as much memory as the tetrahedra.
#include "mesh/adjacency.h"

#include <algorithm>
#include <bit>

#include "core/check.h"
#include "core/elements.h"
#include "mesh/buckets.h"

namespace kerf {

namespace {

struct Face {
    std::uint64_t others;  // vertices above the smallest: the lower one in the upper half
    std::int64_t side;     // 4 x tetrahedron + opposite corner
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

void join(TetNeighbours& neighbours, const Face& a, const Face& b) {
    neighbours[a.side / 4][a.side % 4] = static_cast<std::int32_t>(b.side / 4);
    neighbours[b.side / 4][b.side % 4] = static_cast<std::int32_t>(a.side / 4);
}

// Joins the first two of those that are the same, found by a table of their places among `faces`.
void join_equal_faces(TetNeighbours& neighbours, std::span<const Face> faces, std::vector<std::int32_t>& table) {
    constexpr std::int32_t nobody = -1;
    constexpr std::uint64_t golden_ratio = 0x9E3779B97F4A7C15;  // times 2^64: its multiples spread evenly
    const std::size_t mask = std::bit_ceil(2 * faces.size()) - 1;
    table.assign(mask + 1, nobody);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Face& face = faces[i];
        std::size_t place = (face.others * golden_ratio) >> 32 & mask;
        while (table[place] != nobody && faces[static_cast<std::size_t>(table[place])].others != face.others)
            place = (place + 1) & mask;
        if (table[place] == nobody) {
            table[place] = static_cast<std::int32_t>(i);
            continue;
        }
        const Face& first = faces[static_cast<std::size_t>(table[place])];
        if (neighbours[first.side / 4][first.side % 4] == -1) join(neighbours, first, face);
    }
}

}  // namespace

TetNeighbours find_neighbours(const TetMesh& mesh) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    TetNeighbours neighbours(mesh.tets.size(), {-1, -1, -1, -1});
    const auto for_each_face = [&](const auto& take) {
        for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
            const auto [a, b, c, d] = sorted_corners(mesh.tets[t]);
            take(vertex_of(a), face_above_smallest(t, b, c, d));
            take(vertex_of(a), face_above_smallest(t, b, d, c));
            take(vertex_of(a), face_above_smallest(t, c, d, b));
            take(vertex_of(b), face_above_smallest(t, c, d, a));
        }
    };
    const std::size_t most_faces = mesh.tets.size() * sizeof(Tetrahedron) / sizeof(Face);
    std::vector<std::int32_t> table;
    visit_buckets<Face>(mesh.vertices.size(), most_faces, for_each_face,
                        [&](std::size_t, std::span<Face> faces) { join_equal_faces(neighbours, faces, table); });
    return neighbours;
}

}  // namespace kerf
