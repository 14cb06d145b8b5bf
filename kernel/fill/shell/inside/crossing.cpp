// A line from a to b is followed by exact orientations alone (Shewchuk 1997, shewchuk1997). It leaves a cell through
// the face whose three edges all have it on their inner side; one orientation of zero says that it leaves through that
// edge, two that it meets a vertex, which is no crossing. The walk stops there, because behind an edge it could go on
// in more than one cell. An edge pierces a triangle if its ends are on different sides of the plane, and all edges of
// the triangle turn around it the same way; touching counts as no.
#include "fill/shell/inside/crossing.h"

#include <algorithm>

#include "base/geometry/predicates.h"

namespace kerf {

namespace {

constexpr std::size_t most_crossings = 1000;

int orient(const SpatialTriangulation& t, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    const auto& p = t.points();
    return orientation(p[a], p[b], p[c], p[d]);
}

// Whether the line from a to b leaves the cell through the face, or through an edge of it; fills `crossing` if so.
bool leaves_through(const SpatialTriangulation& t, CellFace face, std::int32_t a, std::int32_t b, Crossing& crossing) {
    const Triangle corners = t.face_vertices(face);
    int zeros = 0, on_edge = 0;
    for (int i = 0; i < 3; ++i) {
        const int side = orient(t, corners[i], corners[(i + 1) % 3], a, b);
        if (side < 0) return false;
        if (side == 0) ++zeros, on_edge = i;
    }
    if (zeros > 1) return false;
    crossing.cell = cell_of(face);
    crossing.face = face;
    if (zeros == 1) crossing.edge = {corners[on_edge], corners[(on_edge + 1) % 3]};
    return true;
}

// Whether the edge between p and q goes through the inside of the triangle.
bool pierces(const SpatialTriangulation& t, std::int32_t p, std::int32_t q, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    if (std::find(triangle.begin(), triangle.end(), p) != triangle.end() ||
        std::find(triangle.begin(), triangle.end(), q) != triangle.end())
        return false;
    if (orient(t, a, b, c, p) * orient(t, a, b, c, q) >= 0) return false;
    const int side = orient(t, p, q, a, b);
    return side != 0 && orient(t, p, q, b, c) == side && orient(t, p, q, c, a) == side;
}

// Whether the face is the triangle, seen from the cell that sees it clockwise.
bool is_face(const SpatialTriangulation& triangulation, CellFace face, const Triangle& triangle) {
    if (triangulation.opposite_vertex(face) == triangle[0]) return false;
    Triangle there = triangulation.face_vertices(face);
    std::rotate(there.begin(), std::find(there.begin(), there.end(), triangle[0]), there.end());
    return there == triangle;
}

}  // namespace

Crossing crossing_of(SpatialTriangulation& triangulation, std::int32_t a, std::int32_t b) {
    Crossing crossing;
    for (const CellId cell : triangulation.cells_around_vertex(a)) {
        if (index_of(triangulation.vertices(cell), b) < 4) {
            crossing.cell = cell;
            crossing.has_end = true;
            return crossing;
        }
        if (!crossing.cell.is_valid() && !triangulation.is_ghost(cell))
            leaves_through(triangulation, cell_face(cell, index_of(triangulation.vertices(cell), a)), a, b, crossing);
    }
    return crossing;
}

std::vector<Crossing> crossings_of(SpatialTriangulation& triangulation, std::int32_t a, std::int32_t b) {
    std::vector<Crossing> crossings;
    Crossing next = crossing_of(triangulation, a, b);
    while (next.cell.is_valid() && !next.has_end && crossings.size() < most_crossings) {
        crossings.push_back(next);
        if (next.is_through_edge()) break;
        const CellFace from = triangulation.mirror(next.face);
        if (triangulation.is_ghost(cell_of(from)) || triangulation.opposite_vertex(from) == b) break;
        next = {};
        for (int i = 0; i < 4 && !next.cell.is_valid(); ++i)
            if (i != index_in_cell(from)) leaves_through(triangulation, cell_face(cell_of(from), i), a, b, next);
    }
    return crossings;
}

std::vector<PiercingEdge> edges_through(SpatialTriangulation& triangulation, const Triangle& triangle) {
    std::vector<PiercingEdge> edges;
    for (const CellId cell : triangulation.cells_around_vertex(triangle[0])) {
        if (triangulation.is_ghost(cell)) continue;
        const Triangle far =
            triangulation.face_vertices(cell_face(cell, index_of(triangulation.vertices(cell), triangle[0])));
        for (int k = 0; k < 3; ++k)
            if (pierces(triangulation, far[k], far[(k + 1) % 3], triangle))
                edges.push_back({cell, {far[k], far[(k + 1) % 3]}});
    }
    return edges;
}

CellFace find_face(SpatialTriangulation& triangulation, const Triangle& triangle) {
    for (const CellId cell : triangulation.cells_around_vertex(triangle[0]))
        for (int i = 0; i < 4; ++i)
            if (is_face(triangulation, cell_face(cell, i), triangle)) return cell_face(cell, i);
    return SpatialTriangulation::none;
}

}  // namespace kerf
