// Facets of one plane, divided by all facets that cross or touch them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/arrange/inside/divided_facets.h"

namespace kerf {

/// A facet of a plane, and the facets that meet it but share no area with it.
struct CrossedFacet {
    std::int32_t facet;
    std::span<const std::int32_t> others;
};

/// Divides facets of one plane, exactly, and rounds the points to doubles.
///
/// Facets that share area are to be divided together: then pieces in one place have the same corners. A point of
/// several facets gets the same number in all of them, because its rounded coordinates determine the number. So pieces
/// of neighbours fit, wherever they are divided.
class FacetDivider {
 public:
    /// Takes all points, to which new ones are added, and all facets.
    FacetDivider(DistinctPoints& points, const std::vector<Triangle>& facets) : points_(points), facets_(facets) {}

    /// Appends the pieces, facet by facet; some may have no area once they are rounded. Every corner of a facet is the
    /// first point with its coordinates; facets have area. `on_edges` gets the points on the edges of the facets.
    /// O(n^2) points where n facets cross each other within one.
    void divide(std::span<const CrossedFacet> facets_of_plane, std::vector<FacetPiece>& pieces,
                std::vector<PointOnEdge>& on_edges);

    /// Returns the largest distance of a new point from its exact place.
    double largest_rounding() const { return largest_rounding_; }

 private:
    DistinctPoints& points_;
    const std::vector<Triangle>& facets_;
    double largest_rounding_ = 0;
};

}  // namespace kerf
