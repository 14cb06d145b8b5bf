// The exact intersection of triangles that may share vertices.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/types.h"

namespace kerf {

class FacetTree;

/// True if the two triangles meet anywhere but in the vertices and edges that they share by number.
///
/// `p`, `q`: corner coordinates; `p_id`, `q_id`: vertex numbers of the corners, by which sharing is recognised.
/// Triangles with the same three vertices intersect; two that share an edge intersect if they overlap when folded flat
/// upon each other. Exact predicates, no tolerance.
bool triangles_intersect(const std::array<Vec3, 3>& p, const Triangle& p_id, const std::array<Vec3, 3>& q,
                         const Triangle& q_id);

/// Where two facets that intersect meet, but for the corners that they share by number: of all corners and of the
/// points where an edge passes through the plane of the other facet, that which is nearest to that facet.
Vec3 meeting_place(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t);

/// Pairs of facets, the smaller number first, ascending.
using IntersectingPairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// All intersecting pairs of a triangle soup; the first `limit` of them if there are more, or of those found so far
/// when 20 times `limit` are found: then the search ends. O(#F log #F) where boxes of few facets meet that have no
/// vertex in common, on threads, of which the result does not depend; 44 bytes a facet. Requires limit > 0, finite
/// coordinates and facets with three distinct, non-collinear vertices; a facet with collinear corners counts as the
/// segment that it is, but may be reported with its neighbours.
IntersectingPairs find_self_intersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                          std::size_t limit = 1000);

/// The same search in shares, for ranks that have one surface.
class SelfIntersectionSearch {
 public:
    /// Keeps both arrays by reference. Requirements as above.
    SelfIntersectionSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);
    ~SelfIntersectionSearch();

    /// What one of `shares` equal shares finds, numbered from 0: the first `limit` pairs. Those of all shares, sorted,
    /// are those of share 0 of 1, up to the limit, unless there are 20 times `limit`. Each pair is in one share.
    IntersectingPairs pairs_of_share(std::size_t share, std::size_t shares, std::size_t limit = 1000) const;

 private:
    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::unique_ptr<const FacetTree> tree_;
};

/// Whether no two facets of closed shells meet. `shell`: #F, the shell of each facet; `parent`: of each shell the
/// innermost one that one of its vertices lies in, -1 for none. Only shells that lie in the same one are compared, and
/// these with that: where they do not meet, nothing else can. So shells within shells take hardly longer than shells
/// side by side, while the boxes of their facets may all overlap. Requirements and cost as above; no vertex on two
/// shells.
bool nested_shells_are_apart(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                             const std::vector<std::int32_t>& shell, const std::vector<std::int32_t>& parent);

/// Finds what find_self_intersections() does, but only pairs of which at least one facet is `chosen` (#F): what is to
/// be asked where few facets of a surface without intersections have changed. `counts(f, g)`, if given: whether a pair
/// that intersects counts, also towards the limit; called from several threads.
IntersectingPairs find_intersections_of(const std::vector<char>& chosen, const std::vector<Vec3>& vertices,
                                        const std::vector<Triangle>& facets, std::size_t limit = 1000,
                                        const std::function<bool(std::int32_t, std::int32_t)>& counts = {});

}  // namespace kerf
