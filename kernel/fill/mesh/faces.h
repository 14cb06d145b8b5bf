// The sides of tetrahedra that are the same face, matched.
//
// Faces are bucketed by their smallest vertex; within a bucket those with the same other two vertices are the same
// face, and meet in a small table. A tetrahedron a < b < c < d has three faces in the bucket of a and one in that of b.
// Never more buckets are filled at once than take as much memory as the tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "fill/mesh/buckets.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

/// One side of a face: the one on which a tetrahedron lies.
struct FaceSide {
    std::uint64_t code;  ///< 8 x tetrahedron + 2 x opposite corner + 1 if turned

    CellId tet() const { return CellId(code >> 3); }
    std::size_t corner() const { return code >> 1 & 3; }  ///< corner of the tetrahedron that is opposite to the face
    /// Returns whether the vertices in ascending order run clockwise, seen from outside of the tetrahedron as tet_faces
    /// has it. The two sides of a face between positive tetrahedra differ in this.
    bool is_turned() const { return code & 1; }
};

namespace detail {

struct KeyedSide {
    static constexpr std::uint64_t taken = ~std::uint64_t{0};
    std::uint64_t others;  // the two larger vertices: the lower one in the upper half
    FaceSide side;         // its code is `taken` once its other side is found
};

// The corners in ascending order, as 4 x vertex + place in the tetrahedron.
struct SortedCorners {
    std::array<std::uint64_t, 4> corners;
    std::uint64_t is_odd = 0;  // whether the permutation that has sorted them is odd

    explicit SortedCorners(const Tetrahedron& tet) {
        for (std::size_t i = 0; i < 4; ++i) corners[i] = static_cast<std::uint64_t>(tet[i]) << 2 | i;
        // A network without branches, which could not be predicted.
        order(0, 1);
        order(2, 3);
        order(0, 2);
        order(1, 3);
        order(1, 2);
    }
    std::size_t vertex(std::size_t i) const { return corners[i] >> 2; }
    // Returns the side of the face that has the middle and the high corner and a smaller one, and that is opposite to
    // the corner at the given place in the order.
    KeyedSide side(std::size_t tet, std::size_t middle, std::size_t high, std::size_t opposite) const {
        return {corners[middle] >> 2 << 32 | corners[high] >> 2,
                {tet << 3 | (corners[opposite] & 3) << 1 | ((is_odd ^ opposite) & 1)}};
    }

 private:
    void order(std::size_t i, std::size_t j) {
        const std::uint64_t low = std::min(corners[i], corners[j]), high = std::max(corners[i], corners[j]);
        is_odd ^= corners[i] != low;
        corners[i] = low;
        corners[j] = high;
    }
};

// Matches the sides of one bucket, by a hash table of the places at which they lie.
template <class Pair, class Single>
void match_sides(std::span<KeyedSide> sides, std::vector<std::int32_t>& table, const Pair& pair, const Single& single) {
    constexpr std::int32_t nobody = -1;
    constexpr std::uint64_t golden_ratio = 0x9E3779B97F4A7C15;  // times 2^64: its multiples spread evenly
    const std::size_t mask = std::bit_ceil(2 * sides.size()) - 1;
    table.assign(mask + 1, nobody);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        std::size_t place = (sides[i].others * golden_ratio) >> 32 & mask;
        while (table[place] != nobody && sides[table[place]].others != sides[i].others) place = (place + 1) & mask;
        if (table[place] == nobody) {
            table[place] = i;
            continue;
        }
        KeyedSide& first = sides[table[place]];
        if (first.side.code == KeyedSide::taken) continue;
        pair(first.side, sides[i].side);
        first.side.code = sides[i].side.code = KeyedSide::taken;
    }
    for (const KeyedSide& keyed : sides)
        if (keyed.side.code != KeyedSide::taken) single(keyed.side);
}

}  // namespace detail

/// Calls pair(a, b) for the first two sides of each face that two or more tetrahedra have, a before b, and single(a)
/// for all other sides. Requires vertex indices in range. O(#V + #T) for bounded vertex degrees. Memory: 16 bytes a
/// tetrahedron and 8 a vertex. Deterministic.
template <class Pair, class Single>
void match_faces(std::size_t vertex_count, const std::vector<Tetrahedron>& tets, const Pair& pair,
                 const Single& single) {
    const auto for_each_side = [&](const auto& take) {
        for (std::size_t t = 0; t < tets.size(); ++t) {
            const detail::SortedCorners sorted(tets[t]);
            take(sorted.vertex(0), sorted.side(t, 1, 2, 3));
            take(sorted.vertex(0), sorted.side(t, 1, 3, 2));
            take(sorted.vertex(0), sorted.side(t, 2, 3, 1));
            take(sorted.vertex(1), sorted.side(t, 2, 3, 0));
        }
    };
    const std::size_t most_sides = tets.size() * sizeof(Tetrahedron) / sizeof(detail::KeyedSide);
    std::vector<std::int32_t> table;
    visit_buckets<detail::KeyedSide>(
        vertex_count, most_sides, for_each_side,
        [&](std::size_t, std::span<detail::KeyedSide> sides) { detail::match_sides(sides, table, pair, single); });
}

/// Does this for the faces of a mesh.
template <class Pair, class Single>
void match_faces(const TetMesh& mesh, const Pair& pair, const Single& single) {
    match_faces(mesh.vertices.size(), mesh.tets, pair, single);
}

}  // namespace kerf
