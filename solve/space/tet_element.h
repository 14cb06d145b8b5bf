// Tetrahedral elements: linear and quadratic ones, whose edges may be curved.
#pragma once

#include <array>
#include <span>

#include "base/core/types.h"
#include "fill/mesh/edge_table.h"
#include "solve/case/material.h"
#include "solve/space/inside/quadrature.h"

namespace kerf {

inline constexpr int most_element_nodes = 10;
constexpr int element_nodes(int order) { return order == 1 ? 4 : most_element_nodes; }

/// Lagrange's element of order 1 or 2: nodes at the corners, then on the edges. With nodes that are no midpoints the
/// element of order 2 is isoparametric: its place is interpolated as its displacement is (Ergatoudis, Irons and
/// Zienkiewicz 1968, ergatoudis1968). Places in it are those of the tetrahedron of its corners, of which it is an
/// image.
class TetElement {
 public:
    using Nodes = std::array<Vec3, most_element_nodes>;
    using Shapes = std::array<double, most_element_nodes>;
    using Gradients = std::array<Vec3, most_element_nodes>;

    /// Takes the corners of an element with straight edges.
    TetElement(const std::array<Vec3, 4>& corners, int order);
    /// Takes the nodes of an element of order 2. It is straight if the nodes on the edges are the midpoints, bit by
    /// bit.
    explicit TetElement(const Nodes& nodes);

    int order() const { return order_; }
    int node_count() const { return element_nodes(order_); }
    bool is_curved() const { return is_curved_; }
    double volume() const { return volume_; }  ///< > 0 for a tetrahedron of positive orientation

    static Shapes shapes_at(int order, const Barycentric& place);
    /// Returns the place of node i.
    static Barycentric place_of_node(int i);
    Gradients gradients_at(const Barycentric& place) const;
    Vec3 position_of(const Barycentric& place) const;
    /// Returns the local volume of the element beside that of the tetrahedron of its corners: 1 if it is straight; > 0
    /// where it is not folded.
    double stretch_at(const Barycentric& place) const;

    /// A point of a sum that integrates over the element.
    struct Point {
        Barycentric place;
        double weight;  ///< a volume; those of a rule add up to that of the element
        Gradients gradients;
    };
    Point point(const TetPoint& at) const;

    /// The rule by which the stiffness is integrated. Straight: exactly, by 1 or 4 points. Curved: 14 points of degree
    /// 5, with which the volume and nodal forces of loads are exact, too. Gradients are no polynomials there; for the
    /// order of convergence degree 2 would do (Ciarlet and Raviart 1972, ciarlet1972), but leaves more than the
    /// discretisation does where cells are strongly curved.
    std::span<const TetPoint> rule() const;

    /// Returns the matrix whose row i is the gradient of component i of the field with these values at the nodes.
    Eigen::Matrix3d gradient_of(const Nodes& values, const Barycentric& place) const;

    /// Returns the integrals of the shape functions, which are the nodal forces of a force density of 1. Exact.
    Shapes node_volumes() const;

    /// Blocks of 3 x 3 of the stiffness matrix, by rule(): work of the stresses of node b's unit displacements in the
    /// strains of node a's. Symmetric.
    using Stiffness = std::array<std::array<Eigen::Matrix3d, most_element_nodes>, most_element_nodes>;
    void stiffness(const Material& material, Stiffness& blocks) const;

 private:
    // The gradients on the tetrahedron of the corners.
    Gradients straight_gradients_at(const Barycentric& place) const;
    // Row i is the gradient of coordinate i of the element, seen as a function on that tetrahedron.
    Eigen::Matrix3d distortion(const Gradients& straight) const;

    Nodes nodes_;                 // without those on edges where they are not curved
    std::array<Vec3, 4> slopes_;  // gradients of the barycentric coordinates
    double straight_volume_;      // of the tetrahedron of the corners
    double volume_;
    int order_;
    bool is_curved_ = false;
};

}  // namespace kerf
