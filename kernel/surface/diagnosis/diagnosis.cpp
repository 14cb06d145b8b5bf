// The checks follow each other in the order of DefectKind. Facets that repairs leave out are ignored by all later
// checks, so that these list the defects that are there after the repairs. Everything is found by sorting and by exact
// predicates, so that the list depends neither on threads nor on rounding. `unbounded_` marks vertices whose
// coordinates no predicate can work with, `ignored_` facets left out, `no_area_` facets that the searches for
// intersections and poor shapes skip.
#include "surface/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/angles.h"
#include "base/geometry/box.h"
#include "base/geometry/predicates.h"
#include "surface/complex/manifold_defects.h"
#include "surface/diagnosis/inside/poor_shapes.h"
#include "surface/diagnosis/intersections.h"
#include "surface/diagnosis/open_loops.h"
#include "surface/diagnosis/superfluous_facets.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double largest_magnitude = 1e50;  // TetGen's predicates multiply five lengths
constexpr double least_extent = 1e-50;
constexpr std::size_t intersection_limit = 10'000;
constexpr std::size_t warning_limit = 1000;
constexpr std::size_t facets_at_once = std::size_t{1} << 15;

class Examination {
 public:
    Examination(const Soup& soup, const DiagnosisOptions& options) : soup_(soup), options_(options) {}
    Diagnosis run();

 private:
    void find_non_finite();
    void find_absurd();
    void find_unfit();
    void find_flat();
    void find_superfluous();
    void find_degenerate();
    void select_facets();
    void find_non_manifold(const std::vector<Triangle>& consistent, std::vector<std::int32_t> partner);
    void find_turned(const FacetShells& shells);
    void find_shells();
    void find_intersections();
    void find_misplaced_shells(const std::vector<ShellPlace>& shells);
    void find_poor_shapes();

    void add(Defect defect) {
        ++result_.counts[static_cast<std::size_t>(defect.kind)];
        result_.defects.push_back(std::move(defect));
    }
    void add_at_facet(DefectKind kind, Severity severity, std::vector<std::int32_t> facets) {
        const Triangle& t = soup_.facets[facets.front()];
        add({kind, severity, std::move(facets), {t.begin(), t.end()}, soup_.vertices[t[0]]});
    }
    template <class ToDefect>
    void add_worst(DefectKind kind, std::vector<PoorShape>&& found, const ToDefect& to_defect);
    void drop(std::int32_t facet) {
        result_.dropped.resize(soup_.facets.size(), 0);
        result_.dropped[facet] = ignored_[facet] = 1;
    }
    // The facets that are left, and their numbers in the soup.
    const std::vector<Triangle>& facets() const { return all_are_left_ ? soup_.facets : facets_; }
    std::int32_t number(std::int32_t facet) const { return all_are_left_ ? facet : number_[facet]; }
    void number_as_in_soup(std::vector<std::int32_t>& facets) const {
        for (std::int32_t& f : facets) f = number(f);
    }

    const Soup& soup_;
    const DiagnosisOptions& options_;
    Diagnosis result_;
    std::vector<char> unbounded_;  // #V; coordinates that no predicate can work with
    std::vector<char> ignored_;    // #F; left out of the checks to come
    std::vector<char> no_area_;    // #F
    bool all_are_left_ = true;     // no facet is ignored; else those that are left:
    std::vector<Triangle> facets_;
    std::vector<std::int32_t> number_;   // in the soup
    std::vector<std::int32_t> partner_;  // of facets(), until their shells are known
};

void Examination::find_non_finite() {
    std::vector<std::int32_t> defect_of_vertex(soup_.vertices.size(), -1);
    for (std::int32_t v = 0; v < count_of(soup_.vertices); ++v) {
        if (soup_.vertices[v].allFinite()) continue;
        unbounded_[v] = 1;
        defect_of_vertex[v] = count_of(result_.defects);
        add({DefectKind::non_finite, Severity::error, {}, {v}});
    }
    if (result_.clean()) return;
    for (std::int32_t f = 0; f < count_of(soup_.facets); ++f)
        for (std::int32_t v : soup_.facets[f]) {
            if (defect_of_vertex[v] < 0) continue;
            Defect& defect = result_.defects[defect_of_vertex[v]];
            defect.facets.push_back(f);
            for (std::int32_t other : soup_.facets[f])  // a neighbour is the nearest place that can be shown
                if (soup_.vertices[other].allFinite()) defect.where = soup_.vertices[other];
        }
}

