// The part of a surface around a plane, where a contour may run.
#pragma once

#include <algorithm>
#include <vector>

#include "cut/cut/cut.h"

namespace kerf {

/// The reach of a facet: the lowest and highest distance of its vertices from the plane.
struct SlabFacet {
    Facet facet;
    double low, high;
};

/// The facets of a surface that meet the plane or whose centroid is nearer to it than three crossing edges. All other
/// facets lie on one side of the plane.
struct Band {
    Plane plane;
    double edge_length = 0;               ///< h, mean length of the edges that cross the plane; 0: none does
    double section_area = 0;              ///< area in which the plane cuts the body
    double half_width = 0;                ///< three crossing edges, 3 h
    double slab_half_width = 0;           ///< six of them: interfaces reach further than contours
    Array<Vertex, double> distance;       ///< per vertex of the surface, signed
    std::vector<Facet> facets;            ///< ascending
    Array<Facet, std::int32_t> index_of;  ///< per facet of the surface: its index in `facets`, or -1
    std::vector<std::array<HalfEdge, 3>> half_edges;  ///< per band facet
    std::vector<Vertex> vertices;                     ///< vertices of the band's facets, in the order in which they
                                                      ///< are met
    Array<Vertex, std::int32_t> vertex_index_of;      ///< per vertex of the surface: its index in `vertices`, or -1
    Array<Facet, Side> majority;  ///< per facet of the surface: the side of most vertices (ivanov2006)
    std::vector<SlabFacet> slab;  ///< facets that reach into |distance| <= slab_half_width, ascending; the whole band
                                  ///< is among them
    double rounding = 0;          ///< bound on the error of a projection or a height

    /// Whether the sizes are those of a band of this surface: required wherever both are passed together.
    bool fits(const Surface& surface) const {
        return count_of(distance) == surface.vertex_count() && vertex_index_of.size() == distance.size() &&
               majority.size() == index_of.size() && count_of(index_of) == surface.facet_count();
    }
    /// Mean of the distances of the facet's vertices.
    double facet_distance(const Surface& surface, Facet facet) const {
        const auto t = surface.corners(facet);
        return (distance[t[0]] + distance[t[1]] + distance[t[2]]) / 3;
    }
    /// Calls visit(slab facet) for the facets that reach into [low, high], ascending. O(#slab) within its half width,
    /// else O(#F).
    template <class Visit>
    void for_each_facet_between(const Surface& surface, double low, double high, Visit visit) const {
        const auto visit_if_between = [&](const SlabFacet& facet) {
            if (facet.low <= high && facet.high >= low) visit(facet);
        };
        if (low >= -slab_half_width && high <= slab_half_width)
            for (const SlabFacet& facet : slab) visit_if_between(facet);
        else
            for (const Facet f : surface.facets()) visit_if_between(reach_of(surface, f));
    }
    SlabFacet reach_of(const Surface& surface, Facet facet) const {
        const auto t = surface.corners(facet);
        const auto [low, high] = std::minmax({distance[t[0]], distance[t[1]], distance[t[2]]});
        return {facet, low, high};
    }
};

/// Whether there is a label for every facet of the surface: required wherever labels are passed.
inline bool fit(const Array<Facet, Side>& side, const Surface& surface) {
    return count_of(side) == surface.facet_count();
}

/// Makes the band of a plane. O(#V + #F), on threads.
Band make_band(const Surface& surface, const Plane& plane);

/// Returns the mean length of the edges that cross a plane, 0 if none does. O(#V + #F).
double crossing_edge_length(const Surface& surface, const Plane& plane);

/// Returns the edges with one end below and one end above the plane, oriented from below to above.
std::vector<SurfaceEdge> crossed_edges(const Surface& surface, const Band& band);

}  // namespace kerf
