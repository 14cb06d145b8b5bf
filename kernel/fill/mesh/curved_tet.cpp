// The cell is the image of a map x(l) of second order in barycentric coordinates l: x(l) = sum of b_ij l_i l_j over all
// i and j, with control points b_ii the corners x_i and 2 b_ij = 4 m_ij - x_i - x_j for the node m_ij on an edge. The
// derivative from corner 0 to corner k is 2 sum of (b_kj - b_0j) l_j. So the determinant of the three derivatives is a
// sum of l_a l_b l_c times determinants of differences of control points, and a Bezier coefficient is the mean over the
// orders of a, b, c.
//
// All values lie within the range of the coefficients, and those at corners are values (Johnen, Remacle and Geuzaine
// 2013, johnen2013). Where this does not decide, the cell is bisected: it begins as a regular tetrahedron, and the
// longest edge of a piece is halved, so that pieces shrink in all directions. A cell whose pieces become too small or
// too many is undecided, never valid.
#include "fill/mesh/curved_tet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "fill/mesh/edge_table.h"

namespace kerf {

namespace {

using Coefficients = std::array<double, 20>;

constexpr int deepest_bisection = 15;  // depth at which the edges of a piece are a 32nd of the cell's
constexpr int most_pieces = 1000;
constexpr double determinant_roundings = 64;  // rounding of products of three slopes, in units of the last place
constexpr double precision_of_scaled = 1e-3;

// The number of the coefficient of a product of three barycentric coordinates, in any order.
constexpr auto coefficient_numbers = [] {
    std::array<std::array<std::array<std::size_t, 4>, 4>, 4> numbers = {};
    std::size_t next = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i; j < 4; ++j)
            for (std::size_t k = j; k < 4; ++k) {
                for (const auto& [a, b, c] : std::array<std::array<std::size_t, 3>, 6>{
                         {{i, j, k}, {i, k, j}, {j, i, k}, {j, k, i}, {k, i, j}, {k, j, i}}})
                    numbers[a][b][c] = next;
                ++next;
            }
    return numbers;
}();

// The coefficients with an entry for each order of the three numbers: the polar form at the corners.
using PolarForm = std::array<std::array<std::array<double, 4>, 4>, 4>;

template <class Visit>
void for_coefficients(Visit visit) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i; j < 4; ++j)
            for (std::size_t k = j; k < 4; ++k) visit(number++, i, j, k);
}

double least_of(const Coefficients& c) { return *std::min_element(c.begin(), c.end()); }

double least_at_corners(const Coefficients& c) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) least = std::min(least, c[coefficient_numbers[i][i][i]]);
    return least;
}

// Returns the coefficients when a corner moves to the middle of its edge to another one.
Coefficients with_corner_at_middle(const Coefficients& before, std::size_t moved, std::size_t fixed) {
    PolarForm form;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) form[i][j][k] = before[coefficient_numbers[i][j][k]];
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k) form[moved][j][k] = (form[moved][j][k] + form[fixed][j][k]) / 2;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k) form[i][moved][k] = (form[i][moved][k] + form[i][fixed][k]) / 2;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) form[i][j][moved] = (form[i][j][moved] + form[i][j][fixed]) / 2;
    Coefficients after;
    for_coefficients(
        [&](std::size_t number, std::size_t i, std::size_t j, std::size_t k) { after[number] = form[i][j][k]; });
    return after;
}

// A piece of the cell: the polynomial over it, and its corners in the reference tetrahedron.
struct Piece {
    Coefficients coefficients;
    std::array<Vec3, 4> corners;
    int depth;
};

std::array<Piece, 2> bisect(const Piece& piece) {
    std::size_t from = 0, to = 1;
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
            if (const double length = (piece.corners[j] - piece.corners[i]).squaredNorm(); length > longest) {
                longest = length;
                from = i;
                to = j;
            }
    std::array<Piece, 2> halves = {piece, piece};
    halves[0].coefficients = with_corner_at_middle(piece.coefficients, to, from);
    halves[1].coefficients = with_corner_at_middle(piece.coefficients, from, to);
    halves[0].corners[to] = halves[1].corners[from] = (piece.corners[from] + piece.corners[to]) / 2;
    for (Piece& half : halves) ++half.depth;
    return halves;
}

Piece whole_cell(const Coefficients& coefficients) {
    return {coefficients, {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}, 0};
}

}  // namespace

