// Bodies that are not regions yet are diagnosed one at a time: each gets a soup of its own, with its patches and unfit
// polygons, and the numbers in its defects are translated back into those of the whole soup. Only if all of them can be
// meshed are they compared with each other (wall_mismatch.h), without the facets that repairs leave out. The limits of
// gaps are shares of the longest edge of the finer facet: `certain_gap` is as much as rounding leaves of a common wall.
#include "surface/diagnosis/given_bodies.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/ids.h"
#include "base/geometry/union_find.h"
#include "surface/diagnosis/inside/wall_mismatch.h"

namespace kerf {

namespace {

constexpr double suspicious_gap = 1e-2, certain_gap = 1e-4;  // of the longest edge of the finer facet

// One body by itself, and the numbers of its facets and vertices in the soup of all.
struct OwnSoup {
    Soup soup;
    std::vector<std::int32_t> facet_number, vertex_number;
};

std::vector<std::vector<std::int32_t>> facets_of_bodies(const GivenBodies& bodies) {
    std::vector<std::vector<std::int32_t>> facets(bodies.names.size());
    for (std::int32_t f = 0; f < count_of(bodies.of_facet); ++f) facets[bodies.of_facet[f]].push_back(f);
    return facets;
}

// Gives the soup of a body the patches of its own, by ascending numbers: there may be as many bodies as patches.
void copy_own_patches(const Soup& all, Soup& own) {
    std::vector<std::int32_t> used = own.patch;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::int32_t patch : used) own.patch_names.push_back(all.patch_names[patch]);
    for (std::int32_t& patch : own.patch) patch = std::lower_bound(used.begin(), used.end(), patch) - used.begin();
}

void copy_own_unfit_polygons(const Soup& all, Soup& own) {
    if (all.unfit_polygons.empty()) return;
    for (const std::int32_t polygon : own.polygon)
        if (std::binary_search(all.unfit_polygons.begin(), all.unfit_polygons.end(), polygon))
            own.unfit_polygons.push_back(polygon);
    std::sort(own.unfit_polygons.begin(), own.unfit_polygons.end());
    own.unfit_polygons.erase(std::unique(own.unfit_polygons.begin(), own.unfit_polygons.end()),
                             own.unfit_polygons.end());
}

OwnSoup soup_of_body(const Soup& all, std::vector<std::int32_t> facets) {
    OwnSoup own{{}, std::move(facets), {}};
    own.soup.holes = all.holes;
    for (const std::int32_t f : own.facet_number) {
        own.soup.facets.push_back(all.facets[f]);
        own.soup.patch.push_back(all.patch[f]);
        if (!all.polygon.empty()) own.soup.polygon.push_back(all.polygon[f]);
        own.vertex_number.insert(own.vertex_number.end(), all.facets[f].begin(), all.facets[f].end());
    }
    copy_own_patches(all, own.soup);
    copy_own_unfit_polygons(all, own.soup);
    std::vector<std::int32_t>& used = own.vertex_number;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::int32_t v : used) own.soup.vertices.push_back(all.vertices[v]);
    for (Triangle& t : own.soup.facets)
        for (std::int32_t& v : t) v = std::lower_bound(used.begin(), used.end(), v) - used.begin();
    return own;
}

void renumber(std::vector<std::int32_t>& numbers, const std::vector<std::int32_t>& in_all) {
    for (std::int32_t& number : numbers) number = in_all[number];
}

void append_diagnosis(Diagnosis& all, Diagnosis own, const OwnSoup& body, const std::string& name,
                      std::size_t facet_count) {
    for (Defect& defect : own.defects) {
        renumber(defect.facets, body.facet_number);
        renumber(defect.vertices, body.vertex_number);
        defect.bodies = {name};
        all.defects.push_back(std::move(defect));
    }
    for (std::size_t k = 0; k < defect_kind_count; ++k) all.counts[k] += own.counts[k];
    if (own.dropped.empty()) return;
    all.dropped.resize(facet_count, 0);
    for (std::size_t f = 0; f < own.dropped.size(); ++f) all.dropped[body.facet_number[f]] = own.dropped[f];
}

DefectKind kind_of(const WallMismatch& mismatch) {
    switch (mismatch.kind) {
        case WallMismatch::Kind::gap:
            return DefectKind::body_gap;
        case WallMismatch::Kind::overlap:
            return DefectKind::body_overlap;
        case WallMismatch::Kind::unlike:
            return DefectKind::unlike_walls;
    }
    return DefectKind::body_overlap;
}

