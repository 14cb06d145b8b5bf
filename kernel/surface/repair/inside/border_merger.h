// Vertices of borders that are merged.
#pragma once

#include <vector>

#include "surface/repair/inside/border.h"

namespace kerf {

/// Two vertices of a border that were merged, or were left apart.
struct VertexPair {
    std::int32_t gone, stays;
    double apart;
};

/// The outcome of a merging.
struct BorderMerging {
    std::vector<std::int32_t> representative;  ///< #V; the vertex in whose place each is
    std::vector<VertexPair> merged;
    std::vector<VertexPair> refused;  ///< near enough, but the facets there or the bound forbid it
};

/// Merges vertices of the border nearer than `tolerance` to each other, the nearest first. Of two the one with the
/// lower number stays, unless that turns a facet over and the other choice does not. Pairs are left apart that belong
/// to one facet, that are near along the border for their distance (the sides of a hole), that would give an edge more
/// than two facets or lay a facet upon another, or that would take a vertex farther than `bound` from where it was.
/// `reach` (#V): how far each vertex, with all that it stands for, has moved already; brought up to date.
/// Deterministic. O(n log n) for n vertices of the border, while few are within the tolerance of one.
BorderMerging merge_border(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Border& border,
                           double tolerance, double bound, std::vector<double>& reach);

/// Undoes mergings without use: vertices whose facets share no edge now that they did not share before. `now`: facets
/// with representatives, or pieces of them; `parent`: the facet of `before` that each one is of, empty: the one with
/// its number. Takes the undone pairs out of `merging`.
void undo_useless(const std::vector<Triangle>& before, const std::vector<std::int32_t>& parent, BorderMerging& merging,
                  std::vector<Triangle>& now);

/// Whether a facet with the corners `now` looks to the same side as with `before`, or had no side.
bool keeps_side(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& now);

inline constexpr double least_arc_ratio = 4;  ///< length of a border between two places over their distance

}  // namespace kerf
