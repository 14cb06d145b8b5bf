#include "surface/arrange/divided_soup.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/core/check.h"

namespace kerf {

namespace {

void number_new_vertices(Soup& soup, std::size_t count) {
    std::vector<std::int32_t>& number = soup.vertex_number;
    if (number.empty()) return;
    const std::size_t old_count = number.size();
    const std::int32_t next = 1 + *std::max_element(number.begin(), number.end());
    number.resize(count);
    std::iota(number.begin() + old_count, number.end(), next);
}

void drop_lost_model_edges(Soup& soup) {
    if (soup.model_edges.empty()) return;
    std::vector<UndirectedEdge> edges;
    for (const Triangle& t : soup.facets)
        for (std::size_t i = 0; i < 3; ++i) edges.push_back(undirected(t[i], t[(i + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    std::erase_if(soup.model_edges, [&](const ModelEdge& edge) {
        return !std::binary_search(edges.begin(), edges.end(), edge.vertices);
    });
}

}  // namespace

void take_divided_facets(Soup& soup, Arrangement arrangement, const std::vector<char>& keep,
                         const std::vector<char>& turn) {
    KERF_CHECK(soup.sides.empty() && keep.size() == arrangement.facets.size() && turn.size() == keep.size());
    std::vector<Triangle> facets;
    std::vector<std::int32_t> patch, polygon;
    for (std::size_t f = 0; f < keep.size(); ++f) {
        if (!keep[f]) continue;
        const std::int32_t parent = arrangement.parent[f];
        facets.push_back(arrangement.facets[f]);
        if (turn[f]) std::swap(facets.back()[1], facets.back()[2]);
        patch.push_back(soup.patch[parent]);
        polygon.push_back(soup.polygon.empty() ? parent : soup.polygon[parent]);
    }
    soup.facets = std::move(facets);
    soup.patch = std::move(patch);
    soup.polygon = std::move(polygon);
    number_new_vertices(soup, arrangement.vertices.size());
    soup.vertices = std::move(arrangement.vertices);
    drop_lost_model_edges(soup);
}

}  // namespace kerf
