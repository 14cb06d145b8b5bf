// Delaunay refinement (Ruppert 1995, ruppert1995; Chew 1993, chew1993) that never splits a contour edge, because these
// belong to the surface. Instead of splitting an edge that it encroaches, a point is not inserted; a contour edge stays
// by its constraint. Sizes grow from the contour inwards, so triangles beside contour edges that are much shorter than
// the bound do not become flat. Interior points are smoothed at the end, each move only if the worst triangle around
// the point does not suffer.
#include "cut/cut/planar_triangulation.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/error.h"
#include "surface/soup/planar_delaunay.h"

namespace kerf {

namespace {

constexpr double growth = 0.5;             // of the size per distance from the contour, or the opposite
constexpr double too_large = 1.5;          // circumradius x sqrt(3) over size
constexpr double too_flat = 1.1;           // circumradius over shortest edge; 1.1: smallest angle 27 degrees
constexpr double edge_clearance = 0.4;     // least distance of a point from a contour edge, in lengths of that edge
constexpr double vertex_clearance = 0.35;  // least distance of a point from a vertex, in sizes
constexpr double foreshortened = 0.6;      // of the given size: edges that are shorter are so in the plane only
constexpr int smoothing_sweeps = 8;

double cross_2d(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// True if two contour edges meet anywhere but in a shared end.
bool edges_cross(const PlanarRegion& region, const std::array<std::int32_t, 2>& e,
                 const std::array<std::int32_t, 2>& f) {
    const auto point = [&](std::int32_t i) -> const Vec2& { return region.contour[i]; };
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            if (e[i] == f[j])  // they meet elsewhere only if folded onto each other
                return segments_overlap(point(e[i]), point(e[1 - i]), point(f[1 - j]));
    return segments_meet(point(e[0]), point(e[1]), point(f[0]), point(f[1]));
}

// Contour vertices of all edges that cross, by a sweep over the lower ends of the x-intervals.
std::vector<std::int32_t> find_crossings(const PlanarRegion& region) {
    struct Interval {
        double low, high;
        std::int32_t edge;
    };
    std::vector<Interval> intervals;
    for (std::int32_t i = 0; i < count_of(region.edges); ++i) {
        const auto [low, high] =
            std::minmax(region.contour[region.edges[i][0]].x(), region.contour[region.edges[i][1]].x());
        intervals.push_back({low, high, i});
    }
    std::sort(intervals.begin(), intervals.end(),
              [](const Interval& a, const Interval& b) { return std::tie(a.low, a.edge) < std::tie(b.low, b.edge); });
    const auto y_range = [&](const std::array<std::int32_t, 2>& e) {
        return std::minmax({region.contour[e[0]].y(), region.contour[e[1]].y()});
    };
    std::vector<std::int32_t> failed;
    for (std::size_t i = 0; i < intervals.size(); ++i)
        for (std::size_t j = i + 1; j < intervals.size() && intervals[j].low <= intervals[i].high; ++j) {
            const auto &e = region.edges[intervals[i].edge], &f = region.edges[intervals[j].edge];
            const auto [e_low, e_high] = y_range(e);
            const auto [f_low, f_high] = y_range(f);
            if (e_low > f_high || f_low > e_high || !edges_cross(region, e, f)) continue;
            failed.insert(failed.end(), {e[0], e[1], f[0], f[1]});
        }
    std::sort(failed.begin(), failed.end());
    failed.erase(std::unique(failed.begin(), failed.end()), failed.end());
    return failed;
}

class Triangulator {
 public:
    explicit Triangulator(const PlanarRegion& region) : region_(region) {}

    // Inserts the contour and marks the inside; contour vertices with the inside on the wrong hand are returned.
    std::vector<std::int32_t> insert_contour();
    void insert_wanted();
    void refine();
    PlanarTriangulation extract() const;

 private:
    struct Candidate {
        double radius;
        Triangle corners;
        bool operator<(const Candidate& o) const { return std::tie(radius, corners) < std::tie(o.radius, o.corners); }
    };

    std::vector<std::int32_t> misoriented_edges() const;
    bool insert_interior(const Vec2& p, double size, double least, const PlanarDelaunay::Face* start);
    void consider(const Triangle& t);
    double mean_size(const Triangle& t) const;
    double least_at(const Vec2& p, const Triangle& t) const;
    double largest_at(const Vec2& p, double least) const;
    double shortest_that_counts(const Triangle& t) const;

    const PlanarRegion& region_;
    PlanarDelaunay delaunay_;
    std::vector<Vec2> points_;   // of each vertex
    std::vector<double> size_;   // wanted edge length at each vertex
    std::vector<double> least_;  // not less, because of contour edges nearby
    std::priority_queue<Candidate> queue_;
    std::vector<PlanarDelaunay::Side> cavity_;  // of insert_interior(), kept for its room
};

std::vector<std::int32_t> Triangulator::insert_contour() {
    points_ = region_.contour;
    for (const Vec2& p : points_) delaunay_.insert(p);
    size_.assign(points_.size(), 0);
    for (const auto& [a, b] : region_.edges) {
        const double length = (region_.contour[b] - region_.contour[a]).norm();
        size_[a] += length / 2;
        size_[b] += length / 2;
        if (!delaunay_.insert_edge(a, b)) return {a, b};  // which find_crossings() would have said
    }
    if (!region_.sizes.empty()) size_ = region_.sizes;
    for (double& size : size_) size = std::max(size, region_.least_edge);
    least_ = size_;
    delaunay_.mark_by_parity();  // crossing an edge changes inside to outside
    return misoriented_edges();
}

std::vector<std::int32_t> Triangulator::misoriented_edges() const {
    std::vector<std::int32_t> failed;
    for (const auto& [a, b] : region_.edges)
        if (!delaunay_.has_border(a, b)) failed.insert(failed.end(), {a, b});
    return failed;
}

double Triangulator::mean_size(const Triangle& t) const { return (size_[t[0]] + size_[t[1]] + size_[t[2]]) / 3; }

// Contour edges are not split, so that triangles beside them that are much shorter would be flat.
double Triangulator::least_at(const Vec2& p, const Triangle& t) const {
    double least = 0;
    for (const std::int32_t v : t) least = std::max(least, least_[v] - growth * (points_[v] - p).norm());
    return least;
}

double Triangulator::largest_at(const Vec2& p, double least) const {
    return region_.max_edge ? std::max(least, region_.max_edge(p)) : INFINITY;
}

// Shorter edges make no triangle flat.
double Triangulator::shortest_that_counts(const Triangle& t) const {
    return region_.sizes.empty() ? region_.least_edge : std::max(region_.least_edge, foreshortened * mean_size(t));
}

// Inserts p unless it lies outside, encroaches a contour edge or crowds a vertex.
bool Triangulator::insert_interior(const Vec2& p, double size, double least, const PlanarDelaunay::Face* start) {
    const auto place = delaunay_.find_place(p, start);
    if (!place) return false;
    delaunay_.find_cavity(p, *place, cavity_);
    for (const PlanarDelaunay::Side& side : cavity_) {
        const Vec2 &a = points_[side.from], &b = points_[side.to];
        if ((a - p).norm() < vertex_clearance * size) return false;
        if (!side.is_edge) continue;
        const double length = (b - a).norm();
        if ((a - p).dot(b - p) < 0 && std::abs(cross_2d(b - a, p - a)) < edge_clearance * length * length) return false;
    }
    delaunay_.insert(p, *place);
    points_.push_back(p);
    size_.push_back(size);
    least_.push_back(least);
    return true;
}

void Triangulator::consider(const Triangle& t) {
    const Vec2 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const double la = (b - c).norm(), lb = (c - a).norm(), lc = (a - b).norm();
    const double radius = la * lb * lc / (2 * cross_2d(b - a, c - a));
    const Vec2 centre = circumcentre(a, b, c);
    const double size = std::min(mean_size(t), largest_at(centre, least_at(centre, t)));
    if (radius * std::sqrt(3.0) <= too_large * size &&
        radius <= too_flat * std::max(shortest_that_counts(t), std::min({la, lb, lc})))
        return;
    queue_.push({radius, t});
}

void Triangulator::insert_wanted() {
    for (const auto& [position, size] : region_.wanted) insert_interior(position, size, 0, nullptr);
}

void Triangulator::refine() {
    for (const Triangle& t : delaunay_.triangles()) consider(t);
    for (std::size_t i = 0; !queue_.empty(); ++i) {
        region_.check_cancelled.at(i);
        if (static_cast<std::int64_t>(points_.size()) >= region_.max_points)
            throw Error(ErrorCode::memory,
                        fmt::format("The triangles of an interface have more than {} vertices. Use a "
                                    "larger --size or more --memory.",
                                    region_.max_points));
        const auto face = delaunay_.find(queue_.top().corners);
        queue_.pop();
        if (!face) continue;
        const Triangle& t = face->corners;
        const Vec2 centre = circumcentre(points_[t[0]], points_[t[1]], points_[t[2]]);
        double size = INFINITY;
        for (const std::int32_t v : t) size = std::min(size, size_[v] + growth * (points_[v] - centre).norm());
        const double least = least_at(centre, t);
        if (!insert_interior(centre, std::min(size, largest_at(centre, least)), least, &*face)) continue;
        for (const Triangle& around : delaunay_.triangles_around(count_of(points_) - 1)) consider(around);
    }
}

PlanarTriangulation Triangulator::extract() const {
    PlanarTriangulation result;
    result.points = points_;
    result.triangles = delaunay_.triangles();
    return result;
}

// Returns twice the area over the squared longest edge: it falls with the smallest angle, and needs no root or arc
// cosine.
double shape(const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross_2d(b - a, c - a) / std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

// Moves interior points to the mean of their neighbours wherever the worst triangle around them does not suffer.
void smooth(const PlanarRegion& region, PlanarTriangulation& t) {
    std::vector<std::vector<std::int32_t>> around(t.points.size());
    for (std::int32_t i = 0; i < count_of(t.triangles); ++i)
        for (std::int32_t v : t.triangles[i]) around[v].push_back(i);
    const auto worst_around = [&](std::size_t v) {
        double worst = INFINITY;
        for (std::int32_t i : around[v]) {
            const Triangle& c = t.triangles[i];
            worst = std::min(worst, shape(t.points[c[0]], t.points[c[1]], t.points[c[2]]));
        }
        return worst;
    };
    for (int sweep = 0; sweep < smoothing_sweeps; ++sweep)
        for (std::size_t v = region.contour.size(); v < t.points.size(); ++v) {
            region.check_cancelled.at(v);
            Vec2 sum = Vec2::Zero();
            for (std::int32_t i : around[v])
                for (std::int32_t c : t.triangles[i]) sum += t.points[c];
            const double n = static_cast<double>(around[v].size());
            const Vec2 old = t.points[v];
            const double before = worst_around(v);
            t.points[v] = (sum - n * old) / (2 * n);
            if (worst_around(v) <= before) t.points[v] = old;
        }
}

// Whether as many edges leave each contour point as arrive there.
bool has_closed_loops(const PlanarRegion& region) {
    if (!are_in_range(region.edges, region.contour.size())) return false;
    std::vector<int> surplus(region.contour.size(), 0);
    for (const auto& [from, to] : region.edges) {
        ++surplus[from];
        --surplus[to];
    }
    return std::all_of(surplus.begin(), surplus.end(), [](int s) { return s == 0; });
}

}  // namespace

PlanarTriangulation triangulate(const PlanarRegion& region) {
    KERF_CHECK(has_closed_loops(region));
    KERF_CHECK(region.least_edge >= 0);
    PlanarTriangulation result;
    result.failed = find_crossings(region);
    if (!result.failed.empty()) {
        result.refusal = Refusal::crossing_projection;
        return result;
    }
    Triangulator triangulator(region);
    result.failed = triangulator.insert_contour();
    if (!result.failed.empty()) {
        result.refusal = Refusal::nesting;
        return result;
    }
    if (region.refined) {
        triangulator.insert_wanted();
        triangulator.refine();
    }
    region.check_cancelled();
    result = triangulator.extract();
    smooth(region, result);
    return result;
}

}  // namespace kerf
