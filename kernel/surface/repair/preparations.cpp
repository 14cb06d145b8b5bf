// The steps before the others. Merging takes vertices wherever they are, as exporters write them that repeat each
// vertex with other last digits; it knows no bound and no border, unlike `weld`. Spanning takes each closed loop of
// open edges by itself, by CGAL's search for the flattest triangulation of its own vertices (Liepa 2003, liepa2003): it
// refuses no lid, adds no vertex and follows no curvature, unlike `holes`; loops that it cannot span stay. Facets with
// a repeated vertex do not bound loops. A surface whose facets say what they bound is not spanned, since nothing tells
// the sides.
#include <algorithm>

#include <fmt/format.h>

#include "base/core/elements.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "surface/diagnosis/open_loops.h"
#include "surface/openings/hole_triangulation.h"
#include "surface/regions/regions.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

std::vector<OpenLoop> loops_of_ordinary_facets(const Soup& soup) {
    std::vector<Triangle> proper;
    for (const Triangle& t : soup.facets)
        if (!has_repeated_vertex(t)) proper.push_back(t);
    return find_open_loops(soup.vertices, proper);
}

bool can_be_spanned(const Soup& soup, const OpenLoop& loop, double most_edges) {
    const bool is_finite = std::all_of(loop.vertices.begin(), loop.vertices.end(),
                                       [&](std::int32_t v) { return soup.vertices[v].allFinite(); });
    return loop.closed && is_finite && loop.vertices.size() >= 3 && loop.vertices.size() <= most_edges;
}

// Returns facets over positions in the loop, in its direction.
std::vector<Triangle> span_loop(const Soup& soup, const OpenLoop& loop) {
    std::vector<Vec3> rim;
    for (const std::int32_t v : loop.vertices) rim.push_back(soup.vertices[v]);
    return triangulate_hole(rim, {});
}

}  // namespace

void merge_step(Soup& soup, const StepRequest& request, StepReport& report) {
    constexpr double rounding = 1e-16;  // of the diagonal: nearer vertices are equal, and merged already
    const double tolerance = request.amount, diagonal = request.diagonal;
    if (tolerance > diagonal && diagonal > 0)
        throw Error(ErrorCode::usage, fmt::format("--weld is {:.6g}, but the surface, from corner to corner of its "
                                                  "bounding box, is {:.6g}. Give less.",
                                                  tolerance, diagonal));
    RepairAction merged{"vertex merged", "vertices merged"};
    if (tolerance > rounding * diagonal) merged.count = weld_within(soup, tolerance);
    report.actions.push_back(std::move(merged));
}

void largest_step(Soup& soup, const StepRequest& /*request*/, StepReport& report) {
    RepairAction removed{"facet of smaller components removed", "facets of smaller components removed"};
    removed.count = keep_largest_component(soup);
    report.actions.push_back(std::move(removed));
}

void span_step(Soup& soup, const StepRequest& request, StepReport& report) {
    if (!soup.sides.empty()) return;
    RepairAction filled{"hole filled", "holes filled"};
    const auto patch = count_of(soup.patch_names);
    const auto next_polygon = soup.polygon.empty() ? 0 : soup.polygon.back() + 1;
    for (const OpenLoop& loop : loops_of_ordinary_facets(soup)) {
        if (!can_be_spanned(soup, loop, request.amount)) continue;
        const std::vector<Triangle> facets = span_loop(soup, loop);
        filled.count += !facets.empty();
        for (const Triangle& t : facets) {
            soup.facets.push_back({loop.vertices[t[0]], loop.vertices[t[1]], loop.vertices[t[2]]});
            soup.patch.push_back(patch);
            if (!soup.polygon.empty()) soup.polygon.push_back(next_polygon + report.added_facets);
            ++report.added_facets;
        }
    }
    if (report.added_facets > 0) soup.patch_names.emplace_back("filled");
    report.actions.push_back(std::move(filled));
}

}  // namespace kerf
