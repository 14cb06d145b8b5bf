// Vertices are never moved to the plane: that folds strips of long triangles over. The plane moves instead, into a gap
// between the coordinates of the vertices, and facets are split there (facet_split.h). The surface touches the plane in
// the contour alone, and the interface lies in the plane exactly, so the two cannot meet elsewhere; only the pieces of
// split facets are rounded, and need a check for intersections. Planes are rated by the width of their gap, less
// penalties for the distance from the wanted load, for the share of facets that are split, and for directions in which
// the body is short.
#include "cut/cut/straight.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/threads.h"
#include "cut/cut/inside/contour.h"
#include "cut/cut/planar_triangulation.h"
#include "surface/complex/touching.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

constexpr std::size_t max_planes = 12;
constexpr double wide_gap = 0.02;           // of the extent: wider gaps are no better
constexpr double load_weight = 0.5;         // of the distance from the wanted load, per half window
constexpr double crossing_weight = 2;       // of the share of facets that are split
constexpr double equidistant_window = 0.1;  // of the extent, on either side

// A coordinate plane whose in-plane coordinates are coordinates of space, without rounding.
Plane coordinate_plane(int axis, double height) {
    Plane plane;
    plane.origin = height * Vec3::Unit(axis);
    plane.normal = Vec3::Unit(axis);
    plane.u = Vec3::Unit((axis + 1) % 3);
    plane.v = Vec3::Unit((axis + 2) % 3);
    return plane;
}

struct Window {
    double low, wanted, high;
};

// The coordinates of vertices along an axis: those within the window and the next on either side, each once, ascending,
// and the least and largest of all.
struct Heights {
    std::vector<double> sorted;
    double lowest = 0, highest = 0;
};

Heights heights_of(const Surface& surface, int axis, const Window& window) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double before = -infinity, after = infinity;
    Heights heights{{}, infinity, -infinity};
    for (const Vertex v : surface.vertices()) {
        const double x = surface.point(v)[axis];
        heights.lowest = std::min(heights.lowest, x);
        heights.highest = std::max(heights.highest, x);
        if (x < window.low)
            before = std::max(before, x);
        else if (x > window.high)
            after = std::min(after, x);
        else
            heights.sorted.push_back(x);
    }
    if (before > -infinity) heights.sorted.push_back(before);
    if (after < infinity) heights.sorted.push_back(after);
    sort_on_threads(heights.sorted);
    heights.sorted.erase(std::unique(heights.sorted.begin(), heights.sorted.end()), heights.sorted.end());
    return heights;
}

// The number of facets that a plane across one axis crosses, within a window and up to the next vertices beside it.
class CrossingCount {
 public:
    CrossingCount(const Surface& surface, int axis, const Window& window) : facets_(surface.facet_count()) {
        for (const Facet f : surface.facets()) {
            const auto t = surface.corners(f);
            const auto [low, high] =
                std::minmax({surface.point(t[0])[axis], surface.point(t[1])[axis], surface.point(t[2])[axis]});
            low_.add(low, window);
            high_.add(high, window);
        }
        sort_on_threads(low_.within);
        sort_on_threads(high_.within);
    }
    double share(double height) const {
        return static_cast<double>(low_.below(height) - high_.below(height)) / facets_;
    }

 private:
    // The lower or the upper ends of facets. Ends above the window are dropped: no height above it is asked for.
    struct Ends {
        std::int64_t before = 0;
        std::vector<double> within;

        void add(double x, const Window& window) {
            if (x < window.low)
                ++before;
            else if (x <= window.high)
                within.push_back(x);
        }
        std::int64_t below(double height) const {
            return before + (std::lower_bound(within.begin(), within.end(), height) - within.begin());
        }
    };

    std::int32_t facets_;
    Ends low_, high_;
};

