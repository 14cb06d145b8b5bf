// A missing edge is split where a face or an edge of a cell crosses it, nearest to its middle first; a missing triangle
// with all edges is split where an edge pierces it. The foot is the point that is split, on the given triangle of which
// the missing one is a part; the vertex lies above it, inwards, by the height of the dome, curvature x (s t |ab|^2 + t
// u |bc|^2 + u s |ca|^2) for barycentric coordinates s, t, u: the power of the point to the circle of the given
// triangle. On an edge that is the product of the distances to its ends, so that two given triangles agree there. The
// vertex goes in by a Delaunay cavity that must contain all cells in the way, or, where that fails, in the place of
// those cells and of as many others as it needs to see all faces around. If neither works, it is tried nearer to the
// foot.
//
// Cells between a triangle and its parts are caps; flips of parts within one given triangle, which keep these Delaunay
// in their plane, add a cap each. Orientation is exact, so a cap is never flat or turned.
#include "fill/shell/inside/boundary_splitting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/predicates.h"
#include "fill/shell/inside/crossing.h"

namespace kerf {

namespace {

constexpr double most_rise = 0.3;  // share of the distance to the next edge
constexpr double smaller = 0.125;
constexpr int most_tries = 4;
constexpr std::size_t most_cells_of_a_cavity = 60;
// Crossings are counted from both ends, so twice. Where there are more, the edge is halved: halves have fewer.
constexpr std::size_t most_crossings_of_an_edge = 6;

// Returns a direction that leads inwards from the planes of both triangles, as far from each as can be. Seen from
// outside they are (a, b, c) and (b, a, d).
Vec3 between(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 along = (b - a).normalized();
    const Vec3 n = (c - a).cross(b - a).normalized(), m = (b - a).cross(d - a).normalized();
    constexpr double least_sum = 0.5;
    if ((n + m).norm() > least_sum) return (n + m).normalized();
    // The triangles nearly cover each other: towards them where the body is between them, else away from them.
    const Vec3 u = along.cross(n), v = m.cross(along);
    const Vec3 towards = (u + v).normalized();
    return towards.dot(n) > 0 && towards.dot(m) > 0 ? towards : -towards;
}

// The share of the line from a to b that is before the plane of p, q, r.
double share_before(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 normal = (q - p).cross(r - p);
    return (p - a).dot(normal) / (b - a).dot(normal);
}

// The share of the line from a to b that is before the point nearest to the line from p to q.
double share_before(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
    const Vec3 u = b - a, v = q - p, normal = u.cross(v);
    return (p - a).cross(v).dot(normal) / normal.squaredNorm();
}

template <class All, class One>
bool contains(const All& all, const One& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

// Tries crossings near the middle of the edge first: a vertex next to another makes thin cells.
bool BoundarySplitting::split_edge(std::int32_t a, std::int32_t b) {
    struct Candidate {
        Crossing crossing;
        double off_middle;
    };
    std::vector<Candidate> candidates;
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}})
        for (const Crossing& crossing : crossings_of(t_, from, to)) {
            Place place;
            if (const std::optional<double> share = find_place(crossing, a, b, place))
                candidates.push_back({crossing, std::abs(*share - 0.5)});
        }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& x, const Candidate& y) { return x.off_middle < y.off_middle; });
    if (candidates.size() > most_crossings_of_an_edge) {
        Place place;
        find_place(candidates[0].crossing, a, b, place);
        place.is_anywhere = true;
        if (split_edge_at(a, b, place, 0.5)) return true;
    }
    return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
        Place place;
        const double share = *find_place(candidate.crossing, a, b, place);
        return split_edge_at(a, b, place, share);
    });
}