void Examination::find_absurd() {
    Defect defect{DefectKind::absurd_magnitude, Severity::error, {}, {}};
    Eigen::AlignedBox3d box;
    for (std::int32_t v = 0; v < count_of(soup_.vertices); ++v) {
        if (unbounded_[v]) continue;
        box.extend(soup_.vertices[v]);
        if (soup_.vertices[v].cwiseAbs().maxCoeff() <= largest_magnitude) continue;
        unbounded_[v] = 1;
        defect.vertices.push_back(v);
    }
    const bool tiny = !box.isEmpty() && box.sizes().maxCoeff() < least_extent && box.sizes().maxCoeff() > 0;
    if (tiny) defect.vertices = {0};
    if (defect.vertices.empty()) return;
    defect.where = soup_.vertices[defect.vertices.front()];
    add(std::move(defect));
}

void Examination::find_unfit() {
    for (const std::int32_t polygon : soup_.unfit_polygons) {
        const auto [begin, end] = std::equal_range(soup_.polygon.begin(), soup_.polygon.end(), polygon);
        std::vector<std::int32_t> facets;
        for (auto it = begin; it != end; ++it) facets.push_back(it - soup_.polygon.begin());
        if (!facets.empty()) add_at_facet(DefectKind::unfit_polygon, Severity::error, std::move(facets));
    }
}

// All vertices lie in the plane of the first three that span one.
void Examination::find_flat() {
    const std::vector<Vec3>& p = soup_.vertices;
    const auto last = p.end();
    const auto a = p.begin();
    const auto b = std::find_if(a, last, [&](const Vec3& x) { return x != *a; });
    const auto c = b == last ? last : std::find_if(b, last, [&](const Vec3& x) { return !are_collinear(*a, *b, x); });
    const bool has_volume =
        c != last && std::any_of(c, last, [&](const Vec3& x) { return orientation(*a, *b, *c, x) != 0; });
    if (!has_volume) add_at_facet(DefectKind::flat, Severity::error, {0});
}

void Examination::find_superfluous() {
    partner_ = edge_partners(soup_.facets);
    const SuperfluousFacets found = find_superfluous_facets(soup_.facets, partner_);
    for (const std::int32_t f : found.repeated_vertex) {
        add_at_facet(DefectKind::degenerate_facet, Severity::repaired, {f});
        drop(f);
    }
    for (const FacetCopies& copies : found.copies) {
        const auto first = copies.facets.begin() + std::max(copies.keep, 0);
        if (copies.shell >= 0) {  // one copy stands for all in the checks to come
            std::for_each(copies.facets.begin() + 1, copies.facets.end(), [&](std::int32_t f) { ignored_[f] = 1; });
        } else if (copies.keep < 0) {
            add_at_facet(DefectKind::duplicate_facet, Severity::error, copies.facets);
        } else {
            add_at_facet(DefectKind::duplicate_facet, Severity::repaired, copies.facets);
            std::for_each(first, copies.facets.end(), [&](std::int32_t f) { drop(f); });
        }
    }
    for (const std::vector<std::int32_t>& shell : found.coincident_shells)
        add({DefectKind::coincident_shell, Severity::error, shell, {}, soup_.vertices[soup_.facets[shell[0]][0]]});
}

void Examination::find_degenerate() {
    const auto ranges = values_of_ranges(soup_.facets.size(), facets_at_once, [&](const IndexRange& range) {
        std::vector<std::int32_t> flat;
        for (std::size_t f = range.first; f < range.last; ++f) {
            const auto& [a, b, c] = soup_.facets[f];
            if (unbounded_[a] || unbounded_[b] || unbounded_[c]) {
                no_area_[f] = 1;
            } else if (!ignored_[f] && are_collinear(soup_.vertices[a], soup_.vertices[b], soup_.vertices[c])) {
                no_area_[f] = 1;
                flat.push_back(f);
            }
        }
        return flat;
    });
    for (const std::vector<std::int32_t>& flat : ranges)
        for (const std::int32_t f : flat) add_at_facet(DefectKind::degenerate_facet, Severity::error, {f});
}

void Examination::select_facets() {
    all_are_left_ = std::find(ignored_.begin(), ignored_.end(), char{1}) == ignored_.end();
    if (!all_are_left_ || !soup_.sides.empty()) partner_ = {};
    if (all_are_left_) return;
    for (std::int32_t f = 0; f < count_of(soup_.facets); ++f) {
        if (ignored_[f]) continue;
        facets_.push_back(soup_.facets[f]);
        number_.push_back(f);
    }
    if (soup_.sides.empty()) partner_ = edge_partners(facets_);
}

