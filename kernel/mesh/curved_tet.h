// Whether a curved tetrahedron of second order is valid: proven, not sampled.
#pragma once

#include <array>

#include "core/types.h"

namespace kerf {

/// Corners, then the nodes on the edges in the order of tet_edges (mesh/edge_table.h).
using TetNodes = std::array<Vec3, 10>;

/// The nodes of the tetrahedron with straight edges on these corners.
TetNodes straight_nodes(const std::array<Vec3, 4>& corners);

enum class CellValidity {
    valid,     ///< the Jacobian determinant is positive everywhere, closed faces and corners included
    invalid,   ///< it is not, at some point
    undecided  ///< its least value is too near to zero to tell; to be treated as invalid
};

/// Between which its least value is, and nothing else: `high` is one of its values.
struct JacobianBounds {
    double low, high;
};

/// The Jacobian determinant of the map from the reference tetrahedron (barycentric coordinates) to a ten-node
/// tetrahedron, in units of volume: 6 V everywhere if the edges are straight and nodes are their midpoints.
///
/// It is a polynomial of degree 3, kept by its 20 Bezier coefficients. It lies within their range and takes the values
/// of the four at corners, so that the coefficients prove a cell valid, or its corners prove it invalid; where they do
/// not decide, the cell is bisected, and those of its pieces are looked at (Johnen, Remacle, Geuzaine 2013). Rounding
/// is bounded: nothing is called valid that is within it of zero. Deterministic.
class CurvedTetJacobian {
 public:
    explicit CurvedTetJacobian(const TetNodes& nodes);

    /// O(1) for most cells; at most some 1000 pieces.
    CellValidity validity() const;
    /// The least value, to within `precision` of the largest coefficient's size where the pieces suffice for it.
    JacobianBounds bounds(double precision = 1e-3) const;
    /// From the coefficients alone: at most the least value.
    double coarse_low() const;
    /// 6 V of the tetrahedron on the corners.
    double straight() const { return straight_; }
    /// What the cell holds.
    double volume() const;
    /// The coefficients, of i <= j <= k ascending: of products of the barycentric coordinates i, j and k.
    const std::array<double, 20>& coefficients() const { return coefficients_; }

 private:
    std::array<double, 20> coefficients_;
    double straight_;
    double rounding_;  // of a coefficient, at most
};

/// The scaled Jacobian of a ten-node tetrahedron: the least value of its Jacobian determinant over that of the straight
/// tetrahedron on its corners; 1 if the nodes are midpoints, but for rounding, and at most 0 if the cell is not valid.
/// From below, to within 1e-3. Requires positively oriented corners.
double scaled_jacobian(const CurvedTetJacobian& jacobian);

}  // namespace kerf