std::optional<double> BoundarySplitting::find_place(const Crossing& crossing, std::int32_t a, std::int32_t b,
                                                    Place& place) const {
    if (!crossing.cell.is_valid() || crossing.has_end) return std::nullopt;
    double share = 0;
    if (crossing.is_through_edge()) {
        const auto [p, q] = crossing.edge;
        place.cavity = cavity_of_edge(crossing.cell, p, q);
        share = share_before(point(a), point(b), point(p), point(q));
    } else if (!t_.is_constrained(crossing.face) && !t_.is_ghost(cell_of(t_.mirror(crossing.face)))) {
        const auto [p, q, r] = t_.face_vertices(crossing.face);
        place.cavity = {crossing.cell, cell_of(t_.mirror(crossing.face))};
        share = share_before(point(a), point(b), point(p), point(q), point(r));
    }
    if (place.cavity.empty() || !(share > 0 && share < 1)) return std::nullopt;
    return share;
}

// The given triangle, turned so that the edge that it has in common with its neighbour is the first.
Triangle BoundarySplitting::turned(Triangle given, const Triangle& neighbour) {
    for (int i = 0; i < 2 && (!contains(neighbour, given[0]) || !contains(neighbour, given[1])); ++i)
        std::rotate(given.begin(), given.begin() + 1, given.end());
    return given;
}

bool BoundarySplitting::split_edge_at(std::int32_t a, std::int32_t b, Place& place, double share) {
    const std::vector<std::int32_t> numbers = missing_.at_edge(a, b);
    for (const std::int32_t number : numbers) {
        Triangle t = missing_.triangle(number);  // turned so that the edge is the first
        while (undirected(t[0], t[1]) != undirected(a, b)) std::rotate(t.begin(), t.begin() + 1, t.end());
        place.triangles.push_back(t);
        place.around.insert(place.around.end(), {undirected(t[1], t[2]), undirected(t[2], t[0])});
    }
    if (place.triangles.size() != 2 || place.triangles[0][0] == place.triangles[1][0]) return false;
    place.foot = foot(a) + share * (foot(b) - foot(a));
    const std::int32_t origin = missing_.origin(numbers[0]), other = missing_.origin(numbers[1]);
    place.inwards = inward_normal(origin);
    place.rise = height(origin, place.foot);
    if (origin != other) {
        const Triangle f = turned(given_[origin], given_[other]), g = turned(given_[other], given_[origin]);
        const Vec3 normal = place.inwards;
        place.inwards = between(point(f[0]), point(f[1]), point(f[2]), point(g[2]));
        place.rise /= place.inwards.dot(normal);
    }
    const std::optional<std::int32_t> vertex = insert(place);
    if (!vertex) return false;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const auto [u, v, w] = place.triangles[k];
        replace(numbers[k], *vertex, {{u, *vertex, w}, {*vertex, v, w}});
    }
    flip_parts();
    return true;
}

bool BoundarySplitting::split_triangle(std::int32_t number) {
    const Triangle triangle = missing_.triangle(number);
    const auto& [a, b, c] = triangle;
    const std::int32_t origin = missing_.origin(number);
    for (const PiercingEdge& at : edges_through(t_, triangle)) {
        const auto [p, q] = at.edge;
        Place place;
        place.cavity = cavity_of_edge(at.cell, p, q);
        if (place.cavity.empty()) continue;
        const Vec3 x =
            point(p) + share_before(point(p), point(q), point(a), point(b), point(c)) * (point(q) - point(p));
        const Vec3 share = closest_barycentric(x, point(a), point(b), point(c));
        place.foot = share[0] * foot(a) + share[1] * foot(b) + share[2] * foot(c);
        place.inwards = inward_normal(origin);
        place.rise = height(origin, place.foot);
        place.triangles = {triangle};
        place.around = {undirected(a, b), undirected(b, c), undirected(c, a)};
        const std::optional<std::int32_t> vertex = insert(place);
        if (!vertex) continue;
        replace(number, *vertex, {{a, b, *vertex}, {b, c, *vertex}, {c, a, *vertex}});
        flip_parts();
        return true;
    }
    return false;
}

// --- the dome ---

const Vec3& BoundarySplitting::foot(std::int32_t vertex) const {
    const auto found = feet_.find(vertex);
    return found == feet_.end() ? point(vertex) : found->second;
}