void Examination::find_non_manifold(const std::vector<Triangle>& consistent, std::vector<std::int32_t> partner) {
    using Kind = ManifoldDefect::Kind;
    bool open = false;
    for (ManifoldDefect& found : find_manifold_defects(soup_.vertices.size(), consistent, std::move(partner))) {
        open |= found.kind == Kind::open_edge;
        if (found.kind == Kind::edge_orientation || found.kind == Kind::open_edge) continue;
        const bool at_edge = found.kind == Kind::non_manifold_edge;
        number_as_in_soup(found.facets);
        const Vec3 where = (soup_.vertices[found.vertices.front()] + soup_.vertices[found.vertices.back()]) / 2;
        add({at_edge ? DefectKind::non_manifold_edge : DefectKind::non_manifold_vertex, Severity::error,
             std::move(found.facets), std::move(found.vertices), where});
    }
    if (!open) return;
    for (OpenLoop& loop : find_open_loops(soup_.vertices, consistent)) {
        number_as_in_soup(loop.facets);
        const Vec3 where = soup_.vertices[loop.vertices.front()];
        add({DefectKind::open_edge, Severity::error, std::move(loop.facets), std::move(loop.vertices), where,
             loop.length});
    }
}

void Examination::find_turned(const FacetShells& shells) {
    for (const std::int32_t f : shells.contradictions)
        add_at_facet(DefectKind::one_sided, Severity::error, {number(f)});
    if (!shells.contradictions.empty() || shells.turned.empty()) return;
    std::vector<std::int32_t> turned = shells.turned;
    number_as_in_soup(turned);
    const Vec3 where = soup_.vertices[facets()[shells.turned.front()][0]];
    add({DefectKind::inconsistent_orientation, Severity::repaired, std::move(turned), {}, where});
}

void Examination::find_misplaced_shells(const std::vector<ShellPlace>& shells) {
    for (const ShellPlace& shell : shells) {
        const std::vector<std::int32_t> facet = {number(shell.first_facet)};
        if (shell.touches >= 0)
            add_at_facet(DefectKind::touching_shells, Severity::error, facet);
        else if (shell.parent < 0 && !shell.outward)
            add_at_facet(DefectKind::inverted_shell, Severity::repaired, facet);
        else if (shell.ambiguous(shells))
            add_at_facet(DefectKind::ambiguous_shell,
                         options_.voids == Voids::parity ? Severity::repaired : Severity::error, facet);
    }
}

// The middle of the intersection of the bounding boxes of two facets.
Vec3 common_place(const Soup& soup, const Triangle& s, const Triangle& t) {
    return box_around(soup.vertices, s).intersection(box_around(soup.vertices, t)).center();
}

// The facets around each shell are asked first: where they prove that all is apart, most pairs need not be looked at.
bool are_apart(const std::vector<Vec3>& vertices, const std::vector<Triangle>& consistent,
               const std::vector<std::int32_t>& shell_of_facet, const std::vector<ShellPlace>& shells) {
    std::vector<std::int32_t> parent;
    for (const ShellPlace& shell : shells) {
        if (shell.touches >= 0) return false;
        parent.push_back(shell.parent);
    }
    return nested_shells_are_apart(vertices, consistent, shell_of_facet, parent);
}

// Finds the shells that bound one body, and their places.
void Examination::find_shells() {
    const FacetShells shells = find_facet_shells(facets(), partner_);
    std::vector<Triangle> turned;  // a copy only where facets differ
    if (!shells.turned.empty()) {
        turned = facets();
        turn_facets(turned, shells.turned);
        partner_ = edge_partners(turned);  // corners have changed places
    }
    const std::vector<Triangle>& consistent = shells.turned.empty() ? facets() : turned;
    find_non_manifold(consistent, std::exchange(partner_, {}));
    find_turned(shells);
    if (!result_.clean()) return find_intersections();
    const std::vector<ShellPlace> places = locate_shells(soup_.vertices, consistent, shells, soup_.holes);
    if (!are_apart(soup_.vertices, consistent, shells.shell, places)) find_intersections();
    if (!result_.clean()) return;
    find_misplaced_shells(places);
    if (result_.clean() && all_are_left_) result_.orientation = find_orientation(shells, places);
}

void Examination::find_intersections() {
    std::vector<Triangle> solid;
    std::vector<std::int32_t> number_of_solid;
    const bool all_are_solid = std::find(no_area_.begin(), no_area_.end(), char{1}) == no_area_.end();
    for (std::int32_t i = 0; !all_are_solid && i < count_of(facets()); ++i) {
        if (no_area_[number(i)]) continue;
        solid.push_back(facets()[i]);
        number_of_solid.push_back(number(i));
    }
    const std::vector<Triangle>& searched = all_are_solid ? facets() : solid;
    for (const auto& [f, g] : find_self_intersections(soup_.vertices, searched, intersection_limit)) {
        const Triangle &s = searched[f], &t = searched[g];
        add({DefectKind::self_intersection,
             Severity::error,
             all_are_solid ? std::vector{number(f), number(g)} : std::vector{number_of_solid[f], number_of_solid[g]},
             {s[0], s[1], s[2], t[0], t[1], t[2]},
             common_place(soup_, s, t)});
    }
}

