// The cells of a ring are replaced by triangles of the polygon of its vertices, each of which makes two cells, one with
// either end of the edge (Klincsek 1980, klincsek1980, for the best triangulation). `kept` vertices divide the polygon
// into one on each side of the edge between them, or three around a triangle. Only signs of exact orientations decide
// whether cells are positive; their badness decides which are best, and is finite for positive cells that are flat in
// doubles. The ghost may be a vertex of the ring: cells with it lie outside, and the ring's edge must lie in the plane
// of the two other vertices. Where a polygon has no positive cells, a new vertex next to its closing edge may see all
// of its outer faces.
#include "fill/shell/inside/ring_flips.h"

#include <algorithm>
#include <limits>

#include "base/geometry/predicates.h"
#include "fill/improve/cell_shape.h"
#include "fill/improve/polygon_triangulation.h"

namespace kerf {

namespace {

constexpr std::size_t most_cells_of_a_ring = 40;
constexpr double least_share_of_star = 1e-4;
// A share that keeps the new vertex out of the plane of the polygon, where other triangles may be wanted.
constexpr double share_towards_end = 0.2;
constexpr double impossible = std::numeric_limits<double>::infinity();

int orientation_of(const SpatialTriangulation& t, const Tetrahedron& v) {
    const auto& points = t.points();
    return orientation(points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
}

double badness_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (orientation(a, b, c, d) <= 0) return impossible;
    const double badness = cell_shape(a, b, c, d).badness();
    constexpr double most = std::numeric_limits<double>::max();
    return badness < most ? badness : most;  // infinite or no number where it is flat in doubles
}

double badness_of(const SpatialTriangulation& t, const Tetrahedron& v) {
    const auto& points = t.points();
    return badness_of(points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
}

// Returns the worst badness of the cells between a point, the polygon of a ring's vertices, and the ring's two ends.
double badness_of_star(const SpatialTriangulation& t, const EdgeRing& ring, const std::vector<std::int32_t>& polygon,
                       const Vec3& centre) {
    const auto& points = t.points();
    double worst = 0;
    for (std::size_t k = 0; k < polygon.size() && worst < impossible; ++k) {
        const Vec3 &p = points[polygon[k]], &q = points[polygon[(k + 1) % polygon.size()]];
        worst = std::max({worst, badness_of(points[ring.a], centre, p, q), badness_of(centre, points[ring.b], p, q)});
    }
    return worst;
}

// Returns the point of the line through a and b that is nearest to the one through c and d; the middle of a and b if
// that lies beyond one of them.
Vec3 nearest_to_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = d - c, normal = u.cross(v);
    const double share = (c - a).cross(v).dot(normal) / normal.squaredNorm();
    return share > 0 && share < 1 ? Vec3(a + share * u) : Vec3((a + b) / 2);
}

// Returns the cell with the ghost, if it is a corner, in the last place.
Tetrahedron with_ghost_last(Tetrahedron v) {
    const auto i = std::find(v.begin(), v.end(), SpatialTriangulation::ghost) - v.begin();
    if (i >= 3) return v;
    std::swap(v[i], v[3]);
    std::swap(v[(i + 1) % 3], v[(i + 2) % 3]);
    return v;
}

// Returns the worse badness of the two cells of a triangle in the ring. With the ghost they lie outside, and the edge
// must lie in the plane of the other two vertices.
double badness_of_pair(const SpatialTriangulation& t, const EdgeRing& ring, std::int32_t p, std::int32_t q,
                       std::int32_t r) {
    const Tetrahedron below = {ring.a, p, q, r}, above = {p, q, r, ring.b};
    if (std::min({p, q, r}) >= 0) return std::max(badness_of(t, below), badness_of(t, above));
    const std::int32_t u = p < 0 ? q : p, v = r < 0 ? q : r;
    return orientation_of(t, {ring.a, ring.b, u, v}) == 0 ? 0 : impossible;
}

// Whether the goal allows the faces and edges that come with the two cells of a triangle p, q, r in the ring; the edge
// from p to r is new, too, if `has_diagonal`.
bool allows_pair(const SpatialTriangulation& t, const EdgeRing& ring, const Triangle& triangle, bool has_diagonal,
                 const Goal& goal) {
    const auto& [p, q, r] = triangle;
    if (goal.corners().empty()) return true;
    if (!goal.allows_face(t, triangle)) return false;
    return !has_diagonal ||
           (goal.allows_edge(t, p, r) && goal.allows_face(t, {p, r, ring.a}) && goal.allows_face(t, {p, r, ring.b}));
}

// Appends the cells of a polygon of the ring's vertices. False if there are none that are positive.
bool append_polygon(const SpatialTriangulation& t, const EdgeRing& ring, const std::vector<std::int32_t>& polygon,
                    const Goal& goal, std::vector<Tetrahedron>& cells) {
    PolygonTriangulation<most_cells_of_a_ring> triangles;
    const auto badness = [&](std::size_t i, std::size_t j, std::size_t k, double) {
        const double worse = badness_of_pair(t, ring, polygon[i], polygon[j], polygon[k]);
        if (worse == impossible) return impossible;
        const bool has_diagonal = k - i > 1 && k - i + 1 < ring.size();
        return allows_pair(t, ring, {polygon[i], polygon[j], polygon[k]}, has_diagonal, goal) ? worse : impossible;
    };
    if (!triangles.find(polygon.size(), impossible, badness)) return false;
    triangles.for_each_triangle([&](std::size_t i, std::size_t j, std::size_t k) {
        cells.push_back(with_ghost_last({ring.a, polygon[i], polygon[j], polygon[k]}));
        cells.push_back(with_ghost_last({polygon[i], polygon[j], polygon[k], ring.b}));
    });
    return true;
}

// Appends the cells between the polygon of a ring's vertices, its two ends, and a new vertex, which is added. It comes
// to lie next to the closing edge, from where the ring's own edge, which is near, sees all of these cells' outer faces.
// False, and there is no new vertex, if none of a few places makes positive cells.
bool append_star(SpatialTriangulation& t, const EdgeRing& ring, const std::vector<std::int32_t>& polygon,
                 std::vector<Tetrahedron>& cells) {
    if (std::find(polygon.begin(), polygon.end(), SpatialTriangulation::ghost) != polygon.end()) return false;
    const auto point = [&](std::int32_t v) -> const Vec3& { return t.points()[v]; };
    const Vec3 start = nearest_to_line(point(polygon.front()), point(polygon.back()), point(ring.a), point(ring.b));
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) middle += point(polygon[k]);
    middle /= polygon.size() - 2;
    Vec3 best;
    double least = impossible;
    for (const std::int32_t end : {ring.a, ring.b})
        for (double share = 0.5; share > least_share_of_star; share /= 2) {
            const Vec3 p = start + share * (middle + share_towards_end * (point(end) - middle) - start);
            const double badness = badness_of_star(t, ring, polygon, p);
            if (badness < least) least = badness, best = p;
        }
    if (least == impossible) return false;
    const std::int32_t centre = t.add_vertex(best);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::int32_t p = polygon[k], q = polygon[(k + 1) % polygon.size()];
        cells.push_back({ring.a, centre, p, q});
        cells.push_back({centre, ring.b, p, q});
    }
    return true;
}

