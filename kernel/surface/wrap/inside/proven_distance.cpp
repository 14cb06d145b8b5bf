#include "surface/wrap/inside/proven_distance.h"

#include <algorithm>
#include <cmath>

#include "base/core/cancellation.h"
#include "surface/diagnosis/nearness.h"

namespace kerf {

double proven_distance(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                       const std::vector<char>& chosen, const TriangleTree& tree, const std::vector<Triangle>& others,
                       double tolerance, const std::function<void()>& check_cancelled) {
    constexpr double slack = 1.02, step_of_limit = 1.1;
    constexpr int most_divisions = 20'000;
    const CancellationCheck check(check_cancelled);
    const auto is_chosen = [&](std::size_t f) { return chosen.empty() || chosen[f] != 0; };

    std::vector<char> is_measured(vertices.size(), 0);
    double squared = 0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        check.at(f);
        if (!is_chosen(f)) continue;
        Vec3 sum = Vec3::Zero();
        for (const std::int32_t v : facets[f]) {
            sum += vertices[v];
            if (is_measured[v]) continue;
            is_measured[v] = 1;
            squared = std::max(squared, tree.closest(vertices[v]).squared_distance);
        }
        squared = std::max(squared, tree.closest(sum / 3).squared_distance);
    }

    double limit = slack * std::sqrt(squared) + tolerance;  // that does for all facets so far
    Nearness nearness(tree, others);
    std::int32_t last = -1;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        check.at(f);
        const auto& [a, b, c] = facets[f];
        const auto limit_of = [&](std::int32_t) { return limit; };
        while (is_chosen(f) &&
               !nearness.holds({vertices[a], vertices[b], vertices[c]}, limit, limit_of, most_divisions, last))
            limit *= step_of_limit;
    }
    return std::min(limit, nearness.directed_distance());
}

}  // namespace kerf
