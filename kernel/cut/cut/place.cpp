// The area of the section at height s is the derivative of the volume below, A(s) = - sum of the facets' area vectors
// below s, normal component: one histogram of the facets gives it at all heights, and its integral the volume.
#include "cut/cut/place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/triangle.h"
#include "cut/cut/inside/ordered_terms.h"
#include "cut/cut/inside/plane.h"

namespace kerf {

namespace {

constexpr double least_fraction = 0.01;  // of the load, of a place that somebody chose
constexpr std::size_t bins = 128;
constexpr std::int32_t least_leaves = 8;  // below, what a cut unbalances is not evened out any more
constexpr double least_gain = 0.25;       // of the section's area

// Load and section below the upper end of each bin of heights.
struct SectionProfile {
    std::array<double, bins> load{}, area{};

    // The section where the given share of the load lies below.
    double area_at(double fraction) const {
        const auto it = std::lower_bound(load.begin(), load.end(), fraction * load.back());
        return area[std::min(it, load.end() - 1) - load.begin()];
    }
};

// The facets along one direction.
struct SectionBins {
    Vec3 direction;
    double low, bin_height;
    std::array<double, bins> count{}, area_z{};

    SectionBins(const Surface& surface, const Vec3& along) : direction(along) {
        const auto [lowest, highest] = bounds_on_threads(
            surface.vertex_count(), [&](std::size_t v) { return along.dot(surface.point(Vertex(v))); });
        low = lowest;
        bin_height = (highest - lowest) / bins;
    }
    std::size_t bin_of(double height) const {
        return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, (height - low) / bin_height)));
    }
    SectionProfile profile(const LoadModel& model) const;
};

SectionProfile SectionBins::profile(const LoadModel& model) const {
    std::array<double, bins> sampled{};  // volume, where that is not the area's integral
    if (model.depends_on_place())
        for (const VolumeSample& sample : *model.samples)
            sampled[bin_of(direction.dot(sample.point))] += sample.sized_volume;
    SectionProfile profile;
    double facets = 0, area = 0, volume = 0;
    for (std::size_t i = 0; i < bins; ++i) {
        facets += count[i];
        area -= area_z[i];
        volume += model.depends_on_place() ? sampled[i] : area * bin_height;
        profile.load[i] = model.load(facets, facets, volume);
        profile.area[i] = area;
    }
    return profile;
}

// All directions in one pass over the facets: to reach their corners costs more than the sums.
std::vector<SectionProfile> section_profiles(const Surface& surface, const std::vector<Vec3>& directions,
                                             const LoadModel& model) {
    struct Term {
        std::array<std::size_t, 3> bin;
        std::array<double, 3> area_z;
    };
    std::vector<SectionBins> sections;
    for (const Vec3& direction : directions) sections.emplace_back(surface, direction);
    KERF_CHECK(sections.size() <= 3);
    const auto term_of = [&](std::size_t f) {
        const auto t = surface.corners(Facet(f));
        const Vec3 &a = surface.point(t[0]), &b = surface.point(t[1]), &c = surface.point(t[2]);
        const Vec3 sum = a + b + c, doubled_area = doubled_area_vector(a, b, c);
        Term term;
        for (std::size_t i = 0; i < sections.size(); ++i) {
            term.bin[i] = sections[i].bin_of(sections[i].direction.dot(sum) / 3);
            term.area_z[i] = doubled_area.dot(sections[i].direction) / 2;
        }
        return term;
    };
    add_in_order(surface.facet_count(), term_of, [&](const Term& term) {
        for (std::size_t i = 0; i < sections.size(); ++i) {
            sections[i].count[term.bin[i]] += 1;
            sections[i].area_z[term.bin[i]] += term.area_z[i];
        }
    });
    std::vector<SectionProfile> profiles;
    for (const SectionBins& section : sections) profiles.push_back(section.profile(model));
    return profiles;
}

}  // namespace

CutPlace choose_place(const Surface& surface, const MassProperties& mass, std::int32_t leaves,
                      const CutOptions& options) {
    KERF_CHECK(leaves >= 2);
    CutPlace place{static_cast<double>(leaves / 2) / leaves};
    KERF_CHECK(!options.bisected_load().depends_on_place() || options.samples);
    const bool free = options.criterion == Criterion::inertia && options.balance != Balance::inertia;
    if (!free || options.axis >= 0 || leaves < least_leaves) return place;
    const double half = place.fraction;
    const std::vector<Vec3> directions = cut_directions(surface, mass, options);
    const std::vector<SectionProfile> profiles = section_profiles(surface, directions, options.bisected_load());
    const double usual = profiles[0].area_at(half);
    double best = (1 - least_gain) * usual;
    for (std::int32_t axis = 0; axis < count_of(directions); ++axis) {
        const SectionProfile& profile = profiles[axis];
        for (std::int32_t below = 1; below < leaves; ++below) {
            const double fraction = static_cast<double>(below) / leaves;
            const double area = profile.area_at(fraction);
            if (std::abs(fraction - half) > options.load_window || area <= 0 || area >= best) continue;
            best = area;
            place = {fraction, axis, 1 - area / usual};
        }
    }
    return place;
}

CutPlace place_of(const Plane& plane, const Surface& surface, const MassProperties& mass, const CutOptions& options) {
    const std::vector<Vec3> directions = cut_directions(surface, mass, options);
    CutPlace place;
    for (std::int32_t axis = 1; axis < count_of(directions); ++axis) {
        const double nearest = std::abs(plane.normal.dot(directions[place.axis]));
        if (std::abs(plane.normal.dot(directions[axis])) > nearest) place.axis = axis;
    }
    const Plane through_centroid(mass.centroid, directions[place.axis]);
    const LoadProfile profile(surface, through_centroid, options.bisected_load());
    const double height = through_centroid.distance(plane.origin);
    const double extent = profile.highest() - profile.lowest();
    if (options.criterion == Criterion::equidistant)
        place.fraction = extent > 0 ? (height - profile.lowest()) / extent : 0.5;
    else
        place.fraction = profile.fraction_below(height);
    place.fraction = std::clamp(place.fraction, least_fraction, 1 - least_fraction);
    return place;
}

}  // namespace kerf
