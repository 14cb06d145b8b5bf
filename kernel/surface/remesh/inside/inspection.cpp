// Facets are compared in ranges, each with a bound of its own that is raised where it does not hold: proofs by a larger
// bound than needed are coarser, and would report it. A facet of the result begins with the facet of the input that it
// was last near; one of the input with a facet of the result that was near it.
#include "surface/remesh/inside/inspection.h"

#include <algorithm>
#include <array>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

// Of the deviation. A proof that fails may have taken long, so there are few.
constexpr std::array bounds = {0.2, 0.6, 0.75, 0.9, 1.0};
// The divisions allowed for one facet in the proof: it may be near all of the other surface, along whose facets it is
// divided.
constexpr std::size_t least_divisions = 100'000, divisions_per_facet = 16;
// Each range finds its bound anew, so there are few; but enough for all threads.
constexpr std::size_t least_of_range = 1 << 5, most_of_range = 1 << 11, ranges_wanted = 16;

// A surface to which the facets of another one are near.
class Side {
 public:
    Side(const Nearness& nearness, std::size_t facets, double deviation)
        : nearness_(nearness),
          deviation_(deviation),
          most_divisions_(static_cast<int>(
              std::min<std::size_t>(least_divisions + divisions_per_facet * facets, std::size_t{1} << 30))) {}

    /// `hint`: a facet to begin with, -1: that where the last one ended.
    bool is_near(const std::vector<Vec3>& vertices, const Triangle& t, std::int32_t hint) {
        if (hint >= 0) last_ = hint;
        for (;; ++step_) {
            const double bound = bounds[step_] * deviation_;
            if (nearness_.holds(
                    {vertices[t[0]], vertices[t[1]], vertices[t[2]]}, bound, [&](std::int32_t) { return bound; },
                    most_divisions_, last_))
                return true;
            if (step_ + 1 == bounds.size()) return false;
        }
    }
    double distance() const { return nearness_.directed_distance(); }

 private:
    Nearness nearness_;
    double deviation_;
    std::size_t step_ = 0;  // of the bound that does for all so far
    int most_divisions_;
    std::int32_t last_ = -1;
};

struct Comparison {
    std::vector<std::int32_t> far;  // facets of which some point is too far
    double distance = 0;
};

// Compares the facets of one surface with another one, which has those that are marked as `same`.
Comparison compare(const SurfaceArrays& surface, const std::vector<char>& same, const std::vector<std::int32_t>& hints,
                   const Nearness& other, std::size_t facets_of_other, double deviation,
                   const CancellationCheck& check_cancelled) {
    const std::size_t count = surface.facets.size();
    const std::size_t grain = std::clamp(count / ranges_wanted, least_of_range, most_of_range);
    const auto ranges = values_of_ranges(count, grain, [&](const IndexRange& range) {
        Side side(other, facets_of_other, deviation);
        Comparison found;
        for (std::size_t f = range.first; f < range.last; ++f) {
            check_cancelled.at(f);
            if (!same.empty() && same[f] != 0) continue;
            if (!side.is_near(surface.vertices, surface.facets[f], hints[f])) found.far.push_back(f);
        }
        found.distance = side.distance();
        return found;
    });
    Comparison all;
    for (const Comparison& range : ranges) {
        all.far.insert(all.far.end(), range.far.begin(), range.far.end());
        all.distance = std::max(all.distance, range.distance);
    }
    return all;
}

// A facet of the result that was near each facet of the input, -1: none.
std::vector<std::int32_t> hints_of_input(std::size_t facets, const std::vector<std::int32_t>& near) {
    std::vector<std::int32_t> hints(facets, -1);
    for (std::int32_t f = 0; f < count_of(near); ++f)
        if (near[f] >= 0) hints[near[f]] = f;
    return hints;
}

}  // namespace

bool Inspection::has_passed() const { return std::find(refused.begin(), refused.end(), char{1}) == refused.end(); }

std::vector<char> find_meeting(const InspectedInput& input, double deviation, const SurfaceArrays& surface) {
    std::vector<char> is_near(input.surface.facets.size(), 0);
    for (const auto& [f, g] : find_self_intersections(surface.vertices, surface.facets))
        for (const std::int32_t facet : {f, g})
            for_each_sample(surface.vertices, surface.facets[facet], [&](const Vec3& p) {
                input.tree.any_within(p, deviation, [&](std::int32_t near, double) {
                    is_near[near] = 1;
                    return false;
                });
            });
    return is_near;
}

Inspection inspect(const InspectedInput& input, const std::vector<char>& kept, double deviation,
                   const ChangedSurface& result, const CancellationCheck& check_cancelled) {
    const SurfaceArrays& now = result.surface;
    const std::size_t facets = input.surface.facets.size();
    Inspection inspection = {find_meeting(input, deviation, now)};
    const Comparison to_input =
        compare(now, result.is_kept, result.near, input.nearness, facets, deviation, check_cancelled);
    for (const std::int32_t f : to_input.far)
        for_each_sample(now.vertices, now.facets[f],
                        [&](const Vec3& p) { inspection.refused[input.tree.closest(p).facet] = 1; });
    const TriangleTree tree(now.vertices, now.facets);
    const Comparison from_input = compare(input.surface, kept, hints_of_input(facets, result.near),
                                          Nearness(tree, now.facets), now.facets.size(), deviation, check_cancelled);
    for (const std::int32_t f : from_input.far) inspection.refused[f] = 1;
    inspection.distance_to_input = to_input.distance;
    inspection.distance_from_input = from_input.distance;
    return inspection;
}

}  // namespace kerf
