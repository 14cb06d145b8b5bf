// The features and the tolerances of the input. Features are found between the planes of flat regions, because the
// normals of needles are noise: an edge is one if the normals of its regions differ by more than the feature angle, or
// if it is a seam, a crease or a border of patches. The tolerance of a facet comes from rays from its corners, middles
// of sides and centre, both ways: a third of the nearest gap, so that two sheets that both move towards each other
// still keep a third of it; but no less than an eighth of the deviation, because beside a sharp edge each gap ends in
// nothing. For the same reason the thickest place behind a facet, not the thinnest, decides about its share of the
// thickness.
#include "surface/remesh/inside/input_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "surface/remesh/thickness.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double flat_share = 0.1;          // of the tolerance: height up to which a region counts as flat
constexpr double gap_share = 1. / 3;        // of a gap that each of its sheets may use
constexpr double rounding_of_files = 6e-8;  // of coordinates in single precision: lower facets have any normal
constexpr double least_share = 1. / 8;      // of the deviation: beside sharp edges gaps end in nothing

bool share_a_vertex(const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](std::int32_t v) { return v == t[0] || v == t[1] || v == t[2]; });
}

}  // namespace

InputShape::InputShape(const Sheets& sheets, const TriangleTree& tree, const Nearness& nearness, Tolerances tolerances,
                       double feature_angle_deg, const std::vector<UndirectedEdge>& creases,
                       const std::vector<char>& walls)
    : sheets_(sheets),
      tree_(tree),
      nearness_(nearness),
      walls_(walls),
      tolerances_(std::move(tolerances)),
      vertex_tolerance_(vertices().size(), std::numeric_limits<double>::infinity()) {
    const std::vector<double>& tolerance = tolerances_.of_facet;
    KERF_CHECK(tolerance.size() == facets().size() && tolerances_.by_thickness.size() == facets().size());
    for (std::size_t f = 0; f < facets().size(); ++f)
        for (const std::int32_t v : facets()[f]) vertex_tolerance_[v] = std::min(vertex_tolerance_[v], tolerance[f]);
    largest_tolerance_ = *std::max_element(tolerance.begin(), tolerance.end());
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
    const auto flatness = [&](std::int32_t f) { return flat_share * largest_tolerance_ * share_by_thickness(f); };
    regions_ =
        find_flat_regions(vertices(), facets(), {.tolerance = flatness, .noise = noise_, .is_border = is_border});
    const double least_cosine = std::cos(feature_angle_deg * std::numbers::pi / 180);
    for (std::int32_t corner = 0; corner < count_of(partner); ++corner)
        feature_.push_back(is_border(corner) || normal(corner / 3).dot(normal(partner[corner] / 3)) < least_cosine);
}

namespace {

// Finds the tolerances of one surface, by rays from its facets.
class ToleranceFinder {
 public:
    ToleranceFinder(const SurfaceArrays& surface, const TriangleTree& tree, const ToleranceRules& rules,
                    const std::vector<char>& walls)
        : surface_(surface), tree_(tree), rules_(rules), thickness_(surface, tree, walls) {
        least_by_thickness_ = 4 * rounding_of_files * box_around(surface.vertices).diagonal().norm();
    }

    double by_gap(std::int32_t f) const {
        const auto [a, b, c] = corners(f);
        const double deviation = rules_.deviation;
        double gap = infinite;
        const auto faces_it = [&](std::int32_t g) {
            return thickness_.are_opposite(f, g) && !share_a_vertex(surface_.facets[g], surface_.facets[f]);
        };
        Eigen::AlignedBox3d box(a);
        for (const Vec3& p : {b, c}) box.extend(p);
        const Vec3 margin = Vec3::Constant(deviation / gap_share);
        if (!tree_.any_in_box({box.min() - margin, box.max() + margin}, faces_it)) return deviation;
        for (const Vec3& p : {Vec3((a + b + c) / 3), a, b, c, Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)})
            for (const Vec3& way : {thickness_.normal(f), Vec3(-thickness_.normal(f))})
                gap = std::min(gap, tree_.first_hit(p, way, 0, std::min(gap, deviation / gap_share), faces_it));
        return std::clamp(gap_share * gap, least_share * deviation, deviation);
    }

    // The thickest place behind the facet counts: beside sharp edges thickness ends in nothing.
    double by_thickness(std::int32_t f) const {
        const double share = rules_.share_of_thickness;
        if (share == 0) return rules_.deviation;
        const auto [a, b, c] = corners(f);
        const Vec3 centre = (a + b + c) / 3;
        double thickest = 0;
        for (const Vec3& p : {centre, Vec3((centre + a) / 2), Vec3((centre + b) / 2), Vec3((centre + c) / 2)}) {
            thickest = std::max(thickest, thickness_.at(p, f, rules_.deviation / share));
            if (share * thickest >= rules_.deviation) return rules_.deviation;
        }
        return std::max(share * thickest, std::min(least_by_thickness_, rules_.deviation));
    }

 private:
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    std::array<Vec3, 3> corners(std::int32_t f) const {
        const Triangle& t = surface_.facets[f];
        return {surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]};
    }
    const SurfaceArrays& surface_;
    const TriangleTree& tree_;
    const ToleranceRules& rules_;
    Thickness thickness_;
    double least_by_thickness_;
};

}  // namespace

void Tolerances::multiply(double factor) {
    for (std::vector<double>* tolerances : {&of_facet, &by_thickness})
        for (double& tolerance : *tolerances) tolerance *= factor;
}

Tolerances find_tolerances(const SurfaceArrays& surface, const TriangleTree& tree, const ToleranceRules& rules,
                           const std::vector<char>& walls, const CancellationCheck& check_cancelled) {
    constexpr std::size_t grain = 1 << 10;
    const ToleranceFinder finder(surface, tree, rules, walls);
    const std::size_t count = surface.facets.size();
    Tolerances found = {std::vector<double>(count), std::vector<double>(count)};
    for_ranges_on_threads(count, grain, [&](const IndexRange& range) {
        check_cancelled();
        for (std::size_t f = range.first; f < range.last; ++f) {
            found.by_thickness[f] = finder.by_thickness(f);
            found.of_facet[f] = std::min(finder.by_gap(f), found.by_thickness[f]);
        }
    });
    return found;
}

}  // namespace kerf
