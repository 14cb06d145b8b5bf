// Checks in the order of DefectKind, each on what the ones before it let pass: edges need facets without repeated
// vertices, fans at a vertex need facets of one orientation, intersections need a closed manifold. Everything is found
// by sorting and by exact predicates.
#include "surface/diagnosis.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "surface/intersections.h"
#include "surface/orientation.h"
#include "surface/surface.h"

namespace kerf {

namespace {

using Defects = std::vector<Defect>;

bool has_repeated_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

Defect facet_defect(DefectKind kind, const Soup& soup, std::vector<std::int32_t> facets) {
    const Triangle& t = soup.facets[facets.front()];
    return {kind, std::move(facets), {t.begin(), t.end()}, soup.vertices[t[0]]};
}

void find_non_finite(const Soup& soup, Defects& defects) {
    std::vector<std::int32_t> defect_of_vertex(soup.vertices.size(), -1);
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
        if (soup.vertices[v].allFinite()) continue;
        defect_of_vertex[v] = static_cast<std::int32_t>(defects.size());
        defects.push_back({DefectKind::non_finite, {}, {static_cast<std::int32_t>(v)}});
    }
    if (defects.empty()) return;
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (std::int32_t v : soup.facets[f]) {
            if (defect_of_vertex[v] < 0) continue;
            Defect& defect = defects[defect_of_vertex[v]];
            defect.facets.push_back(static_cast<std::int32_t>(f));
            for (std::int32_t other : soup.facets[f])  // a neighbour is the nearest place that can be shown
                if (soup.vertices[other].allFinite()) defect.where = soup.vertices[other];
        }
}

// All vertices lie in the plane of the first three that span one.
void find_flat(const Soup& soup, Defects& defects) {
    const std::vector<Vec3>& p = soup.vertices;
    const auto last = p.end();
    const auto a = p.begin();
    const auto b = std::find_if(a, last, [&](const Vec3& x) { return x != *a; });
    const auto c = b == last ? last : std::find_if(b, last, [&](const Vec3& x) { return !collinear(*a, *b, x); });
    const bool has_volume =
        c != last && std::any_of(c, last, [&](const Vec3& x) { return orientation_sign(*a, *b, *c, x) != 0; });
    if (!has_volume) defects.push_back(facet_defect(DefectKind::flat, soup, {0}));
}

void find_degenerate(const Soup& soup, Defects& defects) {
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        if (has_repeated_vertex(t) || collinear(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]))
            defects.push_back(facet_defect(DefectKind::degenerate_facet, soup, {static_cast<std::int32_t>(f)}));
    }
}

void find_duplicates(const Soup& soup, Defects& defects) {
    std::vector<std::pair<Triangle, std::int32_t>> sorted;
    sorted.reserve(soup.facets.size());
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        sorted.emplace_back(soup.facets[f], static_cast<std::int32_t>(f));
        std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0, j = 0; i < sorted.size(); i = j) {
        std::vector<std::int32_t> equal;
        for (; j < sorted.size() && sorted[j].first == sorted[i].first; ++j) equal.push_back(sorted[j].second);
        if (equal.size() > 1) defects.push_back(facet_defect(DefectKind::duplicate_facet, soup, std::move(equal)));
    }
}

DefectKind to_defect_kind(ManifoldDefect::Kind kind) {
    if (kind == ManifoldDefect::Kind::open_edge) return DefectKind::open_edge;
    return kind == ManifoldDefect::Kind::non_manifold_edge ? DefectKind::non_manifold_edge
                                                           : DefectKind::non_manifold_vertex;
}

void find_non_manifold(const Soup& soup, Defects& defects) {
    std::vector<std::int32_t> number;  // in the soup, of the facets without repeated vertices
    std::vector<Triangle> facets;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (has_repeated_vertex(soup.facets[f])) continue;
        number.push_back(static_cast<std::int32_t>(f));
        facets.push_back(soup.facets[f]);
    }
    for (ManifoldDefect& found : find_manifold_defects(soup.vertices.size(), make_consistent(facets).facets)) {
        if (found.kind == ManifoldDefect::Kind::edge_orientation) continue;
        for (std::int32_t& f : found.facets) f = number[f];
        const Vec3 where = (soup.vertices[found.vertices.front()] + soup.vertices[found.vertices.back()]) / 2;
        defects.push_back({to_defect_kind(found.kind), std::move(found.facets), std::move(found.vertices), where});
    }
}

// The middle of what the bounding boxes of two facets have in common.
Vec3 common_place(const Soup& soup, const Triangle& s, const Triangle& t) {
    const auto corner = [&](const Triangle& facet, int i) -> const Vec3& { return soup.vertices[facet[i]]; };
    const Vec3 low = corner(s, 0)
                         .cwiseMin(corner(s, 1))
                         .cwiseMin(corner(s, 2))
                         .cwiseMax(corner(t, 0).cwiseMin(corner(t, 1)).cwiseMin(corner(t, 2)));
    const Vec3 high = corner(s, 0)
                          .cwiseMax(corner(s, 1))
                          .cwiseMax(corner(s, 2))
                          .cwiseMin(corner(t, 0).cwiseMax(corner(t, 1)).cwiseMax(corner(t, 2)));
    return (low + high) / 2;
}

