#include "surface/openings/hole_filling.h"

#include <algorithm>

#include "base/core/elements.h"
#include "surface/diagnosis/open_loops.h"
#include "surface/openings/inside/hole_triangulation.h"

namespace kerf {

namespace {

// Facets over positions in the loop, in its direction.
std::vector<Triangle> span_loop(const Soup& soup, const OpenLoop& loop) {
    std::vector<Vec3> rim;
    for (const std::int32_t v : loop.vertices) rim.push_back(soup.vertices[v]);
    return triangulate_hole(rim, {});
}

}  // namespace

HoleFilling fill_holes(Soup& soup, std::int32_t most_edges) {
    std::vector<Triangle> proper;
    for (const Triangle& t : soup.facets)
        if (!has_repeated_vertex(t)) proper.push_back(t);
    HoleFilling filling;
    const auto patch = static_cast<std::int32_t>(soup.patch_names.size());
    const auto next_polygon = soup.polygon.empty() ? 0 : soup.polygon.back() + 1;
    for (const OpenLoop& loop : find_open_loops(soup.vertices, proper)) {
        const bool finite = std::all_of(loop.vertices.begin(), loop.vertices.end(),
                                        [&](std::int32_t v) { return soup.vertices[v].allFinite(); });
        if (!loop.closed || !finite || loop.vertices.size() < 3 ||
            loop.vertices.size() > static_cast<std::size_t>(most_edges))
            continue;
        const std::vector<Triangle> facets = span_loop(soup, loop);
        filling.holes += !facets.empty();
        for (const Triangle& t : facets) {
            soup.facets.push_back({loop.vertices[t[0]], loop.vertices[t[1]], loop.vertices[t[2]]});
            soup.patch.push_back(patch);
            if (!soup.polygon.empty()) soup.polygon.push_back(next_polygon + static_cast<std::int32_t>(filling.facets));
            ++filling.facets;
        }
    }
    if (filling.facets > 0) soup.patch_names.emplace_back("filled");
    return filling;
}

}  // namespace kerf
