// Vertices of borders that become one.
#pragma once

#include <vector>

#include "repair/border.h"

namespace kerf {

/// Two vertices that became one, or were left.
struct VertexPair {
    std::int32_t gone, stays;
    double apart;
};

struct BorderMerging {
    std::vector<std::int32_t> representative;  ///< #V; the vertex in whose place each is
    std::vector<VertexPair> merged;
    std::vector<VertexPair> refused;  ///< near enough, but facets would turn over or an edge would have three
};

/// Merges vertices of the border nearer than `tolerance`, the nearest first; of two the one with the lower number
/// stays, unless that turns a facet over and the other does not. Left alone are two vertices of one facet, two that
/// are near along the border for their distance (the sides of a hole), what would give an edge more than two facets or
/// lay a facet upon another, and what would take a vertex farther than `bound` from where it was. `reach`: #V, how far
/// what is in the place of a vertex has come already; brought up to date. Deterministic. O(n log n) for n vertices of
/// the border, while few are within the tolerance of one.
BorderMerging merge_border(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Border& border,
                           double tolerance, double bound, std::vector<double>& reach);

/// Puts what was merged in vain back: vertices whose facets share no edge now that they did not share before. `now`:
/// facets with representatives, or pieces of them; `parent`: which of `before` each one was, empty: the same. Leaves
/// out of `merging` what is undone.
void undo_useless(const std::vector<Triangle>& before, const std::vector<std::int32_t>& parent, BorderMerging& merging,
                  std::vector<Triangle>& now);

/// Whether a facet with the corners `now` looks to the same side as with `before`, or had no side.
bool keeps_side(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& now);

inline constexpr double least_arc_ratio = 4;  ///< of the length of a border between two places and their distance

}  // namespace kerf
