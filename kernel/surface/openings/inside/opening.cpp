// Rims are the loops of open edges once each facet is turned like most of its shell, whichever way it was turned. An
// opening is described by the outline of its rims: their points one after another, each rim in the direction of
// facets that would fill it. Triangles and patches use places in the outline, not vertices of the soup. The bend is the
// mean angle between the normals of the triangle inside and the facet outside over all edges of the rims, weighted by
// their lengths: it tells a hole, an end and the rim of a sheet apart. Edges that the surface has between points of the
// rims are "taken": a patch with one of them would give it more than two facets. Only smooth patches need the
// surroundings, the facets at the rims and their other vertices, which are numbered on from the outline.
#include "surface/openings/inside/opening.h"

#include <algorithm>
#include <numbers>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "surface/diagnosis/open_loops.h"
#include "surface/diagnosis/orientation.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

struct RimOutline {
    std::vector<Vec3> points, apexes;     // of all rims
    std::vector<std::int32_t> vertices;   // of the soup
    std::vector<std::int32_t> counts;     // of each rim
    std::vector<std::int32_t> successor;  // of each point

    RimOutline(const Soup& soup, const std::vector<const Rim*>& rims) {
        for (const Rim* rim : rims) {
            const auto first = count_of(points);
            const auto count = count_of(rim->vertices);
            for (std::int32_t i = 0; i < count; ++i) successor.push_back(first + (i + 1) % count);
            for (const std::int32_t v : rim->vertices) points.push_back(soup.vertices[v]);
            vertices.insert(vertices.end(), rim->vertices.begin(), rim->vertices.end());
            apexes.insert(apexes.end(), rim->apexes.begin(), rim->apexes.end());
            counts.push_back(count);
        }
    }
};

double mean_bend(const RimOutline& outline, const std::vector<Triangle>& triangles) {
    double sum = 0, length = 0;
    for (const Triangle& t : triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            if (outline.successor[a] != b) continue;
            const Vec3 &p = outline.points[a], &q = outline.points[b];
            const Vec3 inside = doubled_area_vector(p, q, outline.points[t[(i + 2) % 3]]);
            const Vec3 outside = doubled_area_vector(q, p, outline.apexes[a]);
            const double weight = (q - p).norm();
            if (inside.isZero(0) || outside.isZero(0)) continue;
            sum += weight * angle_between(inside, outside);
            length += weight;
        }
    return length > 0 ? sum / length * 180 / std::numbers::pi : 0;
}

// Returns the edges of the surface between vertices of the rims that are not edges of a rim.
std::vector<UndirectedEdge> taken_edges(const OpenRims& all, const RimOutline& outline) {
    std::vector<std::pair<std::int32_t, std::int32_t>> place;  // of vertices of the soup
    for (std::int32_t i = 0; i < count_of(outline.vertices); ++i) place.emplace_back(outline.vertices[i], i);
    std::sort(place.begin(), place.end());
    std::vector<UndirectedEdge> taken;
    for (std::int32_t i = 0; i < count_of(outline.vertices); ++i)
        for (const std::int32_t f : all.facets_at(outline.vertices[i]))
            for (const std::int32_t v : all.soup().facets[f]) {
                const auto found = std::lower_bound(place.begin(), place.end(), std::pair(v, -1));
                if (found == place.end() || found->first != v) continue;
                const std::int32_t j = found->second;
                if (i < j && outline.successor[i] != j && outline.successor[j] != i) taken.push_back({i, j});
            }
    std::sort(taken.begin(), taken.end());
    taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
    return taken;
}

PatchSurroundings surroundings(const OpenRims& all, const RimOutline& outline) {
    PatchSurroundings around;
    std::vector<std::int32_t> facets;
    for (const std::int32_t v : outline.vertices) {
        const auto at = all.facets_at(v);
        facets.insert(facets.end(), at.begin(), at.end());
        around.is_whole.push_back(all.is_passed_once(v));
    }
    std::sort(facets.begin(), facets.end());
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
    std::vector<std::pair<std::int32_t, std::int32_t>> place;  // of vertices of the soup: of the rims, then others
    for (std::int32_t i = 0; i < count_of(outline.vertices); ++i) place.emplace_back(outline.vertices[i], i);
    std::sort(place.begin(), place.end());
    const std::size_t on_rims = place.size();
    std::vector<std::int32_t> beside;
    const auto find = [&](std::int32_t v) {
        const auto end = place.begin() + on_rims;
        const auto found = std::lower_bound(place.begin(), end, std::pair(v, -1));
        return found != end && found->first == v ? found->second : -1;
    };
    for (const std::int32_t f : facets)
        for (const std::int32_t v : all.soup().facets[f])
            if (find(v) < 0 && all.soup().vertices[v].allFinite()) beside.push_back(v);
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const std::int32_t v : beside) around.points.push_back(all.soup().vertices[v]);
    for (const std::int32_t f : facets) {
        std::array<std::int32_t, 3> own{};
        bool is_finite = true;
        for (int i = 0; i < 3; ++i) {
            const std::int32_t v = all.soup().facets[f][i];
            is_finite &= all.soup().vertices[v].allFinite();
            own[i] = find(v);
            if (own[i] < 0)
                own[i] =
                    count_of(outline.vertices) + (std::lower_bound(beside.begin(), beside.end(), v) - beside.begin());
        }
        if (is_finite) around.facets.push_back(own);
    }
    return around;
}

}  // namespace