Window load_window(const Surface& surface, int axis, double fraction, const CutOptions& options) {
    const LoadProfile profile(surface, coordinate_plane(axis, 0), options.bisected_load());
    if (options.criterion == Criterion::equidistant) {
        const double extent = profile.highest() - profile.lowest();
        const double wanted = profile.lowest() + fraction * extent;
        return {wanted - equidistant_window * extent, wanted, wanted + equidistant_window * extent};
    }
    return {profile.bisect(std::max(0.0, fraction - options.load_window)), profile.bisect(fraction),
            profile.bisect(std::min(1.0, fraction + options.load_window))};
}

struct RatedPlane {
    double score;
    StraightPlane plane;
    bool operator<(const RatedPlane& o) const {
        return std::tie(o.score, plane.axis, plane.height) < std::tie(score, o.plane.axis, o.plane.height);
    }
};

void rate_planes(const Surface& surface, int axis, double largest_extent, double fraction, const CutOptions& options,
                 std::vector<RatedPlane>& rated) {
    const Window window = load_window(surface, axis, fraction, options);
    const Heights heights = heights_of(surface, axis, window);
    const std::vector<double>& x = heights.sorted;
    const double extent = heights.highest - heights.lowest;
    if (extent == 0) return;
    const CrossingCount crossing(surface, axis, window);
    const double half_window = std::max(window.high - window.low, wide_gap * extent) / 2;
    for (std::size_t i = 1; i < x.size(); ++i) {
        const double margin = std::min(x[i] - x[i - 1], wide_gap * extent) / 2;
        // Rounding may exchange the two bounds, which std::clamp() does not allow.
        const double height = std::min(std::max(window.wanted, x[i - 1] + margin), x[i] - margin);
        if (!(x[i - 1] < height && height < x[i])) continue;  // neighbouring numbers
        const double score = 2 * margin / (wide_gap * extent) -
                             load_weight * std::abs(height - window.wanted) / half_window -
                             crossing_weight * crossing.share(height) - (1 - extent / largest_extent);
        rated.push_back({score, {axis, height}});
    }
}

std::vector<SurfaceEdge> contour_of(const Surface& parent, const PlaneSplit& split) {
    std::vector<SurfaceEdge> edges;
    for (const Facet f : parent.facets()) {
        if (split.side[f] != Side::below) continue;
        for (const HalfEdge h : parent.half_edges(f))
            if (split.side[parent.facet_of(Surface::opposite(h))] == Side::above)
                edges.push_back({parent.from_vertex(h), parent.to_vertex(h)});
    }
    return edges;
}

// Spans the loops in the plane; the refusal of the triangulation.
Refusal span_plane(const Surface& parent, Cut& cut) {
    PlanarRegion region;
    region.refined = false;
    Interface& interface = cut.interface;
    for (const auto& loop : cut.loops) {
        const std::int32_t first = count_of(interface.contour), n = count_of(loop);
        for (std::int32_t i = 0; i < n; ++i) {
            interface.contour.push_back(loop[i]);
            interface.points.push_back(parent.point(loop[i]));
            region.contour.push_back(cut.plane.project(parent.point(loop[i])));
            region.edges.push_back({first + (i + 1) % n, first + i});
        }
    }
    PlanarTriangulation planar = triangulate(region);
    interface.planar = std::move(planar.points);
    interface.triangles = std::move(planar.triangles);
    for (const Triangle& t : interface.triangles) {
        const Vec2 &a = interface.planar[t[0]], &b = interface.planar[t[1]], &c = interface.planar[t[2]];
        cut.section_area += ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
    }
    cut.interface_area = cut.section_area;
    return planar.refusal;
}

