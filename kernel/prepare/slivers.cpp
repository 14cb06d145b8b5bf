#include "prepare/slivers.h"

#include <algorithm>

#include <fmt/format.h>

#include "remesh/remesh.h"

namespace kerf {

namespace {

constexpr double sine_of_10 = 0.17364817766693033;
constexpr int rings = 2;  // of facets around a sliver that change with it

bool is_sliver(const std::vector<Vec3>& vertices, const Triangle& t) {
    return smallest_sine(vertices[t[0]], vertices[t[1]], vertices[t[2]]) < sine_of_10;
}

}  // namespace

Slivers find_slivers(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    const auto count =
        std::count_if(facets.begin(), facets.end(), [&](const Triangle& t) { return is_sliver(vertices, t); });
    return {count, static_cast<std::int64_t>(facets.size())};
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
    if (2 * kept < static_cast<std::ptrdiff_t>(facets.size())) stays.clear();
    return stays;
}

std::string sliver_note(const Slivers& slivers, const std::string& path) {
    if (!slivers.spoil_cells()) return "";
    return fmt::format("{:.2g} % of the facets have angles below 10 degrees, and cells will be no better.{}",
                       100 * slivers.share(),
                       path.empty() ? "" : fmt::format(" kerf mesh {} --surface remesh cures that.", path));
}

}  // namespace kerf