Vec3 BoundarySplitting::inward_normal(std::int32_t origin) const {
    const auto& [a, b, c] = given_[origin];
    return (point(c) - point(a)).cross(point(b) - point(a)).normalized();
}

// Returns the height of the dome: by barycentric coordinates, the power of a point to the circle around its triangle,
// with the sign that is positive inside. On an edge it is the product of the distances to its ends, for any triangle.
double BoundarySplitting::height(std::int32_t origin, const Vec3& p) {
    if (curvature_ == 0) {
        double longest_sq = 0;
        for (const Triangle& t : given_)
            for (int i = 0; i < 3; ++i)
                longest_sq = std::max(longest_sq, (point(t[i]) - point(t[(i + 1) % 3])).squaredNorm());
        curvature_ = offset_ / std::sqrt(longest_sq);
    }
    const auto& [a, b, c] = given_[origin];
    const Vec3 share = closest_barycentric(p, point(a), point(b), point(c));
    return curvature_ * (share[0] * share[1] * (point(a) - point(b)).squaredNorm() +
                         share[1] * share[2] * (point(b) - point(c)).squaredNorm() +
                         share[2] * share[0] * (point(c) - point(a)).squaredNorm());
}

void BoundarySplitting::replace(std::int32_t number, std::int32_t vertex, const std::vector<Triangle>& by) {
    const auto [a, b, c] = missing_.triangle(number);
    caps_.push_back({vertex, a, b, c});
    missing_.replace(number, by);
    for (std::int32_t k = 0; k < count_of(by); ++k) fresh_.push_back(missing_.count() - 1 - k);
}

// Parts of a triangle are as in a Delaunay triangulation of its plane: where they are not, the dome is lower than it
// can be, and the cell between an edge and the one that takes its place is a cap.
void BoundarySplitting::flip_parts() {
    while (!fresh_.empty()) {
        const std::int32_t number = fresh_.back();
        fresh_.pop_back();
        for (int i = 0; i < 3 && missing_.is_missing(number); ++i) flip_part(number, i);
    }
}

void BoundarySplitting::flip_part(std::int32_t number, int i) {
    const Triangle& t = missing_.triangle(number);
    const std::int32_t x = t[i], y = t[(i + 1) % 3], u = t[(i + 2) % 3];
    const std::vector<std::int32_t> numbers = missing_.at_edge(x, y);
    if (numbers.size() != 2 || missing_.origin(numbers[0]) != missing_.origin(numbers[1])) return;
    const std::int32_t other = numbers[0] == number ? numbers[1] : numbers[0];
    std::int32_t v = u;
    for (const std::int32_t w : missing_.triangle(other))
        if (w != x && w != y) v = w;
    if (v == u || orientation(point(v), point(x), point(y), point(u)) <= 0) return;
    const Vec3 inwards = inward_normal(missing_.origin(number));
    const auto is_turned = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        return (foot(c) - foot(a)).cross(foot(b) - foot(a)).dot(inwards) <= 0;
    };
    if (is_turned(y, u, v) || is_turned(u, x, v)) return;
    caps_.push_back({v, x, y, u});
    missing_.replace(number, std::array<Triangle, 1>{{{y, u, v}}});
    missing_.replace(other, std::array<Triangle, 1>{{{u, x, v}}});
    fresh_.insert(fresh_.end(), {missing_.count() - 1, missing_.count() - 2});
}

// --- the cells ---

// Returns the cells around an edge, but ghosts; none where the edge or a face at it must stay.
std::vector<CellId> BoundarySplitting::cavity_of_edge(CellId cell, std::int32_t p, std::int32_t q) const {
    if (is_kept_(p, q)) return {};
    EdgeRing ring;
    find_ring(t_, cell, index_of(t_.vertices(cell), p), index_of(t_.vertices(cell), q), ring);
    for (std::size_t k = 0; k < ring.size(); ++k)
        if (is_spoke_constrained(t_, ring, k)) return {};
    std::erase_if(ring.cells, [&](CellId at) { return t_.is_ghost(at); });
    return ring.cells;
}

