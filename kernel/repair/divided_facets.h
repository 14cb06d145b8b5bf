// The facets of an arrangement while they are divided.
#pragma once

#include <cstdint>
#include <vector>

#include "repair/distinct_points.h"
#include "repair/facet_contact.h"

namespace kerf {

/// A piece of a facet, turned like it.
struct FacetPiece {
    std::int32_t facet;
    Triangle corners;
};

/// A point on an edge of a facet, between its ends.
struct PointOnEdge {
    UndirectedEdge edge;
    double along;  ///< from the smaller end, in units
    std::int32_t vertex;
    std::int32_t facet;
    auto operator<=>(const PointOnEdge&) const = default;
};

struct DividedFacets {
    DistinctPoints points;
    std::vector<Triangle> facets = {};      ///< with area; corners are the first points with their coordinates
    std::vector<std::int32_t> parent = {};  ///< #F, ascending
    std::vector<char> changed = {};         ///< #F: since crossings were looked for

    Corners corners(const Triangle& t) const { return {points.all()[t[0]], points.all()[t[1]], points.all()[t[2]]}; }
    bool has_area(const Triangle& t) const;

    /// Makes facets with a common edge agree on the points on it: what pieces of one facet have, and `on_edges` names
    /// with it, those of the others get; facets that were whole are divided and become `is_divided` (#F).
    void share_points(std::vector<FacetPiece>& pieces, std::vector<char>& is_divided,
                      std::vector<PointOnEdge>& on_edges) const;

    /// Puts pieces into the places of the facets that they are of and those `is_divided` (#F) names, of which nothing
    /// is left otherwise. Pieces without area are left out. `pieces`: will be in the order of the facets.
    void replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided);
};

}  // namespace kerf