std::vector<std::int32_t> polygon_between(const EdgeRing& ring, std::size_t from, std::size_t to) {
    std::vector<std::int32_t> polygon;
    for (std::size_t k = from; k != to; k = (k + 1) % ring.size()) polygon.push_back(ring.ring[k]);
    polygon.push_back(ring.ring[to]);
    return polygon;
}

bool append_cells(SpatialTriangulation& t, const EdgeRing& ring, const std::vector<std::int32_t>& polygon,
                  const Goal& goal, NewVertices new_vertices, std::vector<Tetrahedron>& cells) {
    if (append_polygon(t, ring, polygon, goal, cells)) return true;
    return new_vertices == NewVertices::allowed && append_star(t, ring, polygon, cells);
}

bool span_ring_between(SpatialTriangulation& t, const EdgeRing& ring, std::size_t from, std::size_t to,
                       const Goal& goal, NewVertices new_vertices) {
    const std::vector<std::int32_t> polygon = polygon_between(ring, from, to);
    const Tetrahedron middle = {ring.a, ring.b, polygon.front(), polygon.back()};
    if (std::min(middle[2], middle[3]) < 0 || polygon.size() < 3 || orientation_of(t, middle) <= 0) return false;
    std::vector<CellId> cells;
    for (std::size_t k = from; k != to; k = (k + 1) % ring.size()) {
        if (k != from && is_spoke_constrained(t, ring, k)) return false;
        cells.push_back(ring.cells[k]);
    }
    std::vector<Tetrahedron> made = {middle};
    if (!append_cells(t, ring, polygon, goal, new_vertices, made)) return false;
    t.replace(cells, made);
    return true;
}

}  // namespace

