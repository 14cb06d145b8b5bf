// Draws triangles of second order, which have three corners and a node on each edge, in pieces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "viewer/model/camera.h"
#include "viewer/model/document.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// The corners between which the edges of a triangle lie, in the order of their nodes.
inline constexpr std::array<std::array<std::size_t, 2>, 3> ends_of_edges = {{{0, 1}, {1, 2}, {0, 2}}};

/// The places of the nodes on the edges of triangles or cells, and the values there, by the edges of EdgePoints.
struct DrawnEdges {
    std::span<const Vec3> places, rest;  ///< places as drawn, and when nothing is deformed
    std::span<const float> value;        ///< values there; empty: none

    bool empty() const { return places.empty(); }
};

/// A triangle as it is drawn: three corners, then the nodes on the edges 01, 12 and 02.
struct QuadraticTriangle {
    std::array<Vec3, 6> place, rest;
    std::array<float, 6> value = {};
    std::optional<std::array<Vec3, 3>> normals = std::nullopt;  ///< normals of the corners, for smooth shading

    /// Returns whether the edges are straight, with nodes in their middles.
    bool is_straight() const;
    /// Returns whether values change linearly, as far as colours tell.
    bool is_linear() const;
};

/// The vertices of a mesh: their places as drawn and when nothing is deformed, and values there; empty: none.
struct DrawnVertices {
    std::span<const Vec3> places, rest;
    std::span<const float> value;
};

/// Returns the triangle with the corners and edges of these numbers. `value` is that of all nodes if vertices have
/// none.
QuadraticTriangle quadratic_triangle(const DrawnVertices& vertices, const DrawnEdges& edges, const Triangle& corners,
                                     const std::array<std::int32_t, 3>& on_edges, float value);

/// Returns the shares of the six nodes at a point with these barycentric coordinates.
std::array<double, 6> quadratic_shares(const std::array<double, 3>& l);

/// Returns the number of pieces along each edge in which a triangle of a geometry of `count` triangles is drawn: 4 for
/// a curved one, or fewer where there are many; 2 for a straight one, through the values of its nodes, or 1 if these
/// are linear or there are very many. Edges between two curved triangles of a geometry have the same points from both
/// sides.
int pieces_of(const QuadraticTriangle& triangle, std::size_t count);

/// Adds pieces * pieces triangles. The edges of the whole triangle are drawn, those inside of it are not. Normals are
/// those of the curved face, if it is one, else those of the triangle's corners, if it has any. With `is_moved` the
/// places at rest are added, too.
void add_quadratic(Geometry& geometry, const Frame& frame, const QuadraticTriangle& triangle, int pieces,
                   std::int32_t element, bool is_moved);

}  // namespace kerf::view
