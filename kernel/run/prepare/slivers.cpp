#include "run/prepare/slivers.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/core/threads.h"
#include "surface/remesh/remesh.h"

namespace kerf {

namespace {

constexpr double sine_of_10 = 0.17364817766693033;
constexpr int rings = 2;  // of facets around a sliver that change with it

bool is_sliver(const std::vector<Vec3>& vertices, const Triangle& t) {
    return smallest_sine(vertices[t[0]], vertices[t[1]], vertices[t[2]]) < sine_of_10;
}

// Counts slivers on threads. `is_bad`: takes the number of a facet.
template <class IsBad>
Slivers count_slivers(std::int64_t facets, const IsBad& is_bad) {
    constexpr std::size_t grain = std::size_t{1} << 16;
    const std::vector<std::int64_t> counts = values_of_ranges(facets, grain, [&](const IndexRange& range) {
        std::int64_t count = 0;
        for (std::size_t f = range.first; f < range.last; ++f) count += is_bad(f);
        return count;
    });
    return {std::accumulate(counts.begin(), counts.end(), std::int64_t{0}), facets};
}

}  // namespace

Slivers find_slivers(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    return count_slivers(facets.size(), [&](std::size_t f) { return is_sliver(vertices, facets[f]); });
}

Slivers find_slivers(const Complex& complex) {
    return count_slivers(complex.facet_count(), [&](std::size_t f) {
        const auto [a, b, c] = complex.vertices(f);
        return smallest_sine(complex.point(a), complex.point(b), complex.point(c)) < sine_of_10;
    });
}

std::vector<char> facets_away_from_slivers(const SurfaceArrays& surface) {
    const std::vector<Triangle>& facets = surface.facets;
    std::vector<char> stays(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) stays[f] = !is_sliver(surface.vertices, facets[f]);
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<char> is_near(surface.vertices.size(), 0);
        for (std::size_t f = 0; f < facets.size(); ++f)
            if (stays[f] == 0)
                for (const std::int32_t v : facets[f]) is_near[v] = 1;
        for (std::size_t f = 0; f < facets.size(); ++f)
            if (std::any_of(facets[f].begin(), facets[f].end(), [&](std::int32_t v) { return is_near[v] != 0; }))
                stays[f] = 0;
    }
    const auto kept = std::count(stays.begin(), stays.end(), char{1});
    if (2 * kept < std::ssize(facets)) stays.clear();
    return stays;
}

std::string sliver_note(const Slivers& slivers, const std::string& remedy) {
    if (!slivers.spoil_cells()) return "";
    return fmt::format("{:.2g} % of the facets have angles below 10 degrees, and cells will be no better.{}",
                       100 * slivers.share(), remedy.empty() ? "" : fmt::format(" {} cures that.", remedy));
}

}  // namespace kerf