template <class ToDefect>
void Examination::add_worst(DefectKind kind, std::vector<PoorShape>&& found, const ToDefect& to_defect) {
    result_.counts[static_cast<std::size_t>(kind)] = std::ssize(found);
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.measure < b.measure; });
    if (found.size() > warning_limit) found.resize(warning_limit);
    for (const PoorShape& shape : found) {
        Defect defect{kind, Severity::warning, {number(shape.facet)}, to_defect(facets()[shape.facet], shape)};
        defect.where = soup_.vertices[defect.vertices.front()];
        defect.measure = shape.measure;
        result_.defects.push_back(std::move(defect));
    }
}

void Examination::find_poor_shapes() {
    const PoorShapeSearch search(soup_.vertices, facets(), options_.needle_angle_deg);
    const auto ranges = values_of_ranges(facets().size(), facets_at_once, [&](const IndexRange& range) {
        PoorShapes found;
        for (std::int32_t i = range.first, last = range.last; i < last; ++i)
            if (!no_area_[number(i)]) search.look_at(i, found);
        return found;
    });
    PoorShapes all;
    for (const PoorShapes& found : ranges) {
        all.needles.insert(all.needles.end(), found.needles.begin(), found.needles.end());
        all.short_edges.insert(all.short_edges.end(), found.short_edges.begin(), found.short_edges.end());
    }
    add_worst(DefectKind::needle, std::move(all.needles),
              [](const Triangle& t, const PoorShape&) { return std::vector(t.begin(), t.end()); });
    add_worst(DefectKind::short_edge, std::move(all.short_edges), [](const Triangle& t, const PoorShape& shape) {
        return std::vector{t[shape.edge], t[(shape.edge + 1) % 3]};
    });
}

Diagnosis Examination::run() {
    if (soup_.facets.empty()) {
        add({DefectKind::empty, Severity::error, {}, {}});
        return std::move(result_);
    }
    unbounded_.assign(soup_.vertices.size(), 0);
    ignored_.assign(soup_.facets.size(), 0);
    no_area_.assign(soup_.facets.size(), 0);
    find_non_finite();
    find_absurd();
    find_unfit();
    if (std::none_of(unbounded_.begin(), unbounded_.end(), [](char u) { return u; })) find_flat();
    find_superfluous();
    find_degenerate();
    select_facets();
    if (soup_.sides.empty())
        find_shells();
    else
        find_intersections();
    find_poor_shapes();
    sort_defects(result_.defects);
    return std::move(result_);
}

bool is_error(const Defect& defect) { return defect.severity == Severity::error; }

}  // namespace

bool Diagnosis::clean() const { return std::none_of(defects.begin(), defects.end(), is_error); }

std::string Diagnosis::summary(const Soup& soup) const {
    const auto first = std::find_if(defects.begin(), defects.end(), is_error);
    if (first == defects.end()) return "The surface is closed, manifold and free of self-intersections.";
    if (first->kind == DefectKind::empty) return fmt::format("The surface has no facets: {}.", advice(*first));
    if (first->kind == DefectKind::flat)
        return fmt::format("All vertices of the surface lie in one plane: {}.", advice(*first));
    const auto errors = std::count_if(defects.begin(), defects.end(),
                                      [&](const Defect& d) { return is_error(d) && d.kind == first->kind; });
    return fmt::format("The surface has {}, {}{}: {}.", counted(errors, first->kind),
                       errors > 1 ? "the first at " : "at ", place(*first, soup), advice(*first));
}

std::vector<ErrorElements> Diagnosis::elements(const Soup& soup) const {
    std::vector<ErrorElements> elements;
    const auto first = std::find_if(defects.begin(), defects.end(), is_error);
    for (auto defect = first; defect != defects.end(); ++defect)
        if (is_error(*defect) && defect->kind == first->kind)
            for (ErrorElements& each : elements_of(*defect, soup)) elements.push_back(std::move(each));
    return elements;
}

Diagnosis diagnose(const Soup& soup, const DiagnosisOptions& options) {
    KERF_CHECK(are_in_range(soup.facets, soup.vertices.size()));
    KERF_CHECK(soup.polygon.empty() || soup.polygon.size() == soup.facets.size());
    KERF_CHECK(std::is_sorted(soup.polygon.begin(), soup.polygon.end()));
    return Examination(soup, options).run();
}

}  // namespace kerf
