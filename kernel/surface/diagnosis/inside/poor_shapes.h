// Facets and edges that are correct, but give bad cells.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

struct PoorShape {
    double measure;  ///< a needle's smallest angle in degrees, or the length of an edge
    std::int32_t facet;
    std::int32_t edge = 0;  ///< corner of the facet at which the edge begins
};

struct PoorShapes {
    std::vector<PoorShape> needles, short_edges;
};

/// A search for facets with an angle below a bound, and for edges so short that their ends nearly are one point in
/// doubles of their magnitude. Angles are computed only where products of edges leave a doubt.
class PoorShapeSearch {
 public:
    /// The arrays must outlive the search. O(#V).
    PoorShapeSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, double needle_angle_deg);

    /// Adds the needle and the short edges of a facet with finite coordinates. An edge counts for the facet that has
    /// its smaller end first. For several threads. O(1).
    void look_at(std::int32_t facet, PoorShapes& found) const;

 private:
    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    double needle_angle_deg_;
    double needle_bound_;  // compared with the square of the area over that of a product of edges
    double short_bound_;   // compared with the square of the length
};

}  // namespace kerf
