// An edge that is missing is crossed by faces and edges, and a triangle whose edges are there by edges (Si 2015,
// si2015). These crossings are removed one after another, the one next to an end first. A removal may change cells and
// still fail; that counts as progress, because other crossings may become removable, and the number of flips and of
// rings that are looked at is bounded.
#include "fill/shell/inside/flip_recovery.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/predicates.h"

namespace kerf {

namespace {
constexpr int most_flips_of_an_edge = 1000;
constexpr int most_flips_of_a_triangle = 100;
constexpr int most_rings = 500;  // most rings that are looked at for an edge or a triangle
constexpr int most_places_of_a_vertex = 4;
constexpr double farthest_behind = 0.4;  // share of a triangle's longest edge
}  // namespace

// --- edges ---

bool FlipRecovery::recover_edge(std::int32_t a, std::int32_t b, const FlipLimits& limits) {
    removal_.begin({Goal::edge(a, b), limits.depth, most_rings, limits.new_vertices});
    for (int flip = 0; flip < most_flips_of_an_edge; ++flip) {
        const Crossing crossing = crossing_of(t_, a, b);
        if (crossing.has_end) return true;
        if (clear(crossing) || clear(crossing_of(t_, b, a))) continue;
        if (!limits.is_anywhere || removal_.is_exhausted() || !clear_anywhere(a, b)) break;
    }
    return crossing_of(t_, a, b).has_end;
}

// Removes a face or an edge that is crossed. True if there is none.
bool FlipRecovery::clear(const Crossing& crossing) {
    if (crossing.has_end) return true;
    if (!crossing.cell.is_valid()) return false;
    if (crossing.is_through_edge()) return removal_.remove(crossing.cell, crossing.edge[0], crossing.edge[1]);
    const std::int32_t d = t_.opposite_vertex(crossing.face), e = t_.opposite_vertex(t_.mirror(crossing.face));
    if (e < 0) return false;
    const Triangle f = t_.face_vertices(crossing.face);
    const auto& p = t_.points();
    for (int i = 0; i < 3; ++i)
        if (orientation(p[d], p[f[i]], p[f[(i + 1) % 3]], p[e]) <= 0)
            return removal_.remove(crossing.cell, f[i], f[(i + 1) % 3]);
    return replace_face_by_edge(t_, crossing.face);
}

// Removes anything that is crossed, or makes a change at least that may help others.
bool FlipRecovery::clear_anywhere(std::int32_t a, std::int32_t b) {
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}})
        for (const Crossing& crossing : crossings_of(t_, from, to))
            if (clear(crossing) || removal_.has_changed()) return true;
    return false;
}

// --- triangles whose edges are there ---

bool FlipRecovery::recover_face(const Triangle& triangle, const FlipLimits& limits) {
    removal_.begin({Goal::triangle(triangle), limits.depth, most_rings, limits.new_vertices});
    for (int flip = 0; flip < most_flips_of_a_triangle && find_face(t_, triangle) == SpatialTriangulation::none; ++flip)
        if (removal_.is_exhausted() || !clear_face(triangle)) break;
    return find_face(t_, triangle) != SpatialTriangulation::none;
}

// Removes an edge that goes through the triangle, or makes a change at least. False if there is none, or it cannot be.
bool FlipRecovery::clear_face(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    for (const Triangle& turned : {Triangle{a, b, c}, Triangle{b, c, a}, Triangle{c, a, b}})
        for (const PiercingEdge& at : edges_through(t_, turned))
            if (removal_.remove(at.cell, at.edge[0], at.edge[1]) || removal_.has_changed()) return true;
    return false;
}

// --- vertices ---

// The vertex comes behind the triangle, because in front of it there may be no cell.
bool FlipRecovery::insert_behind(const Triangle& triangle, const Vec3& p, std::size_t most_removed) {
    const Vec3 a = t_.points()[triangle[0]], b = t_.points()[triangle[1]], c = t_.points()[triangle[2]];
    const Vec3 inwards = (c - a).cross(b - a).normalized();
    const double length = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const auto before = count_of(t_.points());
    const auto is_free = [&](const Star& star) { return may_be_removed(t_, star.removed, is_kept_); };
    for (int tries = 0; tries < most_places_of_a_vertex; ++tries) {
        const double share = farthest_behind * (0.1 + some_share()) / (1 << tries), x = some_share() / 2,
                     y = some_share() / 2;
        const Vec3 behind = p + share * (length * inwards + x * (b - p) + y * (c - p));
        if (!behind.allFinite()) continue;
        const InsertionConditions conditions = {.accepts = is_free, .most_removed = most_removed};
        if (t_.insert_if(behind, t_.cell_at(triangle[0]), conditions) >= before) return true;
    }
    return false;
}

// Returns a number from 0 to 1, different each time, but the same in every run.
double FlipRecovery::some_share() { return static_cast<double>(random_()) / std::minstd_rand::max(); }

}  // namespace kerf