EdgeRing ring_around(const SpatialTriangulation& triangulation, CellId cell, std::int32_t a, std::int32_t b) {
    EdgeRing ring;
    const Tetrahedron& vertices = triangulation.vertices(cell);
    find_ring(triangulation, cell, index_of(vertices, a), index_of(vertices, b), ring);
    return ring;
}

bool remove_ring_edge(SpatialTriangulation& triangulation, const EdgeRing& ring, std::span<const std::int32_t> kept,
                      const Goal& goal, NewVertices new_vertices) {
    if (ring.size() > most_cells_of_a_ring) return false;
    std::vector<std::size_t> corners;
    for (const std::int32_t vertex : kept) {
        corners.push_back(ring.place_of(vertex));
        if (corners.back() == ring.size()) return false;
    }
    std::sort(corners.begin(), corners.end());
    if (corners.empty()) corners = {0, ring.size() - 1};
    for (std::size_t k = 0; k < ring.size(); ++k)
        if (is_spoke_constrained(triangulation, ring, k)) return false;
    std::vector<Tetrahedron> made;
    if (corners.size() == 3 &&
        !append_polygon(triangulation, ring, {ring.ring[corners[0]], ring.ring[corners[1]], ring.ring[corners[2]]},
                        goal, made))
        return false;
    const std::size_t vertices = triangulation.points().size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto polygon = polygon_between(ring, corners[k], corners[(k + 1) % corners.size()]);
        if (append_cells(triangulation, ring, polygon, goal, new_vertices, made)) continue;
        triangulation.remove_unused_vertices(vertices);
        return false;
    }
    triangulation.replace(ring.cells, made);
    return true;
}

bool span_ring(SpatialTriangulation& triangulation, const EdgeRing& ring, std::int32_t a, std::int32_t b,
               const Goal& goal, NewVertices new_vertices) {
    const std::size_t from = ring.place_of(a), to = ring.place_of(b);
    if (from == ring.size() || to == ring.size() || ring.size() > most_cells_of_a_ring) return false;
    return span_ring_between(triangulation, ring, from, to, goal, new_vertices) ||
           span_ring_between(triangulation, ring, to, from, goal, new_vertices);
}

bool replace_face_by_edge(SpatialTriangulation& triangulation, CellFace face, const Goal& goal) {
    const CellFace behind = triangulation.mirror(face);
    const std::int32_t a = triangulation.opposite_vertex(face), b = triangulation.opposite_vertex(behind);
    if (a < 0 || b < 0 || triangulation.is_constrained(face) || triangulation.is_ghost(cell_of(face))) return false;
    const Triangle corners = triangulation.face_vertices(face);
    std::vector<Tetrahedron> made;
    for (int i = 0; i < 3; ++i) {
        made.push_back({a, corners[i], corners[(i + 1) % 3], b});
        if (orientation_of(triangulation, made.back()) <= 0 || !goal.allows_face(triangulation, {a, b, corners[i]}))
            return false;
    }
    if (!goal.allows_edge(triangulation, a, b)) return false;
    const std::array<CellId, 2> cells = {cell_of(face), cell_of(behind)};
    triangulation.replace(cells, made);
    return true;
}

}  // namespace kerf
