#include "cut/plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "cut/band.h"

namespace kerf {

namespace {

constexpr double step_length = 0.6;  // in crossing edges
constexpr double step_growth = 0.15;

double bisecting_height(const LoadProfile& profile, double fraction, Criterion criterion) {
    if (criterion == Criterion::equidistant)
        return profile.lowest() + fraction * (profile.highest() - profile.lowest());
    return profile.bisect(fraction);
}

}  // namespace

std::vector<Vec3> cut_directions(const Surface& surface, const MassProperties& mass, const CutOptions& options) {
    if (options.axis >= 0) return {Vec3::Unit(options.axis)};
    if (options.criterion == Criterion::inertia) return {mass.axes.col(0), mass.axes.col(1), mass.axes.col(2)};
    Eigen::AlignedBox3d box;
    for (std::int32_t v = 0; v < surface.vertex_count(); ++v) box.extend(surface.point(v));
    std::array<int, 3> order = {0, 1, 2};
    const Vec3 extent = box.sizes();
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return extent[a] > extent[b]; });
    return {Vec3::Unit(order[0]), Vec3::Unit(order[1]), Vec3::Unit(order[2])};
}

std::vector<PlaneCandidate> plane_candidates(const Surface& surface, const MassProperties& mass, const Vec3& direction,
                                             std::int32_t axis, double fraction, const CutOptions& options) {
    const Plane through_centroid(mass.centroid, direction);
    const LoadProfile profile(surface, through_centroid, options.bisected_load());
    const double middle = bisecting_height(profile, fraction, options.criterion);
    std::vector<PlaneCandidate> candidates = {{through_centroid.shifted(middle), axis, 0, true}};
    const double h = crossing_edge_length(surface, candidates[0].plane);
    for (std::int32_t i = 1; i <= options.plane_steps; ++i)
        for (const std::int32_t step : {i, -i}) {
            const double height = middle + step * step_length * h * (1 + step_growth * i);
            if (height <= profile.lowest() || height >= profile.highest()) continue;
            const bool inside = options.criterion == Criterion::equidistant ||
                                std::abs(profile.fraction_below(height) - fraction) <= options.load_window;
            candidates.push_back({through_centroid.shifted(height), axis, step, inside});
        }
    return candidates;
}

}  // namespace kerf
