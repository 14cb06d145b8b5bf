// Triangles of second order: corners, and a node on each edge.
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

/// Where the nodes on the edges of triangles or cells are, and what is there. Spans by the edges of EdgePoints.
struct DrawnEdges {
    std::span<const Vec3> places, rest;  ///< as drawn, and when nothing is deformed
    std::span<const float> value;        ///< empty: none

    bool empty() const { return places.empty(); }
};

/// A triangle as it is drawn: three corners, then nodes on the edges 01, 12 and 02.
struct QuadraticTriangle {
    std::array<Vec3, 6> place, rest;
    std::array<float, 6> value = {};
    std::optional<std::array<Vec3, 3>> normals = std::nullopt;  ///< of the corners, for smooth shading

    /// Its edges are straight, with nodes in their middles.
    bool is_straight() const;
    /// Values change linearly, as far as colours tell.
    bool is_linear() const;
};

/// Vertices of something: their places as drawn and when nothing is deformed, and values there; empty: none.
struct DrawnVertices {
    std::span<const Vec3> places, rest;
    std::span<const float> value;
};

/// Of the corners and edges of these numbers. `value`: where vertices have none.
QuadraticTriangle quadratic_triangle(const DrawnVertices& vertices, const DrawnEdges& edges, const Triangle& corners,
                                     const std::array<std::int32_t, 3>& on_edges, float value);

/// The shares of the six nodes at a point with these barycentric coordinates.
std::array<double, 6> quadratic_shares(const std::array<double, 3>& l);

/// Into how many pieces along each edge a triangle of a geometry of so many is drawn: a curved one into 4, or fewer
/// where there are many; a straight one into 2, through the values of its nodes, or, if these are linear, into 1. Edges
/// between two curved triangles of a geometry have the same points from both sides.
int pieces_of(const QuadraticTriangle& triangle, std::size_t count);

/// Adds pieces * pieces triangles. The edges of the whole are drawn, those inside of it are not. Of a curved one the
/// normals are those of the curved face, else those of the triangle's corners, if it has any. With `is_moved`, rest
/// places too.
void add_quadratic(Geometry& geometry, const Frame& frame, const QuadraticTriangle& triangle, int pieces,
                   std::int32_t element, bool is_moved);

}  // namespace kerf::view
