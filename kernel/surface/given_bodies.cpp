#include "surface/given_bodies.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/check.h"
#include "geometry/union_find.h"
#include "surface/edge_corners.h"
#include "surface/wall_mismatch.h"

namespace kerf {

namespace {

constexpr double suspicious_gap = 1e-2, certain_gap = 1e-4;  // of the longest edge of the finer facet

// One body by itself, and the numbers of its facets and vertices in the soup of all.
struct OwnSoup {
    Soup soup;
    std::vector<std::int32_t> facet_number, vertex_number;
};

OwnSoup soup_of_body(const Soup& all, const GivenBodies& bodies, std::int32_t body) {
    OwnSoup own;
    own.soup.patch_names = all.patch_names;
    own.soup.unfit_polygons = all.unfit_polygons;
    own.soup.holes = all.holes;
    for (std::size_t f = 0; f < all.facets.size(); ++f) {
        if (bodies.of_facet[f] != body) continue;
        own.facet_number.push_back(static_cast<std::int32_t>(f));
        own.soup.facets.push_back(all.facets[f]);
        own.soup.patch.push_back(all.patch[f]);
        if (!all.polygon.empty()) own.soup.polygon.push_back(all.polygon[f]);
        own.vertex_number.insert(own.vertex_number.end(), all.facets[f].begin(), all.facets[f].end());
    }
    std::vector<std::int32_t>& used = own.vertex_number;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::int32_t v : used) own.soup.vertices.push_back(all.vertices[v]);
    for (Triangle& t : own.soup.facets)
        for (std::int32_t& v : t)
            v = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
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
    const std::size_t count = soup.patch_names.size();
    std::vector<std::vector<Triangle>> facets(count);
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        if (const auto& [a, b, c] = soup.facets[f]; a != b && b != c && c != a)
            facets[soup.patch[f]].push_back(soup.facets[f]);
    if (std::count_if(facets.begin(), facets.end(), [](const auto& own) { return !own.empty(); }) < 2) return {};
    bool is_closed = true;
    for (std::size_t p = 0; p < count && is_closed; ++p)
        EdgeCorners(facets[p]).for_each_edge([&](std::int32_t, auto corners) { is_closed &= corners.size() % 2 == 0; });
    return is_closed ? GivenBodies{soup.patch, soup.patch_names} : GivenBodies{};
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
    for (std::size_t b = 0; b < bodies.names.size(); ++b) {
        const OwnSoup own = soup_of_body(soup, bodies, static_cast<std::int32_t>(b));
        if (own.soup.facets.empty()) continue;
        append_diagnosis(all, diagnose(own.soup, options), own, bodies.names[b], soup.facets.size());
    }
    if (all.clean()) {
        std::vector<Triangle> facets;
        std::vector<std::int32_t> body, number;
        for (std::size_t f = 0; f < soup.facets.size(); ++f) {
            if (!all.dropped.empty() && all.dropped[f] != 0) continue;
            facets.push_back(soup.facets[f]);
            body.push_back(bodies.of_facet[f]);
            number.push_back(static_cast<std::int32_t>(f));
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
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        const FacetSides sides = soup.sides.empty() ? FacetSides{-1, bodies.of_facet[f]} : soup.sides[f];
        if (sides.is_wall() || (!diagnosis.dropped.empty() && facet_number.empty() && diagnosis.dropped[f] != 0))
            continue;
        facets.push_back(sides.front < 0 ? t : Triangle{t[0], t[2], t[1]});
        body.push_back(std::max(sides.front, sides.back));
        number.push_back(facet_number.empty() ? static_cast<std::int32_t>(f) : facet_number[f]);
    }
    const std::vector<std::string>& names = soup.sides.empty() ? bodies.names : soup.region_names;
    for (const WallMismatch& gap : find_gaps(soup.vertices, facets, body, suspicious_gap))
        add_mismatch(diagnosis, gap, gap.least_share <= certain_gap ? Severity::error : Severity::warning, names,
                     number);
    sort_defects(diagnosis.defects);
}

}  // namespace kerf
