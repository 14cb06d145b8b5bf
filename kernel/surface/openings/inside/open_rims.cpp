#include "surface/openings/inside/open_rims.h"

#include <algorithm>

#include "base/core/elements.h"
#include "surface/diagnosis/open_loops.h"
#include "surface/diagnosis/orientation.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

std::vector<Vec3> Rim::points(const Soup& soup) const {
    std::vector<Vec3> places;
    for (const std::int32_t v : vertices) places.push_back(soup.vertices[v]);
    return places;
}

Vec3 Rim::centre(const Soup& soup) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : vertices) sum += soup.vertices[v] / static_cast<double>(vertices.size());
    return sum;
}

OpenRims::OpenRims(const Soup& soup) : soup_(soup), passes_(soup.vertices.size(), 0) {
    std::vector<Triangle> proper;
    std::vector<std::int32_t> number;  // in the soup
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (has_repeated_vertex(soup.facets[f])) continue;
        proper.push_back(soup.facets[f]);
        number.push_back(static_cast<std::int32_t>(f));
    }
    const std::vector<std::int32_t> partners = edge_partners(proper);
    if (std::find(partners.begin(), partners.end(), -1) == partners.end()) return;
    const ConsistentFacets consistent = make_consistent(proper);
    std::vector<char> is_one_sided(static_cast<std::size_t>(consistent.shell_count), 0);
    for (const std::int32_t f : consistent.contradictions) is_one_sided[consistent.shell[f]] = 1;
    for (OpenLoop& loop : find_open_loops(soup.vertices, consistent.facets)) {
        Rim& rim = rims_.emplace_back();
        rim.length = loop.length;
        const bool is_finite = std::all_of(loop.vertices.begin(), loop.vertices.end(),
                                           [&](std::int32_t v) { return soup.vertices[v].allFinite(); });
        const bool has_no_side = std::any_of(loop.facets.begin(), loop.facets.end(),
                                             [&](std::int32_t f) { return is_one_sided[consistent.shell[f]]; });
        rim.obstacle = !is_finite     ? RimObstacle::infinite
                       : has_no_side  ? RimObstacle::one_sided
                       : !loop.closed ? RimObstacle::no_loop
                                      : RimObstacle::none;
        for (std::size_t i = 0; i < loop.facets.size(); ++i) {
            const std::int32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.vertices.size()];
            rim.facets.push_back(number[loop.facets[i]]);
            for (const std::int32_t v : proper[loop.facets[i]])
                if (v != a && v != b) rim.apexes.push_back(soup.vertices[v]);
        }
        rim.vertices = std::move(loop.vertices);
        for (const std::int32_t v : rim.vertices) ++passes_[v];
    }
    find_facets();
}

void OpenRims::find_facets() {
    first_.assign(passes_.size() + 1, 0);
    const auto for_each = [&](auto visit) {
        for (std::size_t f = 0; f < soup_.facets.size(); ++f)
            if (!has_repeated_vertex(soup_.facets[f]))
                for (const std::int32_t v : soup_.facets[f])
                    if (passes_[v] > 0) visit(v, static_cast<std::int32_t>(f));
    };
    for_each([&](std::int32_t v, std::int32_t) { ++first_[v + 1]; });
    for (std::size_t v = 0; v < passes_.size(); ++v) first_[v + 1] += first_[v];
    facets_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> end(first_.begin(), first_.end() - 1);
    for_each([&](std::int32_t v, std::int32_t f) { facets_[end[v]++] = f; });
}

std::span<const std::int32_t> OpenRims::facets_at(std::int32_t vertex) const {
    if (first_.empty()) return {};
    return {facets_.data() + first_[vertex], facets_.data() + first_[vertex + 1]};
}

}  // namespace kerf
