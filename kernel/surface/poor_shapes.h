// Facets and edges that give bad cells, and are right otherwise.
#pragma once

#include <vector>

#include "core/types.h"

namespace kerf {

struct PoorShape {
    double measure;  ///< of a needle its smallest angle in degrees, of an edge its length
    std::int32_t facet;
    std::int32_t edge = 0;  ///< of the facet: from this corner to the next one
};

struct PoorShapes {
    std::vector<PoorShape> needles, short_edges;
};

/// Looks for facets with an angle below a bound, and for edges so short that their ends nearly are one point for
/// doubles of their magnitude. Angles are computed only where products of edges leave a doubt.
class PoorShapeSearch {
 public:
    /// The arrays must outlive the search. O(#V).
    PoorShapeSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, double needle_angle_deg);

    /// Adds what is poor of a facet with finite coordinates. An edge is one of the facet that has its smaller end
    /// first. For several threads. O(1).
    void look_at(std::int32_t facet, PoorShapes& found) const;

 private:
    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    double needle_angle_deg_;
    double needle_bound_;  // of the square of the area, as a share of that of a product of edges
    double short_bound_;   // of the square of the length
};

}  // namespace kerf
