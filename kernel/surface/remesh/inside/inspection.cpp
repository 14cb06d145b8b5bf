#include "surface/remesh/inside/inspection.h"

#include <algorithm>

#include "base/core/cancellation.h"
#include "surface/diagnosis/intersections.h"
#include "surface/diagnosis/nearness.h"

namespace kerf {

namespace {

constexpr double first_bound = 0.2, step_of_bound = 1.25;  // of the deviation; of the one before
// The divisions allowed for one facet in the proof: it may be near all of the other surface, along whose facets it is
// divided.
constexpr int least_divisions = 100'000, divisions_per_facet = 16;

int divisions_for(std::size_t facets) {
    return static_cast<int>(std::min<std::size_t>(least_divisions + divisions_per_facet * facets, 1 << 30));
}

// One of the surfaces, with the bounds within which the facets of the other are known to be near.
struct Side {
    Nearness nearness;
    int most_divisions;
    double bound;            // that does for all so far
    std::int32_t last = -1;  // facet of this side that the last one is near

    Side(const TriangleTree& tree, const std::vector<Triangle>& facets, double deviation)
        : nearness(tree, facets), most_divisions(divisions_for(facets.size())), bound(first_bound * deviation) {}
};

bool is_near(const std::vector<Vec3>& vertices, const Triangle& t, const RemeshOptions& options, Side& side) {
    const auto holds = [&] {
        return side.nearness.holds(
            {vertices[t[0]], vertices[t[1]], vertices[t[2]]}, side.bound, [&](std::int32_t) { return side.bound; },
            side.most_divisions, side.last);
    };
    for (; !holds(); side.bound = std::min(options.deviation, step_of_bound * side.bound))
        if (side.bound == options.deviation) return false;
    return true;
}

}  // namespace

std::vector<char> inspect(const SurfaceArrays& input, const TriangleTree& input_tree, const RemeshOptions& options,
                          const SurfaceArrays& result, RemeshReport& report) {
    std::vector<char> refused(input.facets.size(), 0);
    const auto refuse_around = [&](const Vec3& p) {
        input_tree.any_within(p, options.deviation, [&](std::int32_t near, double) {
            refused[near] = 1;
            return false;
        });
    };
    for (const auto& [f, g] : find_self_intersections(result.vertices, result.facets))
        for (const std::int32_t facet : {f, g}) for_each_sample(result.vertices, result.facets[facet], refuse_around);
    const CancellationCheck poll(options.poll);
    Side to_input(input_tree, input.facets, options.deviation);
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        poll.at(f);
        const Triangle& t = result.facets[f];
        if (!is_near(result.vertices, t, options, to_input))
            for_each_sample(result.vertices, t, [&](const Vec3& p) { refused[input_tree.closest(p).facet] = 1; });
    }
    const TriangleTree tree(result.vertices, result.facets);
    Side from_input(tree, result.facets, options.deviation);
    for (std::size_t f = 0; f < input.facets.size(); ++f) {
        poll.at(f);
        if (!is_near(input.vertices, input.facets[f], options, from_input)) refused[f] = 1;
    }
    report.distance_to_input = to_input.nearness.directed_distance();
    report.distance_from_input = from_input.nearness.directed_distance();
    return refused;
}

}  // namespace kerf
