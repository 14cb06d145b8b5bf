// Boundary triangles of elements, straight or curved, and what loads put on their nodes.
#pragma once

#include <array>

#include "core/types.h"
#include "solve/tet_element.h"

namespace kerf {

/// What a traction of 1 puts on each node of a straight triangle: corners, then middles of edges.
using TriangleShares = std::array<double, 6>;
TriangleShares node_areas(double area, int order);

/// The side of a TetElement: corners, then the nodes on triangle_edges.
class FacetElement {
 public:
    using Nodes = std::array<Vec3, 6>;
    using Forces = std::array<Vec3, 6>;

    /// With straight edges; corners are seen from outside.
    FacetElement(const std::array<Vec3, 3>& corners, int order);
    /// Of order 2; straight if the nodes on the edges are the midpoints, bit by bit.
    explicit FacetElement(const Nodes& nodes);

    bool is_curved() const { return is_curved_; }
    /// Of a curved one by six points, which differs from the true one by less than interpolation does.
    double area() const { return area_; }
    /// Of the triangle of its corners, outwards, of length 1.
    const Vec3& normal() const { return normal_; }

    /// What a pressure, which acts against the normal of each place, puts on nodes. Exact.
    Forces forces_of_pressure(double pressure) const;
    /// What a force per area puts on nodes.
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
