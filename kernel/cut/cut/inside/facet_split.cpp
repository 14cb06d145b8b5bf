// Whether a vertex lies below a coordinate plane is one comparison of doubles, so no decision here is rounded. A new
// vertex is rounded across the edge, but lies on the plane exactly: interfaces in that plane are exactly plane.
#include "cut/cut/inside/facet_split.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/core/check.h"

namespace kerf {

namespace {

// Largest cosine of the angles of a triangle: falls as its smallest angle grows.
double sharpest_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = (b - a).normalized(), bc = (c - b).normalized(), ca = (a - c).normalized();
    return std::max({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
}

Vec3 point_on_edge(const Vec3& below, const Vec3& above, int axis, double height) {
    const double t = (height - below[axis]) / (above[axis] - below[axis]);
    Vec3 p = below + t * (above - below);
    p[axis] = height;
    return p;
}

bool any_alike(std::vector<Vec3> points) {
    const auto less = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::sort(points.begin(), points.end(), less);
    return std::adjacent_find(points.begin(), points.end()) != points.end();
}

// Divides the edges that cross the plane; the number of the new vertex per edge, -1 for none.
Array<Edge, std::int32_t> divide_edges(const Surface& surface, int axis, double height, PlaneSplit& split) {
    Array<Edge, std::int32_t> on_edge(surface.edge_count(), -1);
    std::int32_t next = surface.vertex_count();
    for (const Edge e : surface.edges()) {
        const HalfEdge h = Surface::first_half_edge(e);
        Vertex below = surface.from_vertex(h), above = surface.to_vertex(h);
        if ((surface.point(below)[axis] < height) == (surface.point(above)[axis] < height)) continue;
        if (surface.point(below)[axis] > height) std::swap(below, above);
        on_edge[e] = next;
        split.edges.push_back({below.value(), above.value(), next++});
    }
    return on_edge;
}

}  // namespace

TrianglePieces split_triangle(const Triangle& t, const std::array<std::int32_t, 3>& on_edge,
                              const std::vector<Vec3>& vertices) {
    const auto divided = std::count_if(on_edge.begin(), on_edge.end(), [](std::int32_t v) { return v >= 0; });
    KERF_CHECK(divided <= 2);
    if (divided == 0) return {{t}, 1};
    int i = 0;  // the divided edge, or the first of two that follow each other
    while (on_edge[i] < 0 || (divided == 2 && on_edge[(i + 1) % 3] < 0)) ++i;
    const std::int32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3], p = on_edge[i], q = on_edge[(i + 1) % 3];
    if (divided == 1) return {{{{a, p, c}, {p, b, c}}}, 2};
    // b is cut off; a, p, q, c remain.
    const auto& x = vertices;
    const double over_aq = std::max(sharpest_cosine(x[a], x[p], x[q]), sharpest_cosine(x[a], x[q], x[c]));
    const double over_pc = std::max(sharpest_cosine(x[a], x[p], x[c]), sharpest_cosine(x[p], x[q], x[c]));
    if (over_aq < over_pc || (over_aq == over_pc && a < c)) return {{{{p, b, q}, {a, p, q}, {a, q, c}}}, 3};
    return {{{{p, b, q}, {a, p, c}, {p, q, c}}}, 3};
}

std::optional<PlaneSplit> split_at_plane(const Surface& surface, int axis, double height, NodeId node) {
    KERF_CHECK(axis >= 0 && axis < 3 && node >= root_node);
    for (const Vertex v : surface.vertices())
        if (surface.point(v)[axis] == height) return std::nullopt;
    PlaneSplit split;
    const Array<Edge, std::int32_t> on_edge = divide_edges(surface, axis, height, split);
    SurfaceArrays whole = surface.arrays();
    split.arrays.vertices = std::move(whole.vertices);
    split.arrays.vertex_key = std::move(whole.vertex_key);
    std::vector<Vec3>& points = split.arrays.vertices;
    std::vector<Vec3> added;
    for (const SplitEdge& e : split.edges) {
        split.arrays.vertex_key.push_back(make_key(node, count_of(added)));
        added.push_back(point_on_edge(points[e.below], points[e.above], axis, height));
    }
    if (any_alike(added)) return std::nullopt;
    points.insert(points.end(), added.begin(), added.end());
    for (const Facet f : surface.facets()) {
        const auto h = surface.half_edges(f);
        const auto added_on = [&](int i) { return on_edge[Surface::edge_of(h[i])]; };
        const TrianglePieces pieces =
            split_triangle(whole.facets[f.value()], {added_on(0), added_on(1), added_on(2)}, points);
        for (int i = 0; i < pieces.count; ++i) {
            const Triangle& t = pieces.pieces[i];
            const bool below =
                std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return points[v][axis] < height; });
            split.arrays.facets.push_back(t);
            split.arrays.facet_key.push_back(surface.facet_key(f));
            split.arrays.patch.push_back(surface.patch(f));
            split.parent.push_back(f);
            split.side.push_back(below ? Side::below : Side::above);
        }
    }
    return split;
}

}  // namespace kerf
