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

const PlaneCandidate* PlaneSequence::at(std::size_t i) {
    if (candidates_.empty()) add_bisection();
    if (i == 1 && candidates_.size() == 1) add_steps();
    return i < candidates_.size() ? &candidates_[i] : nullptr;
}

void PlaneSequence::add_bisection() {
    const LoadProfile profile(surface_, through_centroid_, options_.bisected_load());
    middle_ = bisecting_height(profile, fraction_, options_.criterion);
    candidates_.push_back({through_centroid_.shifted(middle_), axis_, 0, true});
}

// The profile is made again: most cuts need no steps, and it would be the largest array while the halves are built.
void PlaneSequence::add_steps() {
    const LoadProfile profile(surface_, through_centroid_, options_.bisected_load());
    const double h = crossing_edge_length(surface_, candidates_[0].plane);
    std::vector<double> heights;
    for (std::int32_t i = 1; i <= options_.plane_steps; ++i)
        for (const std::int32_t step : {i, -i}) {
            const double height = middle_ + step * step_length * h * (1 + step_growth * i);
            if (height <= profile.lowest() || height >= profile.highest()) continue;
            heights.push_back(height);
            candidates_.push_back({through_centroid_.shifted(height), axis_, step, true});
        }
    if (options_.criterion == Criterion::equidistant) return;
    const std::vector<double> below = profile.fractions_below(heights);
    for (std::size_t i = 0; i < below.size(); ++i)
        candidates_[i + 1].inside_load_window = std::abs(below[i] - fraction_) <= options_.load_window;
}

}  // namespace kerf