TetNodes straight_nodes(const std::array<Vec3, 4>& corners) {
    TetNodes nodes;
    std::copy(corners.begin(), corners.end(), nodes.begin());
    for (std::size_t e = 0; e < tet_edges.size(); ++e)
        nodes[4 + e] = 0.5 * (corners[tet_edges[e][0]] + corners[tet_edges[e][1]]);
    return nodes;
}

CurvedTetJacobian::CurvedTetJacobian(const TetNodes& nodes) {
    std::array<std::array<Vec3, 4>, 4> control;  // points, from corner 0
    for (std::size_t i = 0; i < 4; ++i) control[i][i] = nodes[i] - nodes[0];
    for (std::size_t e = 0; e < tet_edges.size(); ++e) {
        const auto& [i, j] = tet_edges[e];
        control[i][j] = control[j][i] = 2 * (nodes[4 + e] - nodes[0]) - (control[i][i] + control[j][j]) / 2;
    }
    std::array<std::array<Vec3, 4>, 4> slope;  // slope[k][j]: the derivative towards corner k at corner j
    double longest = 0;
    for (std::size_t k = 1; k < 4; ++k)
        for (std::size_t j = 0; j < 4; ++j) {
            slope[k][j] = 2 * (control[k][j] - control[0][j]);
            longest = std::max(longest, slope[k][j].norm());
        }
    const auto volume = [&](std::size_t a, std::size_t b, std::size_t c) {
        return slope[1][a].cross(slope[2][b]).dot(slope[3][c]);
    };
    for_coefficients([&](std::size_t number, std::size_t i, std::size_t j, std::size_t k) {
        coefficients_[number] = (volume(i, j, k) + volume(i, k, j) + volume(j, i, k) + volume(j, k, i) +
                                 volume(k, i, j) + volume(k, j, i)) /
                                6;
    });
    straight_ = control[1][1].cross(control[2][2]).dot(control[3][3]);
    rounding_ = determinant_roundings * std::numeric_limits<double>::epsilon() * longest * longest * longest;
}

CellValidity CurvedTetJacobian::validity() const {
    if (least_at_corners(coefficients_) <= 0) return CellValidity::invalid;
    std::vector<Piece> pieces;
    if (!(least_of(coefficients_) > rounding_)) pieces.push_back(whole_cell(coefficients_));
    for (int looked_at = 0; !pieces.empty(); ++looked_at) {
        const Piece piece = pieces.back();
        pieces.pop_back();
        if (piece.depth == deepest_bisection || looked_at == most_pieces) return CellValidity::undecided;
        for (const Piece& half : bisect(piece)) {
            if (least_at_corners(half.coefficients) <= 0) return CellValidity::invalid;
            if (!(least_of(half.coefficients) > rounding_)) pieces.push_back(half);
        }
    }
    return CellValidity::valid;
}

// The integral of each Bernstein polynomial over the reference tetrahedron, of volume 1/6, is the same.
double CurvedTetJacobian::volume() const {
    return std::accumulate(coefficients_.begin(), coefficients_.end(), 0.0) / (6 * coefficients_.size());
}

double CurvedTetJacobian::coarse_low() const { return least_of(coefficients_) - rounding_; }

// Bisects the piece that may have the least value until that cannot be much less than a value that is known.
JacobianBounds CurvedTetJacobian::bounds(double precision) const {
    double size = 0;
    for (const double c : coefficients_) size = std::max(size, std::abs(c));
    const auto is_higher = [](const Piece& a, const Piece& b) {
        return least_of(a.coefficients) > least_of(b.coefficients);
    };
    std::vector<Piece> heap = {whole_cell(coefficients_)};
    double high = least_at_corners(coefficients_);
    for (int looked_at = 0; looked_at < most_pieces; ++looked_at) {
        if (high - least_of(heap.front().coefficients) <= precision * size) break;
        if (heap.front().depth == deepest_bisection) break;
        std::pop_heap(heap.begin(), heap.end(), is_higher);
        const Piece piece = heap.back();
        heap.pop_back();
        for (const Piece& half : bisect(piece)) {
            high = std::min(high, least_at_corners(half.coefficients));
            heap.push_back(half);
            std::push_heap(heap.begin(), heap.end(), is_higher);
        }
    }
    return {least_of(heap.front().coefficients) - rounding_, high + rounding_};
}

double scaled_jacobian(const CurvedTetJacobian& jacobian) {
    return jacobian.bounds(precision_of_scaled).low / jacobian.straight();
}

}  // namespace kerf