void find_intersections(const Soup& soup, Defects& defects) {
    for (const auto& [f, g] : find_self_intersections(soup.vertices, soup.facets)) {
        const Triangle &s = soup.facets[f], &t = soup.facets[g];
        defects.push_back(
            {DefectKind::self_intersection, {f, g}, {s[0], s[1], s[2], t[0], t[1], t[2]}, common_place(soup, s, t)});
    }
}

void sort_defects(Defects& defects) {
    const auto first_facet = [](const Defect& d) { return d.facets.empty() ? -1 : d.facets.front(); };
    std::stable_sort(defects.begin(), defects.end(), [&](const Defect& a, const Defect& b) {
        return std::pair(a.kind, first_facet(a)) < std::pair(b.kind, first_facet(b));
    });
}

std::string counted(std::int64_t n, DefectKind kind) {
    std::string noun = name(kind);
    if (n != 1 && noun.ends_with("vertex")) noun.replace(noun.size() - 2, 2, "ice");
    return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

const char* remedy(DefectKind kind) {
    switch (kind) {
        case DefectKind::empty:
            return "export the surface again";
        case DefectKind::non_finite:
            return "correct the coordinates or export the surface again";
        case DefectKind::flat:
            return "give the boundary of a body, not a sheet";
        case DefectKind::degenerate_facet:
            return "collapse or remove the facets where the surface was made";
        case DefectKind::duplicate_facet:
            return "remove the copies";
        case DefectKind::open_edge:
            return "close the holes, or merge vertices that are nearly equal";
        case DefectKind::non_manifold_edge:
        case DefectKind::non_manifold_vertex:
            return "unite the bodies that touch there, or move them apart";
        case DefectKind::self_intersection:
            return "unite the parts that overlap where the surface was made";
    }
    return "";
}

// "facet 3", "vertices 4 and 7": at most four numbers.
std::string list(const char* one, const char* many, const std::vector<std::int32_t>& numbers) {
    constexpr std::size_t limit = 4;
    if (numbers.size() == 1) return fmt::format("{} {}", one, numbers[0]);
    const auto end = numbers.begin() + static_cast<std::ptrdiff_t>(std::min(limit, numbers.size()));
    return fmt::format("{} {}{}", many, fmt::join(numbers.begin(), end, ", "), numbers.size() > limit ? ", ..." : "");
}

std::string place(const Defect& defect) {
    std::string text;
    if (!defect.facets.empty()) text = list("facet", "facets", defect.facets);
    // The corners of a facet say nothing that its number does not say.
    if (!defect.vertices.empty() && defect.vertices.size() < 3)
        text += (text.empty() ? "" : ", ") + list("vertex", "vertices", defect.vertices);
    return fmt::format("{} near ({:.9g}, {:.9g}, {:.9g})", text, defect.where.x(), defect.where.y(), defect.where.z());
}

}  // namespace

const char* name(DefectKind kind) {
    switch (kind) {
        case DefectKind::empty:
            return "empty surface";
        case DefectKind::non_finite:
            return "non-finite vertex";
        case DefectKind::flat:
            return "flat surface";
        case DefectKind::degenerate_facet:
            return "degenerate facet";
        case DefectKind::duplicate_facet:
            return "duplicate facet";
        case DefectKind::open_edge:
            return "open edge";
        case DefectKind::non_manifold_edge:
            return "non-manifold edge";
        case DefectKind::non_manifold_vertex:
            return "non-manifold vertex";
        case DefectKind::self_intersection:
            return "self-intersection";
    }
    return "";
}

std::int64_t Diagnosis::count(DefectKind kind) const {
    return std::count_if(defects.begin(), defects.end(), [&](const Defect& d) { return d.kind == kind; });
}

std::string Diagnosis::summary() const {
    if (clean()) return "The surface is closed, manifold and free of self-intersections.";
    const Defect& first = defects.front();
    if (first.kind == DefectKind::empty) return fmt::format("The surface has no facets: {}.", remedy(first.kind));
    if (first.kind == DefectKind::flat)
        return fmt::format("All vertices of the surface lie in one plane: {}.", remedy(first.kind));
    return fmt::format("The surface has {}, {}{}: {}.", counted(count(first.kind), first.kind),
                       count(first.kind) > 1 ? "the first at " : "at ", place(first), remedy(first.kind));
}

Diagnosis diagnose(const Soup& soup) {
    Diagnosis diagnosis;
    Defects& defects = diagnosis.defects;
    if (soup.facets.empty()) {
        defects.push_back({DefectKind::empty, {}, {}});
        return diagnosis;
    }
    find_non_finite(soup, defects);
    if (!defects.empty()) return diagnosis;
    find_flat(soup, defects);
    find_degenerate(soup, defects);
    find_duplicates(soup, defects);
    find_non_manifold(soup, defects);
    if (defects.empty()) find_intersections(soup, defects);
    sort_defects(defects);
    return diagnosis;
}

}  // namespace kerf
