// Which facets meet at the edges of a set of facets.
#pragma once

#include <span>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Corner 3 f + i is the edge of facet f from its vertex i to the next one.
constexpr std::int32_t next_corner(std::int32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
inline std::int32_t start_vertex(const std::vector<Triangle>& facets, std::int32_t corner) {
    return facets[corner / 3][corner % 3];
}

/// The corners of a set of facets, those at one edge side by side, in whatever direction they have it.
class EdgeCorners {
 public:
    struct Corner {
        std::int32_t high;  // the larger end of its edge
        std::int32_t corner;
    };

    /// The edges of the corners c with partner[c] < 0 (3 #F) alone, or of all if `partner` is empty. Requires vertex
    /// numbers >= 0. O(#V + #F) for bounded vertex degrees, where #V is one more than the largest number.
    explicit EdgeCorners(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner = {});

    /// Calls visit(low, corners) for every edge, with its smaller end and its corners, ascending; edges ascend.
    template <class Visit>
    void for_each_edge(Visit visit) const {
        for (std::size_t v = 0; v + 1 < first_.size(); ++v)
            for (std::int32_t i = first_[v], j = i; i < first_[v + 1]; i = j) {
                while (j < first_[v + 1] && corners_[j].high == corners_[i].high) ++j;
                visit(static_cast<std::int32_t>(v), std::span(corners_).subspan(i, j - i));
            }
    }

 private:
    std::vector<std::int32_t> first_;  // those with the smaller end v are [first_[v], first_[v + 1])
    std::vector<Corner> corners_;
};

/// Whether an edge has more than two facets. Cost as EdgeCorners.
bool has_edge_of_many(const std::vector<Triangle>& facets);

/// For every corner that of the facet on the other side of its edge, in whatever direction it has it; -1 where an edge
/// does not have exactly two corners. Requirements and cost as EdgeCorners, on threads. Beside the result each of them
/// has 60 B for a facet of its share: a sixty-fourth of all where vertices are numbered as facets come, at worst a
/// quarter.
std::vector<std::int32_t> edge_partners(const std::vector<Triangle>& facets);

}  // namespace kerf
