// An edge that is missing is crossed by faces, and a triangle whose edges are there by edges. What is in the way is
// removed, nearest to the start first.
#include "shell/flip_recovery.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "geometry/predicates.h"

namespace kerf {

namespace {
constexpr int most_flips_of_an_edge = 40;
constexpr int most_rings_of_an_edge = 400;
constexpr int most_vertices_of_a_triangle = 3;
constexpr int most_places_of_a_vertex = 4;
constexpr double farthest_behind = 0.4;  // of a triangle's longest edge
}  // namespace

bool FlipRecovery::recover(const Triangle& triangle, const FlipLimits& limits) {
    limits_ = limits;
    vertices_left_ = most_vertices_of_a_triangle;
    const auto& points = t_.points();
    for (int i = 0; i < 3; ++i) {
        const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
        if (recover_edge(a, b)) continue;
        if (!insert_behind(triangle, (points[a] + points[b]) / 2) || !recover_edge(a, b)) return false;
    }
    recover_face(triangle);
    const CellFace face = find_face(t_, triangle);
    if (face == Triangulation::none) return false;
    t_.constrain(face);
    return true;
}

// --- vertices ---

// A new vertex behind a point of the triangle takes away long cells that are in the way. Behind, because in front of it
// may be nothing.
bool FlipRecovery::insert_behind(const Triangle& triangle, const Vec3& p) {
    if (limits_.new_vertices == NewVertices::none || --vertices_left_ < 0) return false;
    const Vec3 a = t_.points()[triangle[0]], b = t_.points()[triangle[1]], c = t_.points()[triangle[2]];
    const Vec3 inwards = (c - a).cross(b - a).normalized();
    const double length = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const auto before = static_cast<std::int32_t>(t_.points().size());
    for (int tries = 0; tries < most_places_of_a_vertex; ++tries) {
        const double share = farthest_behind * (0.1 + some_share()) / (1 << tries), x = some_share() / 2,
                     y = some_share() / 2;
        const Vec3 behind = p + share * (length * inwards + x * (b - p) + y * (c - p));
        if (behind.allFinite() && t_.insert(behind, t_.cell_at(triangle[0])) >= before) return true;
    }
    return false;
}

// From 0 to 1, different each time, the same in every run.
double FlipRecovery::some_share() { return static_cast<double>(random_()) / std::minstd_rand::max(); }

// --- edges ---

bool FlipRecovery::recover_edge(std::int32_t a, std::int32_t b) {
    rings_left_ = most_rings_of_an_edge;
    for (int flip = 0; flip < most_flips_of_an_edge; ++flip) {
        const Crossing crossing = crossing_of(t_, a, b);
        if (crossing.has_end) return true;
        if (clear(crossing, a, b)) continue;
        const Crossing from_end = crossing_of(t_, b, a);
        if (!clear(from_end, b, a) && !loosen(crossing) && !loosen(from_end)) return false;
    }
    return false;
}

// Takes away what the line from a to b crosses first.
bool FlipRecovery::clear(const Crossing& crossing, std::int32_t a, std::int32_t b) {
    if (crossing.cell == Triangulation::none) return false;
    if (crossing.is_through_edge()) return clear_edge(crossing.cell, crossing.edge[0], crossing.edge[1], a, b);
    if (t_.opposite_vertex(t_.mirror(crossing.face)) != b) {
        const Triangle corners = t_.face_vertices(crossing.face);
        for (int i = 0; i < 3; ++i)
            if (is_shared_by_crossed_faces(crossing.face, corners[i], corners[(i + 1) % 3], a, b) &&
                clear_edge(crossing.cell, corners[i], corners[(i + 1) % 3], a, b))
                return true;
    }
    return replace_face_by_edge(t_, crossing.face);
}

// Takes away any edge of the face that is crossed: other flips are possible then.
bool FlipRecovery::loosen(const Crossing& crossing) {
    if (crossing.cell == Triangulation::none) return false;
    const Triangle corners = t_.face_vertices(crossing.face);
    for (int i = 0; i < 3; ++i)
        if (remove_ring(ring_around(t_, crossing.cell, corners[i], corners[(i + 1) % 3]), {})) return true;
    return false;
}

// Whether the line, which crosses the face, leaves the next cell through a face with this edge, too.
bool FlipRecovery::is_shared_by_crossed_faces(CellFace face, std::int32_t p, std::int32_t q, std::int32_t a,
                                              std::int32_t b) const {
    const std::int32_t o = t_.opposite_vertex(t_.mirror(face));
    if (o < 0) return false;
    const auto& points = t_.points();
    return orientation(points[q], points[o], points[a], points[b]) >= 0 &&
           orientation(points[o], points[p], points[a], points[b]) >= 0;
}

bool FlipRecovery::clear_edge(std::int32_t cell, std::int32_t c, std::int32_t d, std::int32_t a, std::int32_t b) {
    const EdgeRing ring = ring_around(t_, cell, c, d);
    if (ring.place_of(b) < ring.size())
        if (span_ring(t_, ring, a, b, limits_.new_vertices) ||
            remove_ring(ring, std::array{a, b}, limits_.new_vertices))
            return true;
    return remove_edge(ring, std::array{a, b}, limits_.depth);
}

// --- edges in the way of others ---

bool FlipRecovery::remove_ring(const EdgeRing& ring, std::span<const std::int32_t> kept, NewVertices new_vertices) {
    return !(limits_.keeps_edges && missing_.has_edge(ring.a, ring.b)) &&
           remove_ring_edge(t_, ring, kept, new_vertices);
}

// Removes the edge, or at least some of those that lead from its ends to its ring, but to the `kept` vertices: then the
// ring has others.
bool FlipRecovery::remove_edge(const EdgeRing& ring, std::span<const std::int32_t> kept, int depth) {
    if (remove_ring(ring, {})) return true;
    if (depth == 0) return false;
    for (const std::int32_t v : ring.ring)
        for (const std::int32_t end : {ring.a, ring.b}) {
            if (v < 0 || std::find(kept.begin(), kept.end(), v) != kept.end()) continue;
            if (--rings_left_ < 0) return false;
            const std::int32_t cell = cell_with_edge(end, v);
            if (remove_edge(ring_around(t_, cell, end, v), kept, depth - 1)) return true;
        }
    return false;
}

std::int32_t FlipRecovery::cell_with_edge(std::int32_t c, std::int32_t d) {
    for (const std::int32_t cell : t_.cells_around_vertex(c))
        if (index_of(t_.vertices(cell), d) < 4) return cell;
    return Triangulation::none;
}

// --- triangles whose edges are there ---

void FlipRecovery::recover_face(const Triangle& triangle) {
    rings_left_ = most_rings_of_an_edge;
    for (int flip = 0; flip < most_flips_of_an_edge; ++flip)
        if (!clear_face(triangle)) return;
}

// Takes away an edge that goes through the triangle. False if there is none, or it cannot be.
bool FlipRecovery::clear_face(const Triangle& triangle) {
    bool is_pierced = false;
    for (const PiercingEdge& at : edges_through(t_, triangle)) {
        const EdgeRing ring = ring_around(t_, at.cell, at.edge[0], at.edge[1]);
        if (remove_ring(ring, triangle, limits_.new_vertices) || remove_edge(ring, triangle, limits_.depth))
            return true;
        is_pierced = true;
    }
    const auto& points = t_.points();
    return is_pierced && insert_behind(triangle, (points[triangle[0]] + points[triangle[1]] + points[triangle[2]]) / 3);
}

}  // namespace kerf