// A piece of a split or of an untested facet that meets another facet, with that. Facets may meet at copies of a
// vertex.
std::vector<Collision> first_collision(const Surface& surface, const PlaneSplit& split,
                                       const Array<Facet, char>& untested) {
    const bool has_copies = !copied_vertices(surface).empty();
    const SurfaceArrays joined = has_copies ? joined_by_key(split.arrays) : SurfaceArrays();
    const SurfaceArrays& arrays = has_copies ? joined : split.arrays;
    const Array<Facet, Facet>& parent = split.parent;
    std::vector<char> chosen(parent.size(), 0);
    for (std::size_t i = 0; i < parent.size(); ++i)
        chosen[i] = (!untested.empty() && untested[parent[i]]) || (i > 0 && parent[i - 1] == parent[i]) ||
                    (i + 1 < parent.size() && parent[i + 1] == parent[i]);
    const auto corners = [&](std::int32_t facet) -> std::array<Vec3, 3> {
        const Triangle& t = arrays.facets[facet];
        return {arrays.vertices[t[0]], arrays.vertices[t[1]], arrays.vertices[t[2]]};
    };
    std::vector<Collision> found;
    for (const auto& [a, b] : find_intersections_of(chosen, arrays.vertices, arrays.facets, 1))
        found.push_back(chosen[a] ? Collision{corners(a), corners(b)} : Collision{corners(b), corners(a)});
    return found;
}

// Without a contour: bodies lie on either side.
bool has_both_sides(const PlaneSplit& split) {
    return std::adjacent_find(split.side.begin(), split.side.end(), std::not_equal_to<>()) != split.side.end();
}

Refusal try_plane(const Surface& surface, const StraightPlane& plane, const Array<Facet, char>& untested,
                  StraightCut& result, std::vector<Collision>& collisions) {
    Cut& cut = result.cut;
    cut.plane = coordinate_plane(plane.axis, plane.height);
    std::optional<PlaneSplit> split = split_at_plane(surface, plane.axis, plane.height, cut.node);
    if (!split) return Refusal::coincident_vertices;
    result.split = std::move(*split);
    const SurfaceArrays& arrays = result.split.arrays;
    collisions = first_collision(surface, result.split, untested);
    if (!collisions.empty()) return Refusal::intersection;
    result.parent = separated_surface(arrays);
    const std::vector<SurfaceEdge> edges = contour_of(result.parent, result.split);
    if (edges.empty()) return has_both_sides(result.split) ? Refusal::none : Refusal::empty_side;
    cut.loops = trace_loops(result.parent, edges).loops;
    return span_plane(result.parent, cut);
}

FileHash hash_of(const PlaneSplit& split) {
    Hasher hasher;
    hasher.add(std::span<const Side>(split.side));
    hasher.add(std::span<const Vec3>(split.arrays.vertices));
    hasher.add(std::span<const Triangle>(split.arrays.facets));
    return hasher.digest();
}

}  // namespace

std::vector<StraightPlane> straight_planes(const Surface& surface, double fraction, const CutOptions& options) {
    KERF_CHECK(surface.facet_count() > 0);
    KERF_CHECK(fraction > 0 && fraction < 1);
    Eigen::AlignedBox3d box;
    for (const Vertex v : surface.vertices()) box.extend(surface.point(v));
    std::vector<RatedPlane> rated;
    for (int axis = 0; axis < 3; ++axis)
        if (options.axis < 0 || options.axis == axis)
            rate_planes(surface, axis, box.sizes().maxCoeff(), fraction, options, rated);
    const auto kept = rated.begin() + std::min(max_planes, rated.size());
    std::partial_sort(rated.begin(), kept, rated.end());
    std::vector<StraightPlane> planes;
    for (auto it = rated.begin(); it != kept; ++it) planes.push_back(it->plane);
    return planes;
}

std::optional<StraightCut> cut_straight(const Surface& surface, NodeId node, double fraction, const CutOptions& options,
                                        std::vector<CutTry>& tries, const Array<Facet, char>& untested) {
    std::int32_t step = 0;
    for (const StraightPlane& plane : straight_planes(surface, fraction, options)) {
        StraightCut result;
        result.cut.node = node;
        CutTry record;
        record.refusal = try_plane(surface, plane, untested, result, record.collisions);
        record.plane = result.cut.plane;
        record.method = ContourMethod::straight;
        record.axis = plane.axis;
        record.step = step++;
        tries.push_back(record);
        if (record.refusal != Refusal::none) continue;
        result.cut.strategy = CutStrategy::straight;
        result.cut.method = ContourMethod::straight;
        result.cut.hash = hash_of(result.split);
        describe_contour(result.parent, result.cut);
        return result;
    }
    return std::nullopt;
}

}  // namespace kerf
