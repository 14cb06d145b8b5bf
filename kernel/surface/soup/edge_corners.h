// The facets that meet at each edge of a set of facets.
#pragma once

#include <span>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

/// Returns the next corner of the same facet. Corner 3 f + i is the edge of facet f from its vertex i to the next one.
constexpr std::int32_t next_corner(std::int32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
inline std::int32_t start_vertex(const std::vector<Triangle>& facets, std::int32_t corner) {
    return facets[corner / 3][corner % 3];
}

/// The corners of a set of facets, grouped by their edges, whichever way their facets run along these.
class EdgeCorners {
 public:
    struct Corner {
        std::int32_t high;  // the larger end of its edge
        std::int32_t corner;
    };

    /// Takes the corners c with partner[c] < 0 (3 #F) alone, or all if `partner` is empty. Requires vertex numbers >=
    /// 0. O(#V + #F) for bounded vertex degrees, where #V is one more than the largest number.
    explicit EdgeCorners(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner = {});

    /// Calls visit(low, corners) for every edge with its smaller end and its corners. Corners ascend, and so do the
    /// edges.
    template <class Visit>
    void for_each_edge(Visit visit) const {
        for (std::int32_t v = 0; v + 1 < count_of(first_); ++v)
            for (std::int32_t i = first_[v], j = i; i < first_[v + 1]; i = j) {
                while (j < first_[v + 1] && corners_[j].high == corners_[i].high) ++j;
                visit(v, std::span(corners_).subspan(i, j - i));
            }
    }

 private:
    std::vector<std::int32_t> first_;  // corners with the smaller end v: [first_[v], first_[v + 1])
    std::vector<Corner> corners_;
};

/// Whether more than two facets meet at some edge. Cost as EdgeCorners.
bool has_edge_of_many(const std::vector<Triangle>& facets);

/// Returns for every corner the corner of the other facet at its edge, whichever way that runs along it, or -1 where an
/// edge does not have exactly two corners. Requirements and cost as EdgeCorners, on threads. Beside the result, each
/// thread takes 60 B for a facet of its share, which is a sixty-fourth of all facets where vertices are numbered as
/// facets come, and a quarter at worst.
std::vector<std::int32_t> edge_partners(const std::vector<Triangle>& facets);

}  // namespace kerf