std::vector<Vec3> Rim::points(const Soup& soup) const {
    std::vector<Vec3> places;
    for (const std::int32_t v : vertices) places.push_back(soup.vertices[v]);
    return places;
}

Vec3 Rim::centre(const Soup& soup) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : vertices) sum += soup.vertices[v] / vertices.size();
    return sum;
}

OpenRims::OpenRims(const Soup& soup) : soup_(soup), passes_(soup.vertices.size(), 0) {
    std::vector<Triangle> proper;
    std::vector<std::int32_t> number;  // in the soup
    for (std::int32_t f = 0; f < count_of(soup.facets); ++f) {
        if (has_repeated_vertex(soup.facets[f])) continue;
        proper.push_back(soup.facets[f]);
        number.push_back(f);
    }
    const std::vector<std::int32_t> partners = edge_partners(proper);
    if (std::find(partners.begin(), partners.end(), -1) == partners.end()) return;
    const ConsistentFacets consistent = make_consistent(proper);
    std::vector<char> is_one_sided(consistent.shell_count, 0);
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
        for (std::int32_t f = 0; f < count_of(soup_.facets); ++f)
            if (!has_repeated_vertex(soup_.facets[f]))
                for (const std::int32_t v : soup_.facets[f])
                    if (passes_[v] > 0) visit(v, f);
    };
    for_each([&](std::int32_t v, std::int32_t) { ++first_[v + 1]; });
    for (std::size_t v = 0; v < passes_.size(); ++v) first_[v + 1] += first_[v];
    facets_.resize(first_.back());
    std::vector<std::int32_t> end(first_.begin(), first_.end() - 1);
    for_each([&](std::int32_t v, std::int32_t f) { facets_[end[v]++] = f; });
}

std::span<const std::int32_t> OpenRims::facets_at(std::int32_t vertex) const {
    if (first_.empty()) return {};
    return {facets_.data() + first_[vertex], facets_.data() + first_[vertex + 1]};
}

std::int32_t RimOpening::edges() const {
    std::int32_t sum = 0;
    for (const Rim* rim : rims) sum += count_of(rim->vertices);
    return sum;
}

double RimOpening::length() const {
    double sum = 0;
    for (const Rim* rim : rims) sum += rim->length;
    return sum;
}

RimOpening make_opening(const OpenRims& all, std::vector<const Rim*> rims) {
    RimOpening opening;
    const RimOutline outline(all.soup(), rims);
    opening.triangles = rims.size() == 1 ? triangulate_rim(outline.points, outline.apexes)
                                         : triangulate_band(rims[0]->points(all.soup()), rims[1]->points(all.soup()));
    opening.rims = std::move(rims);
    opening.bend = mean_bend(outline, opening.triangles);
    const bool goes_on = opening.bend > BendDegrees::straight && opening.bend < BendDegrees::lid;
    opening.is_flat = !goes_on && is_planar(rim_plane(outline.points), outline.points);
    return opening;
}

ShapedPatch make_patch(const OpenRims& all, const RimOpening& opening, PatchShape shape, double growth) {
    RimOutline outline(all.soup(), opening.rims);
    const PatchSurroundings around = shape == PatchShape::smooth ? surroundings(all, outline) : PatchSurroundings();
    std::vector<UndirectedEdge> taken = taken_edges(all, outline);
    PatchMesh mesh(std::move(outline.points), opening.triangles, outline.counts, std::move(taken));
    bool is_usable = !opening.triangles.empty() && mesh.is_within_rims();
    if (is_usable && shape != PatchShape::plain) mesh.refine(growth);
    if (is_usable && shape == PatchShape::smooth) is_usable = fair_patch(mesh, around);
    is_usable = is_usable && mesh.spans_rims();
    return {std::move(mesh), is_usable};
}

}  // namespace kerf
