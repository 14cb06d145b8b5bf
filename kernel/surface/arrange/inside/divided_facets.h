// The facets of an arrangement while they are divided.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/core/types.h"
#include "surface/arrange/inside/facet_contact.h"
#include "surface/soup/vertex_table.h"

namespace kerf {

/// Points that are found by number and by coordinates. -0 equals 0.
class DistinctPoints {
 public:
    /// Takes points with their numbers; equal ones among them keep theirs.
    explicit DistinctPoints(std::vector<Vec3> points);

    const std::vector<Vec3>& all() const { return points_; }
    std::vector<Vec3> take() { return std::move(points_); }

    /// Returns the smallest number of a point with these coordinates, and adds the point if there is none. Expected
    /// O(1).
    std::int32_t number_of(const Vec3& p);

 private:
    std::vector<Vec3> points_;
    VertexTable table_;
};

/// A piece of a facet, turned like it.
struct FacetPiece {
    std::int32_t facet;
    Triangle corners;
};

/// A point on an edge of a facet, between its ends.
struct PointOnEdge {
    UndirectedEdge edge;
    double along;  ///< distance from the smaller end, units of the surface
    std::int32_t vertex;
    std::int32_t facet;
    auto operator<=>(const PointOnEdge&) const = default;
};

/// The facets of an arrangement in one of its rounds.
struct DividedFacets {
    DistinctPoints points;
    std::vector<Triangle> facets = {};      ///< facets with area; a corner is the first point with its coordinates
    std::vector<std::int32_t> parent = {};  ///< #F, ascending: the given facet
    std::vector<char> changed = {};         ///< #F: changed since crossings were last looked for

    Corners corners(const Triangle& t) const { return {points.all()[t[0]], points.all()[t[1]], points.all()[t[2]]}; }
    bool has_area(const Triangle& t) const;

    /// Makes facets with a common edge agree on the points on it: points that `on_edges` names for one facet are given
    /// to the pieces of the others, too. Facets that were whole are divided and become `is_divided` (#F).
    void share_points(std::vector<FacetPiece>& pieces, std::vector<char>& is_divided,
                      std::vector<PointOnEdge>& on_edges) const;

    /// Puts pieces into the places of their facets. Facets that `is_divided` (#F) names go, and only their pieces are
    /// left. Pieces without area are left out. Sorts `pieces` by facet.
    void replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided);
};

}  // namespace kerf