void add_mismatch(Diagnosis& diagnosis, const WallMismatch& mismatch, Severity severity,
                  const std::vector<std::string>& names, const std::vector<std::int32_t>& facet_number) {
    Defect defect{kind_of(mismatch), severity, mismatch.facets, {}, mismatch.where, std::max(mismatch.distance, 0.0)};
    if (!facet_number.empty()) renumber(defect.facets, facet_number);
    for (const std::int32_t body : mismatch.bodies) defect.bodies.push_back(names[body]);
    ++diagnosis.counts[static_cast<std::size_t>(defect.kind)];
    diagnosis.defects.push_back(std::move(defect));
}

}  // namespace

GivenBodies closed_patches(const Soup& soup) {
    std::vector<std::pair<std::int32_t, UndirectedEdge>> edges;  // with their patches, once for each facet
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto& [a, b, c] = soup.facets[f];
        if (a == b || b == c || c == a) continue;
        for (const UndirectedEdge& edge : {undirected(a, b), undirected(b, c), undirected(c, a)})
            edges.emplace_back(soup.patch[f], edge);
    }
    std::sort(edges.begin(), edges.end());
    if (edges.empty() || edges.front().first == edges.back().first) return {};
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto next = std::find_if(edge, edges.end(), [&](const auto& other) { return other != *edge; });
        if ((next - edge) % 2 != 0) return {};
        edge = next;
    }
    return {soup.patch, soup.patch_names};
}

GivenBodies separate_patches(const Soup& soup) {
    UnionFind groups(soup.patch_names.size());
    std::vector<std::int32_t> patch_of_vertex(soup.vertices.size(), -1);
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (const std::int32_t v : soup.facets[f]) {
            std::int32_t& patch = patch_of_vertex[v];
            if (patch >= 0) groups.join(patch, soup.patch[f]);
            patch = soup.patch[f];
        }
    GivenBodies bodies{{}, soup.patch_names};
    for (const std::int32_t patch : soup.patch) bodies.of_facet.push_back(groups.root(patch));
    return bodies;
}

Diagnosis diagnose_bodies(const Soup& soup, const GivenBodies& bodies, const DiagnosisOptions& options) {
    KERF_CHECK(bodies.of_facet.size() == soup.facets.size());
    Diagnosis all;
    std::vector<std::vector<std::int32_t>> facets_of = facets_of_bodies(bodies);
    for (std::size_t b = 0; b < bodies.names.size(); ++b) {
        if (facets_of[b].empty()) continue;
        const OwnSoup own = soup_of_body(soup, std::move(facets_of[b]));
        append_diagnosis(all, diagnose(own.soup, options), own, bodies.names[b], soup.facets.size());
    }
    if (all.clean()) {
        std::vector<Triangle> facets;
        std::vector<std::int32_t> body, number;
        for (std::int32_t f = 0; f < count_of(soup.facets); ++f) {
            if (!all.dropped.empty() && all.dropped[f] != 0) continue;
            facets.push_back(soup.facets[f]);
            body.push_back(bodies.of_facet[f]);
            number.push_back(f);
        }
        for (const WallMismatch& mismatch : find_overlaps(soup.vertices, facets, body))
            add_mismatch(all, mismatch, Severity::error, bodies.names, number);
    }
    sort_defects(all.defects);
    return all;
}

void add_gaps(Diagnosis& diagnosis, const Soup& soup, const GivenBodies& bodies,
              const std::vector<std::int32_t>& facet_number) {
    std::vector<Triangle> facets;
    std::vector<std::int32_t> body, number;
    for (std::int32_t f = 0; f < count_of(soup.facets); ++f) {
        const Triangle& t = soup.facets[f];
        const FacetSides sides =
            soup.sides.empty() ? FacetSides{.back = RegionIndex(bodies.of_facet[f])} : soup.sides[f];
        if (sides.is_wall() || (!diagnosis.dropped.empty() && facet_number.empty() && diagnosis.dropped[f] != 0))
            continue;
        facets.push_back(sides.front.is_valid() ? Triangle{t[0], t[2], t[1]} : t);
        body.push_back(std::max(sides.front, sides.back).value());
        number.push_back(facet_number.empty() ? f : facet_number[f]);
    }
    const std::vector<std::string>& names = soup.sides.empty() ? bodies.names : soup.region_names;
    for (const WallMismatch& gap : find_gaps(soup.vertices, facets, body, suspicious_gap))
        add_mismatch(diagnosis, gap, gap.least_share <= certain_gap ? Severity::error : Severity::warning, names,
                     number);
    sort_defects(diagnosis.defects);
}

}  // namespace kerf
