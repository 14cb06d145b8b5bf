// Boundary triangles of elements, straight or curved, and the nodal forces of loads on them.
#pragma once

#include <array>

#include "base/core/types.h"
#include "solve/space/tet_element.h"

namespace kerf {

/// The share of each node of a straight triangle in a traction of 1: corners, then middles of edges.
using TriangleShares = std::array<double, 6>;
TriangleShares node_areas(double area, int order);

/// A side of a TetElement; its nodes are the corners, then the nodes on triangle_edges.
class FacetElement {
 public:
    using Nodes = std::array<Vec3, 6>;
    using Forces = std::array<Vec3, 6>;

    /// Takes the corners of a triangle with straight edges, counter-clockwise seen from outside.
    FacetElement(const std::array<Vec3, 3>& corners, int order);
    /// Takes the nodes of a triangle of order 2; it is straight if the nodes on the edges are the midpoints, bit by
    /// bit.
    explicit FacetElement(const Nodes& nodes);

    bool is_curved() const { return is_curved_; }
    /// The area; that of a curved triangle is summed at six points, with an error smaller than that of interpolation.
    double area() const { return area_; }
    /// The normal of the triangle of the corners, outwards, of length 1.
    const Vec3& normal() const { return normal_; }

    /// Returns the nodal forces of a pressure, which acts against the normal of each place. Exact.
    Forces forces_of_pressure(double pressure) const;
    /// Returns the nodal forces of a force per area.
    Forces forces_of_traction(const Vec3& traction) const;

 private:
    // The area vector for each unit of area of the plane reference triangle, whose area is 1.
    Vec3 area_vector_at(const BarycentricOfTriangle& place) const;
    template <class Load>
    Forces integrate(Load load) const;

    Nodes nodes_;
    Vec3 normal_;
    double area_;
    int order_;
    bool is_curved_ = false;
};

}  // namespace kerf
