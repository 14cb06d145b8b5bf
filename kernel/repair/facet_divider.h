// Facets of one plane, divided by all that cross or touch them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "repair/divided_facets.h"

namespace kerf {

/// A facet of a plane, and those that meet it but share no area with it.
struct CrossedFacet {
    std::int32_t facet;
    std::span<const std::int32_t> others;
};

/// Divides facets of one plane, exactly, and rounds the points to doubles.
///
/// Facets that share area are to be divided together: then pieces in one place have the same corners. A point that
/// several facets have gets the same number in all of them, because its rounded place tells that. So pieces of
/// neighbours fit, wherever they are divided.
class FacetDivider {
 public:
    /// New points are added to `points`.
    FacetDivider(DistinctPoints& points, const std::vector<Triangle>& facets) : points_(points), facets_(facets) {}

    /// Appends the pieces, facet by facet; some may have no area once they are rounded. Every corner of a facet is the
    /// first point with its coordinates; facets have area. O(n^2) points where n facets cross each other within one.
    /// `on_edges`: gets the points on the edges of the facets.
    void divide(std::span<const CrossedFacet> facets_of_plane, std::vector<FacetPiece>& pieces,
                std::vector<PointOnEdge>& on_edges);

    /// How far a point is from where it is exactly, at most.
    double largest_rounding() const { return largest_rounding_; }

 private:
    DistinctPoints& points_;
    const std::vector<Triangle>& facets_;
    double largest_rounding_ = 0;
};

}  // namespace kerf
