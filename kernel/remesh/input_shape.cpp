#include "remesh/input_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "geometry/box.h"
#include "geometry/triangle.h"
#include "surface/edge_corners.h"

namespace kerf {

namespace {

constexpr double flat_share = 0.1;          // of the tolerance: what counts as flat
constexpr double gap_share = 1. / 3;        // of a gap that each of its sheets may use
constexpr double rounding_of_files = 6e-8;  // of coordinates in single precision: lower facets have any normal
constexpr double opposite_cosine = -0.1;    // of the normals of two sheets with a gap between them
constexpr double least_share = 1. / 8;      // of the deviation: beside sharp edges gaps end in nothing

bool share_a_vertex(const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](std::int32_t v) { return v == t[0] || v == t[1] || v == t[2]; });
}

}  // namespace

InputShape::InputShape(const Sheets& sheets, const TriangleTree& tree, std::vector<double> tolerance,
                       double feature_angle_deg, const std::vector<UndirectedEdge>& creases,
                       const std::vector<char>& walls)
    : sheets_(sheets),
      tree_(tree),
      walls_(walls),
      tolerance_(std::move(tolerance)),
      vertex_tolerance_(vertices().size(), std::numeric_limits<double>::infinity()) {
    KERF_CHECK(tolerance_.size() == facets().size());
    for (std::size_t f = 0; f < facets().size(); ++f)
        for (const std::int32_t v : facets()[f]) vertex_tolerance_[v] = std::min(vertex_tolerance_[v], tolerance_[f]);
    largest_tolerance_ = *std::max_element(tolerance_.begin(), tolerance_.end());
    noise_ = rounding_of_files * box_around(vertices()).diagonal().norm();
    find_features(feature_angle_deg, creases);
}

// Between the planes of regions, because the normals of needles are noise.
void InputShape::find_features(double feature_angle_deg, std::vector<UndirectedEdge> creases) {
    const std::vector<std::int32_t>& partner = sheets_.partner;
    for (UndirectedEdge& e : creases) e = undirected(e[0], e[1]);
    std::sort(creases.begin(), creases.end());
    const auto is_border = [&](std::int32_t corner) {
        return partner[corner] < 0 || patch(corner / 3) != patch(partner[corner] / 3) ||
               std::binary_search(creases.begin(), creases.end(), sheets_.edge_before(corner));
    };
    regions_ = find_flat_regions(
        vertices(), facets(), {.tolerance = flat_share * largest_tolerance_, .noise = noise_, .is_border = is_border});
    const double least_cosine = std::cos(feature_angle_deg * std::numbers::pi / 180);
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(partner.size()); ++corner)
        feature_.push_back(is_border(corner) || normal(corner / 3).dot(normal(partner[corner] / 3)) < least_cosine);
}

std::vector<double> tolerances_of_gaps(const SurfaceArrays& surface, const TriangleTree& tree, double deviation,
                                       const std::vector<char>& walls, const CancellationCheck& poll) {
    const auto is_wall = [&](std::size_t f) { return !walls.empty() && walls[f] != 0; };
    std::vector<double> tolerance(surface.facets.size(), deviation);
    std::vector<Vec3> normal;
    for (const Triangle& t : surface.facets) normal.push_back(doubled_area_vector(surface.vertices, t).normalized());
    const double smallest = least_share * deviation;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        poll.at(f);
        const Triangle& t = surface.facets[f];
        const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
        double gap = std::numeric_limits<double>::infinity();
        const auto faces_it = [&](std::int32_t g) {
            const double cosine = normal[g].dot(normal[f]);
            const bool are_opposite = (is_wall(f) || is_wall(g) ? -std::abs(cosine) : cosine) < opposite_cosine;
            return are_opposite && !share_a_vertex(surface.facets[g], t);
        };
        for (const Vec3& p : {Vec3((a + b + c) / 3), a, b, c, Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)})
            for (const Vec3& way : {normal[f], Vec3(-normal[f])})
                gap = std::min(gap, tree.first_hit(p, way, 0, std::min(gap, deviation / gap_share), faces_it));
        tolerance[f] = std::clamp(gap_share * gap, smallest, deviation);
    }
    return tolerance;
}

}  // namespace kerf
