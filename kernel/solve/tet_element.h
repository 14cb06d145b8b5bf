// Tetrahedral elements with straight edges, linear and quadratic.
#pragma once

#include <array>

#include "core/types.h"
#include "mesh/edge_table.h"
#include "solve/material.h"

namespace kerf {

inline constexpr int most_element_nodes = 10;
constexpr int element_nodes(int order) { return order == 1 ? 4 : most_element_nodes; }

/// Weights of the corners; they add up to 1.
using Barycentric = std::array<double, 4>;

/// Four points with equal weights, exact for polynomials of degree 2.
inline constexpr double inner_weight = 0.13819660112501051518, outer_weight = 1 - 3 * inner_weight;
inline constexpr std::array<Barycentric, 4> quadrature_points = {
    {{outer_weight, inner_weight, inner_weight, inner_weight},
     {inner_weight, outer_weight, inner_weight, inner_weight},
     {inner_weight, inner_weight, outer_weight, inner_weight},
     {inner_weight, inner_weight, inner_weight, outer_weight}}};

/// Lagrange's element of order 1 or 2: nodes at the corners, then in the middle of the edges.
class TetElement {
 public:
    TetElement(const std::array<Vec3, 4>& corners, int order);

    int order() const { return order_; }
    int node_count() const { return element_nodes(order_); }
    double volume() const { return volume_; }  ///< > 0 for a tetrahedron of positive orientation

    using Shapes = std::array<double, most_element_nodes>;
    using Gradients = std::array<Vec3, most_element_nodes>;
    static Shapes shapes_at(int order, const Barycentric& point);
    Gradients gradients_at(const Barycentric& point) const;
    Vec3 position_of(const Barycentric& point) const;

    /// Row i is the gradient of component i of what has these values at the nodes.
    Eigen::Matrix3d gradient_of(const std::array<Vec3, most_element_nodes>& values, const Barycentric& point) const;

    /// The integrals of the shape functions: what a force density of 1 puts on each node.
    Shapes node_volumes() const;

    /// Blocks of 3 x 3 of the stiffness matrix, exactly integrated: work of the stresses of node b's unit displacements
    /// in the strains of node a's. Symmetric.
    using Stiffness = std::array<std::array<Eigen::Matrix3d, most_element_nodes>, most_element_nodes>;
    void stiffness(const Material& material, Stiffness& blocks) const;

 private:
    std::array<Vec3, 4> corners_;
    std::array<Vec3, 4> slopes_;  // gradients of the barycentric coordinates
    double volume_;
    int order_;
};

/// What a traction of 1 puts on each node of a triangle: corners, then middles of edges.
using TriangleShares = std::array<double, 6>;
TriangleShares node_areas(double area, int order);

}  // namespace kerf
