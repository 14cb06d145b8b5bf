// The validity of a curved tetrahedron of second order: proven, not sampled.
#pragma once

#include <array>

#include "base/core/types.h"

namespace kerf {

/// The nodes of a tetrahedron of second order: corners, then nodes on edges in the order of tet_edges
/// (fill/mesh/edge_table.h).
using TetNodes = std::array<Vec3, 10>;

/// Returns the nodes of the tetrahedron with straight edges on these corners.
TetNodes straight_nodes(const std::array<Vec3, 4>& corners);

enum class CellValidity {
    valid,     ///< the Jacobian determinant is positive everywhere, on closed faces and at corners, too
    invalid,   ///< the Jacobian determinant is not positive at some point
    undecided  ///< its least value is too near to zero to tell; to be treated as invalid
};

/// Bounds of the least value of a Jacobian determinant. But for rounding, `high` is one of its values.
struct JacobianBounds {
    double low, high;
};

/// The Jacobian determinant of the map from the reference tetrahedron (barycentric coordinates) to a ten-node
/// tetrahedron, in units of volume: 6 V everywhere if the edges are straight and nodes are their midpoints.
///
/// It is a polynomial of degree 3, kept by its 20 Bezier coefficients. Its values lie in the range of these, and its
/// values at corners are four of them, so that coefficients above zero prove a cell valid, and a corner at or below
/// zero proves it invalid; where neither is so, the cell is bisected, and its pieces are treated likewise (Johnen,
/// Remacle and Geuzaine 2013, johnen2013). Rounding is bounded: a value within that bound of zero proves nothing valid.
/// Deterministic.
class CurvedTetJacobian {
 public:
    explicit CurvedTetJacobian(const TetNodes& nodes);

    /// Returns whether the cell is valid. O(1) for most cells; at most some 1000 pieces.
    CellValidity validity() const;
    /// Returns bounds of the least value, to within `precision` times the size of the largest coefficient, where the
    /// pieces suffice for it.
    JacobianBounds bounds(double precision = 1e-3) const;
    /// Returns a lower bound of the least value, by the coefficients alone.
    double coarse_low() const;
    /// Returns 6 V of the tetrahedron on the corners.
    double straight() const { return straight_; }
    /// Returns the volume of the cell.
    double volume() const;
    /// Returns the coefficients, for i <= j <= k ascending: each belongs to the product of barycentric coordinates i, j
    /// and k.
    const std::array<double, 20>& coefficients() const { return coefficients_; }

 private:
    std::array<double, 20> coefficients_;
    double straight_;
    double rounding_;  // bound of the rounding of a coefficient
};

/// Returns the scaled Jacobian of a ten-node tetrahedron: the least value of its Jacobian determinant over that of the
/// straight tetrahedron on its corners. It is 1 if the nodes are midpoints, but for rounding, and at most 0 if the cell
/// is not valid. The result is a lower bound, to within 1e-3. Requires positively oriented corners.
double scaled_jacobian(const CurvedTetJacobian& jacobian);

}  // namespace kerf
