// A ray goes from a point of a facet against its normal, from a wall both ways, to the first facet that is opposite.
// Samples are the centres of n^2 equal pieces of a facet, with n by its share of the area, so that large facets of
// coarse surfaces are sampled as well as small ones. affordable_edges() forecasts facets as area over squared edge
// length, summed over the samples, and lengthens edges until the forecast fits: first all of them, by fewer edges
// across the thickness, then the shortest alone.
#include "surface/remesh/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/threads.h"
#include "base/geometry/triangle.h"
#include "surface/remesh/remesh.h"

namespace kerf {

namespace {

constexpr double opposite_cosine = -0.1;     // of the normals of two sheets with a body or a gap between them
constexpr int most_pieces_of_side = 64;      // of a side of a facet, for samples
constexpr double least_per_thickness = 0.1;  // before edges become longer than some walls ask for
constexpr double hopeless_share = 0.01;      // of the shortest edges: makes angles below a degree
constexpr int most_steps_to_afford = 8;
constexpr double samples_of_surface = 20'000;  // besides those that each facet has

// The centres of the n^2 pieces that dividing the sides by n makes.
template <class Visit>
void for_each_piece(const Vec3& a, const Vec3& b, const Vec3& c, int n, Visit visit) {
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            visit(Vec3(a + (b - a) * ((i + 1. / 3) / n) + (c - a) * ((j + 1. / 3) / n)));
            if (i + j + 1 < n) visit(Vec3(a + (b - a) * ((i + 2. / 3) / n) + (c - a) * ((j + 2. / 3) / n)));
        }
}

}  // namespace

Thickness::Thickness(const SurfaceArrays& surface, const TriangleTree& tree, const std::vector<char>& walls)
    : tree_(tree), walls_(walls) {
    for (const Triangle& t : surface.facets) normal_.push_back(doubled_area_vector(surface.vertices, t).normalized());
}

bool Thickness::are_opposite(std::int32_t f, std::int32_t g) const {
    const double cosine = normal_[g].dot(normal_[f]);
    return (is_wall(f) || is_wall(g) ? -std::abs(cosine) : cosine) < opposite_cosine;
}

double Thickness::at(const Vec3& p, std::int32_t f, double limit) const {
    const auto along = [&](const Vec3& way) {
        return tree_.first_hit(p, way, 0, limit, [&](std::int32_t g) { return g != f && are_opposite(f, g); });
    };
    const double behind = along(-normal_[f]);
    return is_wall(f) ? std::min(behind, along(normal_[f])) : behind;
}

std::vector<ThicknessSample> sample_thickness(const SurfaceArrays& surface, const Thickness& thickness, double limit) {
    constexpr std::size_t grain = 1 << 11;
    double area = 0;
    for (const Triangle& t : surface.facets) area += triangle_area(surface.vertices, t);
    const auto ranges = values_of_ranges(surface.facets.size(), grain, [&](const IndexRange& range) {
        std::vector<ThicknessSample> samples;
        for (std::size_t f = range.first; f < range.last; ++f) {
            const Triangle& t = surface.facets[f];
            const double of_facet = triangle_area(surface.vertices, t);
            const double share = area > 0 ? of_facet / area : 0;
            const int n = std::clamp(static_cast<int>(std::sqrt(samples_of_surface * share)), 1, most_pieces_of_side);
            for_each_piece(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]], n,
                           [&](const Vec3& p) {
                               samples.push_back({thickness.at(p, f, limit), of_facet / (n * n)});
                           });
        }
        return samples;
    });
    std::vector<ThicknessSample> all;
    for (const std::vector<ThicknessSample>& samples : ranges) all.insert(all.end(), samples.begin(), samples.end());
    return all;
}

double median_thickness(const SurfaceArrays& surface, const TriangleTree& tree, const std::vector<char>& walls,
                        double limit) {
    std::vector<ThicknessSample> samples = sample_thickness(surface, Thickness(surface, tree, walls), limit);
    std::sort(samples.begin(), samples.end(), [](const ThicknessSample& a, const ThicknessSample& b) {
        return std::pair(a.thickness, a.area) < std::pair(b.thickness, b.area);
    });
    double area = 0, below = 0;
    for (const ThicknessSample& s : samples) area += s.area;
    for (const ThicknessSample& s : samples)
        if (below += s.area; 2 * below >= area) return s.thickness;
    return std::numeric_limits<double>::infinity();
}

double WallEdges::of(double thickness) const {
    if (thickness < hopeless_share * shortest) return longest;
    return std::min(std::max(thickness / per_thickness, shortest), longest);
}

namespace {

double facets_on_walls(const std::vector<ThicknessSample>& samples, const WallEdges& edges) {
    double sum = 0;
    for (const ThicknessSample& s : samples) {
        const double edge = edges.of(s.thickness);
        sum += s.area / (edge * edge);
    }
    return sum / facet_area_per_squared_length;
}

}  // namespace

WallEdges affordable_edges(const SurfaceArrays& surface, const Thickness& thickness, const WallEdges& wanted,
                           double most) {
    WallEdges edges = wanted;
    if (edges.per_thickness == 0) return edges;
    const auto samples = sample_thickness(surface, thickness, edges.longest * edges.per_thickness);
    for (int step = 0; step < most_steps_to_afford; ++step) {
        const double share = most / facets_on_walls(samples, edges);
        if (share >= 1) break;
        if (edges.per_thickness > least_per_thickness)
            edges.per_thickness = std::max(edges.per_thickness * std::sqrt(share), least_per_thickness);
        else
            edges.shortest = std::min(edges.shortest / std::sqrt(share), edges.longest);
    }
    return edges;
}

}  // namespace kerf