bool BoundarySplitting::is_behind(const Vec3& p, const Triangle& triangle) const {
    return orientation(p, point(triangle[0]), point(triangle[1]), point(triangle[2])) > 0;
}

// Grows the cavity by the cells behind sides that the point does not see, until it sees all sides: flat cells leave it
// no room. Returns false if one of them must stay.
bool BoundarySplitting::grow(std::vector<CellId>& cavity, const Vec3& p) const {
    for (bool is_seen = false; !is_seen;) {
        is_seen = true;
        for (const CellFace side : sides_of(t_, cavity)) {
            if (is_behind(p, t_.face_vertices(side))) continue;
            const CellId next = cell_of(t_.mirror(side));
            if (t_.is_constrained(side) || t_.is_ghost(next) || cavity.size() == most_cells_of_a_cavity) return false;
            if (!contains(cavity, next)) cavity.push_back(next);
            is_seen = false;
        }
    }
    return may_be_removed(t_, cavity, is_kept_);
}

double BoundarySplitting::distance_to_next(const Place& place) const {
    double least_sq = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : place.around) {
        const Vec3 nearest = closest_on_segment(place.foot, foot(a), foot(b));
        least_sq = std::min(least_sq, (nearest - place.foot).squaredNorm());
    }
    return std::sqrt(least_sq);
}

// Inserts the new vertex; returns none if there is no place for it.
std::optional<std::int32_t> BoundarySplitting::insert(const Place& place) {
    double rise = std::min(place.rise, most_rise * distance_to_next(place));
    for (int tries = 0; tries < most_tries; ++tries, rise *= smaller) {
        const Vec3 p = place.foot + rise * place.inwards;
        if (!p.allFinite() || !std::all_of(place.triangles.begin(), place.triangles.end(),
                                           [&](const Triangle& triangle) { return is_behind(p, triangle); }))
            continue;
        const auto removes_all = [&](std::span<const CellId> removed) {
            return place.is_anywhere || std::all_of(place.cavity.begin(), place.cavity.end(),
                                                    [&](CellId cell) { return contains(removed, cell); });
        };
        std::optional<std::int32_t> vertex = insert_if(p, place, removes_all);
        if (!vertex && !place.is_anywhere) vertex = insert_alone(p, place);
        if (!vertex) continue;
        feet_.emplace(*vertex, place.foot);
        return vertex;
    }
    return std::nullopt;
}

// Inserts a vertex in the place of cells whose spheres contain it and whose outer faces it sees, on this side of all
// triangles that are faces already.
template <class Accepts>
std::optional<std::int32_t> BoundarySplitting::insert_if(const Vec3& p, const Place& place, const Accepts& accepts) {
    const auto before = count_of(t_.points());
    const CellId at = t_.locate_in_sight(p, place.cavity[0]);
    if (!at.is_valid()) return std::nullopt;
    const auto is_free = [&](const Star& star) {
        return accepts(star.removed) && may_be_removed(t_, star.removed, is_kept_);
    };
    const std::int32_t vertex = t_.insert_if(p, at, {.accepts = is_free, .most_removed = most_cells_of_a_cavity});
    return vertex == before ? std::optional(vertex) : std::nullopt;
}

// Inserts a vertex in the place of the cells that it must remove, and of those that leave it no room.
std::optional<std::int32_t> BoundarySplitting::insert_alone(const Vec3& p, const Place& place) {
    std::vector<CellId> cavity = place.cavity;
    if (!grow(cavity, p)) return std::nullopt;
    const std::int32_t vertex = t_.add_vertex(p);
    std::vector<Tetrahedron> cells;
    for (const CellFace side : sides_of(t_, cavity)) {
        const auto [a, b, c] = t_.face_vertices(side);
        cells.push_back({vertex, a, b, c});
    }
    t_.replace(cavity, cells);
    return vertex;
}

}  // namespace kerf
