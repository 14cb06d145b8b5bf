// Planes across one direction, whose heights are measured over the plane through the centroid. Gaps between bodies are
// found by slices of the extent: each facet raises a counter in the slice where it begins and lowers it after that
// where it ends, so that slices with the count 0 are empty. The bisection follows from a LoadProfile. Steps to both
// sides are made only when a second plane is asked for, because most cuts need none: the profile, which is large, is
// then made again instead of being kept while halves are built.
#include "cut/cut/inside/plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "cut/cut/inside/band.h"

namespace kerf {

namespace {

constexpr double step_length = 0.6;  // in crossing edges
constexpr double step_growth = 0.15;

double bisecting_height(const LoadProfile& profile, double fraction, Criterion criterion) {
    if (criterion == Criterion::equidistant)
        return profile.lowest() + fraction * (profile.highest() - profile.lowest());
    return profile.bisect(fraction);
}

// Heights over the plane in the middle of each gap, ascending: nothing of the surface lies there.
std::vector<double> middles_of_gaps(const Surface& surface, const Plane& plane) {
    constexpr std::int32_t slices = 1024;
    Array<Vertex, double> heights(surface.vertex_count());
    for (const Vertex v : surface.vertices()) heights[v] = plane.distance(surface.point(v));
    const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
    const double low = *lowest, thickness = (*highest - low) / slices;
    if (!(thickness > 0)) return {};
    const auto slice_of = [&](double height) {
        return std::min(slices - 1, static_cast<std::int32_t>((height - low) / thickness));
    };
    std::array<std::int32_t, slices + 1> change = {};  // of the number of facets from one slice to the next
    for (const Facet f : surface.facets()) {
        const auto [a, b, c] = surface.corners(f);
        const auto [least, most] = std::minmax({heights[a], heights[b], heights[c]});
        ++change[slice_of(least)];
        --change[slice_of(most) + 1];
    }
    std::vector<double> middles;
    std::int32_t facets = 0, first_empty = 0;
    for (std::int32_t slice = 0; slice < slices; ++slice) {
        facets += change[slice];
        if (facets == 0) continue;
        if (first_empty < slice) middles.push_back(low + (first_empty + slice) * thickness / 2);
        first_empty = slice + 1;
    }
    return middles;
}

}  // namespace

std::vector<Vec3> cut_directions(const Surface& surface, const MassProperties& mass, const CutOptions& options) {
    if (options.axis >= 0) return {Vec3::Unit(options.axis)};
    if (options.criterion == Criterion::inertia) return {mass.axes.col(0), mass.axes.col(1), mass.axes.col(2)};
    Eigen::AlignedBox3d box;
    for (const Vertex v : surface.vertices()) box.extend(surface.point(v));
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

std::optional<PlaneCandidate> PlaneSequence::between_bodies() const {
    if (options_.criterion == Criterion::equidistant) return std::nullopt;
    const std::vector<double> heights = middles_of_gaps(surface_, through_centroid_);
    if (heights.empty()) return std::nullopt;
    const LoadProfile profile(surface_, through_centroid_, options_.bisected_load());
    std::vector<double> off = profile.fractions_below(heights);
    for (double& fraction : off) fraction = std::abs(fraction - fraction_);
    const auto nearest = std::min_element(off.begin(), off.end());
    if (*nearest > options_.load_window) return std::nullopt;
    return PlaneCandidate{through_centroid_.shifted(heights[nearest - off.begin()]), axis_};
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
