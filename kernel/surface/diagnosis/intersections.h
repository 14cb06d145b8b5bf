// The exact intersection of triangles that may share vertices.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/core/types.h"

namespace kerf {

class FacetTree;

/// True if the two triangles meet anywhere but in the vertices and edges that they share by number.
///
/// `p`, `q`: corner coordinates; `p_id`, `q_id`: vertex numbers of the corners, by which sharing is recognised.
/// Triangles with the same three vertices intersect; two that share an edge intersect if they overlap when folded flat
/// upon each other. Exact predicates, no tolerance.
bool triangles_intersect(const std::array<Vec3, 3>& p, const Triangle& p_id, const std::array<Vec3, 3>& q,
                         const Triangle& q_id);

/// Returns a point where two intersecting facets meet: of all corners, and of the points where an edge passes through
/// the plane of the other facet, the one nearest to the other facet. Corners that the facets share by number are left
/// out.
Vec3 meeting_place(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t);

/// Pairs of facets, the smaller number first, ascending.
using IntersectingPairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Returns all intersecting pairs of a triangle soup, or the first `limit` of them; the search ends once 20 times
/// `limit` pairs are found, and then gives the first `limit` of those. O(#F log #F) where the boxes of few facets
/// without a common vertex meet, on threads, with the same result for any number of them; 44 bytes a facet. Requires
/// limit > 0, finite coordinates and facets with three distinct, non-collinear vertices; a facet with collinear corners
/// counts as the segment that it is, but may be reported with its neighbours.
IntersectingPairs find_self_intersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                          std::size_t limit = 1000);

/// The search of find_self_intersections() in shares, for ranks that have the same surface.
class SelfIntersectionSearch {
 public:
    /// Keeps both arrays by reference. Requirements as find_self_intersections().
    SelfIntersectionSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);
    ~SelfIntersectionSearch();

    /// Returns the first `limit` pairs of share number `share`, counted from 0, of `shares` equal ones. The pairs of
    /// all shares, sorted, are those of share 0 of 1 up to the limit, unless there are 20 times `limit`. Each pair is
    /// in one share.
    IntersectingPairs pairs_of_share(std::size_t share, std::size_t shares, std::size_t limit = 1000) const;

 private:
    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::unique_ptr<const FacetTree> tree_;
};

/// Whether no two facets of closed shells meet. `shell` has the shell of each facet (#F), `parent` for each shell the
/// innermost one in which one of its vertices lies, -1 for none. Only shells with the same parent are compared with
/// each other, and with that parent: where these do not meet, no others can. So nested shells take hardly longer than
/// shells side by side, although the boxes of their facets may all overlap. Requirements and cost as
/// find_self_intersections(); no vertex may be on two shells.
bool nested_shells_are_apart(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                             const std::vector<std::int32_t>& shell, const std::vector<std::int32_t>& parent);

/// Finds the pairs of find_self_intersections() of which at least one facet is `chosen` (#F): the question to ask after
/// few facets of a surface without intersections have changed. `counts(f, g)`, if given, tells whether a pair that
/// intersects counts, also towards the limit; it is called from several threads.
IntersectingPairs find_intersections_of(const std::vector<char>& chosen, const std::vector<Vec3>& vertices,
                                        const std::vector<Triangle>& facets, std::size_t limit = 1000,
                                        const std::function<bool(std::int32_t, std::int32_t)>& counts = {});

}  // namespace kerf
