// Notation: z heights, L the cotangent Laplacian of the planar triangulation, split into interior and contour points:
// L_ii z_i = -L_ic z_c. Where obstacles bound z, the same system is relaxed by projected Gauss-Seidel sweeps.
#include "cut/cut/inside/lift.h"

#include <algorithm>
#include <cmath>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/geometry/sparse_factors.h"
#include "cut/cut/inside/planar_grid.h"

namespace kerf {

namespace {

constexpr double fall_off = 0.3;       // of an obstacle's bound with the distance
constexpr double reach = 3;            // of an obstacle, in its sizes
constexpr double least_weight = 1e-3;  // keeps the maximum principle where triangles are obtuse
constexpr int sweeps = 100;

// Weighted graph of the triangulation: neighbours of point i are [first[i], first[i + 1]).
struct WeightedGraph {
    std::vector<std::int32_t> first, neighbour;
    std::vector<double> weight;
};

double cotangent(const Vec2& apex, const Vec2& a, const Vec2& b) {
    const Vec2 p = a - apex, q = b - apex;
    return p.dot(q) / (p.x() * q.y() - p.y() * q.x());
}

WeightedGraph cotangent_graph(const PlanarTriangulation& t) {
    struct Entry {
        std::int32_t from, to;
        double weight;
    };
    std::vector<Entry> entries;
    entries.reserve(6 * t.triangles.size());
    for (const Triangle& c : t.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = c[(i + 1) % 3], b = c[(i + 2) % 3];
            const double w = cotangent(t.points[c[i]], t.points[a], t.points[b]) / 2;
            entries.push_back({a, b, w});
            entries.push_back({b, a, w});
        }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.from != b.from ? a.from < b.from : a.to != b.to ? a.to < b.to : a.weight < b.weight;
    });
    WeightedGraph graph;
    graph.first.assign(t.points.size() + 1, 0);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const bool repeated = i > 0 && entries[i].from == entries[i - 1].from && entries[i].to == entries[i - 1].to;
        if (repeated) {
            graph.weight.back() += entries[i].weight;
            continue;
        }
        graph.neighbour.push_back(entries[i].to);
        graph.weight.push_back(entries[i].weight);
        ++graph.first[entries[i].from + 1];
    }
    for (std::size_t i = 1; i < graph.first.size(); ++i) graph.first[i] += graph.first[i - 1];
    for (double& w : graph.weight) w = std::max(w, least_weight);
    return graph;
}

void solve_harmonic(const WeightedGraph& graph, std::size_t contour_count, const CancellationCheck& check_cancelled,
                    std::vector<double>& height) {
    const auto interior = static_cast<std::int32_t>(height.size() - contour_count);
    if (interior == 0) return;
    std::vector<SparseEntry> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(interior);
    for (std::int32_t i = 0; i < interior; ++i) {
        const std::size_t v = contour_count + i;
        double sum = 0;
        for (std::int32_t k = graph.first[v]; k < graph.first[v + 1]; ++k) {
            const std::size_t n = graph.neighbour[k];
            sum += graph.weight[k];
            if (n < contour_count)
                right[i] += graph.weight[k] * height[n];
            else
                entries.push_back({i, static_cast<std::int32_t>(n - contour_count), -graph.weight[k]});
        }
        entries.push_back({i, i, sum});
    }
    const Eigen::VectorXd solution = SparseFactors(interior, entries, check_cancelled).solve(right);
    for (std::int32_t i = 0; i < interior; ++i) height[contour_count + i] = solution[i];
}

// Narrows the ranges of interior points; contour points lie on the surface and stay.
void add_obstacles(const std::vector<Vec2>& places, std::size_t contour_count, const std::vector<Obstacle>& obstacles,
                   std::vector<HeightRange>& bounds) {
    std::vector<PlanarBox> boxes;
    for (std::size_t v = contour_count; v < places.size(); ++v) boxes.emplace_back(places[v]);
    PlanarGrid grid(std::move(boxes));
    for (const Obstacle& o : obstacles)
        grid.for_each_overlap(grown(PlanarBox(o.position), reach * o.size), [&](std::int32_t i) {
            const std::size_t v = contour_count + i;
            const double lead = o.clearance * o.size - fall_off * (places[v] - o.position).norm();
            if (o.side == Side::below)
                bounds[v].low = std::max(bounds[v].low, o.height + lead);
            else
                bounds[v].high = std::min(bounds[v].high, o.height - lead);
        });
}

void relax_within_bounds(const WeightedGraph& graph, std::size_t contour_count, const std::vector<HeightRange>& bounds,
                         std::vector<double>& height) {
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t v = contour_count; v < height.size(); ++v) {
            double sum = 0, weights = 0;
            for (std::int32_t k = graph.first[v]; k < graph.first[v + 1]; ++k) {
                sum += graph.weight[k] * height[graph.neighbour[k]];
                weights += graph.weight[k];
            }
            height[v] = bounds[v].clamp(sum / weights);
        }
}

}  // namespace

std::vector<Vec2> harmonic_displacements(const PlanarTriangulation& triangulation, const std::vector<Vec2>& of_contour,
                                         const CancellationCheck& check_cancelled) {
    const WeightedGraph graph = cotangent_graph(triangulation);
    std::vector<Vec2> displacements(triangulation.points.size());
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> values(displacements.size(), 0);
        for (std::size_t i = 0; i < of_contour.size(); ++i) values[i] = of_contour[i][axis];
        solve_harmonic(graph, of_contour.size(), check_cancelled, values);
        for (std::size_t i = 0; i < values.size(); ++i) displacements[i][axis] = values[i];
    }
    return displacements;
}

std::vector<double> lift_heights(const PlanarTriangulation& triangulation, const std::vector<Vec2>& places,
                                 const std::vector<double>& contour_height, const std::vector<Obstacle>& obstacles,
                                 std::vector<HeightRange> ranges, const CancellationCheck& check_cancelled) {
    const std::size_t contour_count = contour_height.size();
    KERF_CHECK(contour_count <= triangulation.points.size());
    KERF_CHECK(ranges.empty() || ranges.size() == triangulation.points.size());
    KERF_CHECK(are_in_range(triangulation.triangles, triangulation.points.size()));
    std::vector<double> height = contour_height;
    height.resize(triangulation.points.size(), 0);
    const WeightedGraph graph = cotangent_graph(triangulation);
    solve_harmonic(graph, contour_count, check_cancelled, height);
    ranges.resize(height.size());
    add_obstacles(places, contour_count, obstacles, ranges);
    bool violated = false;
    for (std::size_t v = contour_count; v < height.size(); ++v) violated |= ranges[v].clamp(height[v]) != height[v];
    if (violated) relax_within_bounds(graph, contour_count, ranges, height);
    return height;
}

}  // namespace kerf
