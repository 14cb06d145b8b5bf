// A collapse or a move has two halves: may_...() collects the facets that it would change, with their new corners (a
// star, one for each sheet), and asks the rules; commit_...() changes the mesh. On a seam all sheets are asked before
// any is changed, so a refusal leaves no trace. The rules go from cheap to dear: flags, topology, angles, and only then
// the proof that the new facets are near the input (InputBound). Facets stand for vertices of the input that have left
// the mesh. Before a change, the points of all facets that change or vanish are collected in `points_`; afterwards each
// is given to the closest new facet, so that no point is lost. A collapse may not join vertices that an edge in another
// sheet joins already: OpenMesh's own test sees one sheet alone.
#include "surface/remesh/inside/bounded_surface.h"

#include <algorithm>

#include "base/core/ids.h"
#include "surface/remesh/remesh.h"

namespace kerf {

namespace {

constexpr double good_move_sine = 0.57;  // of 35 degrees: triangles may get worse down to this

double sine_of(const SheetMesh::Corners& t) { return smallest_sine(t[0], t[1], t[2]); }

}  // namespace

bool BoundedSurface::stays(Vertex v) const {
    const SheetVertex& data = mesh_.data(v);
    return data.is_fixed || data.is_end || data.is_border;
}

// Whether the end of the half-edge has an edge already, in some sheet, to a vertex that would get another one. Two
// vertices of the border may have one outside the piece.
bool BoundedSurface::joins_what_is_apart(HalfEdge h) const {
    const Vertex v = mesh_.from_vertex_handle(h), w = mesh_.to_vertex_handle(h);
    const HalfEdge back = mesh_.opposite_halfedge_handle(h);
    const auto is_beside = [&](Vertex x) {
        return (!mesh_.is_boundary(h) && x == mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h))) ||
               (!mesh_.is_boundary(back) && x == mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back)));
    };
    const auto has_another = [&](Vertex x) {
        if (x == w || is_beside(x)) return false;
        if (mesh_.data(w).is_border && mesh_.data(x).is_border) return true;
        return (mesh_.has_copies(w) || mesh_.has_copies(x)) && mesh_.are_joined(x, w);
    };
    return std::any_of(mesh_.cvv_begin(v), mesh_.cvv_end(v), has_another);
}

bool BoundedSurface::is_of_tetrahedron(HalfEdge h) const {
    const auto is_corner = [&](Vertex v) { return mesh_.valence(v) == 3 && !mesh_.is_boundary(v); };
    return is_corner(mesh_.from_vertex_handle(h)) && is_corner(mesh_.to_vertex_handle(h));
}

bool BoundedSurface::collapse(HalfEdge h, const CollapseRules& rules) {
    const Vertex v = mesh_.from_vertex_handle(h);
    if (stays(v)) return false;
    if (mesh_.has_copies(v) && mesh_.data(mesh_.edge_handle(h)).seam < 0) return false;
    mesh_.list_copies(h, along_);
    if (stars_.size() < along_.size()) stars_.resize(along_.size());
    for (std::size_t i = 0; i < along_.size(); ++i) {
        const Vertex end = mesh_.to_vertex_handle(along_[i]);
        const auto has_end = [&](HalfEdge other) { return mesh_.to_vertex_handle(other) == end; };
        if (std::any_of(along_.begin(), along_.begin() + i, has_end)) return false;
        if (!may_collapse(along_[i], rules, stars_[i])) return false;
    }
    for (std::size_t i = 0; i < along_.size(); ++i) commit_collapse(along_[i], stars_[i]);
    return true;
}

bool BoundedSurface::may_collapse(HalfEdge h, const CollapseRules& rules, NewFacets& star) {
    const Vertex v = mesh_.from_vertex_handle(h), w = mesh_.to_vertex_handle(h);
    const HalfEdge back = mesh_.opposite_halfedge_handle(h);
    const int features = mesh_.feature_count(v);
    const bool merges =
        rules.merges_features && !mesh_.has_copies(v) && mesh_.feature_count(w) >= 2 && mesh_.has_one_patch(v);
    if (features != 0 && !merges && !(features == 2 && mesh_.data(mesh_.edge_handle(h)).is_feature)) return false;
    star.clear();
    double worst = 1;
    for (const HalfEdge side : {h, back}) {
        if (mesh_.is_boundary(side)) continue;
        // The other edge of a feature line goes on from w.
        const Vertex aside = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side));
        if (!merges && mesh_.data(mesh_.edge_between(v, aside)).is_feature) return false;
        worst = std::min(worst, mesh_.sine(mesh_.face_handle(side)));
    }
    const Vec3& target = mesh_.point(w);
    for (const auto out : mesh_.voh_range(v)) {
        const Facet f = mesh_.face_handle(out);
        if (!f.is_valid() || f == mesh_.face_handle(h) || f == mesh_.face_handle(back)) continue;
        const Vertex b = mesh_.to_vertex_handle(out), c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
        if ((mesh_.point(b) - target).norm() > rules.longest * std::min(mesh_.size(b), mesh_.size(w))) return false;
        worst = std::min(worst, mesh_.sine(f));
        star.facets.push_back(f);
        star.corners.push_back({target, mesh_.point(b), mesh_.point(c)});
    }
    const double least = std::min(rules.good_sine, rules.worst_share * worst);
    for (const SheetMesh::Corners& t : star.corners)
        if (sine_of(t) < least) return false;
    if (!mesh_.is_collapse_ok(h) || is_of_tetrahedron(h)) return false;  // after the angles, which refuse most
    return !joins_what_is_apart(h) &&
           bound_.accepts_star(mesh_, v, mesh_.is_inside_region(v), InputBound::Evidence::proof, star);
}

void BoundedSurface::commit_collapse(HalfEdge h, const NewFacets& star) {
    const Vertex v = mesh_.from_vertex_handle(h), w = mesh_.to_vertex_handle(h);
    points_.clear();
    std::vector<Vertex> features;  // of v, beside the half-edge
    for (const HalfEdge side : {h, mesh_.opposite_halfedge_handle(h)}) {
        if (mesh_.is_boundary(side)) continue;
        bound_.list_points(mesh_.data(mesh_.face_handle(side)).first_point, points_);
        const Vertex aside = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side));
        if (mesh_.data(mesh_.edge_between(v, aside)).is_feature) features.push_back(aside);
    }
    for (const Facet f : star.facets) bound_.list_points(mesh_.data(f).first_point, points_);
    if (!mesh_.is_inside_region(v)) bound_.list_vertex(mesh_, v, points_);
    mesh_.collapse(h);
    for (const Vertex aside : features) mesh_.data(mesh_.edge_between(w, aside)).is_feature = true;
    commit_star(star);
}

bool BoundedSurface::collapse_either_way(Edge e, const CollapseRules& rules) {
    const HalfEdge h = mesh_.halfedge_handle(e, 0), back = mesh_.halfedge_handle(e, 1);
    const bool first = mesh_.valence(mesh_.from_vertex_handle(h)) <= mesh_.valence(mesh_.from_vertex_handle(back));
    return collapse(first ? h : back, rules) || collapse(first ? back : h, rules);
}

// Gives points_ to the facets of the star, which are in the mesh by now; points_ are those of the facets before.
void BoundedSurface::commit_star(const NewFacets& star) {
    for (std::size_t i = 0; i < star.facets.size(); ++i)
        if (star.stays[i] == 0) mesh_.data(star.facets[i]).region = -1;
    if (!star.points_stay) bound_.give_points(mesh_, points_, star.facets);
    note_change(star.facets);
}

void BoundedSurface::note_change(std::span<const Facet> facets) {
    ++changes_;
    for (const Facet f : facets) mesh_.note_change(f, changes_);
}

bool BoundedSurface::flip_if_better(Edge e, bool is_exact_only) {
    if (mesh_.data(e).is_feature || mesh_.is_fixed(e)) return false;
    const HalfEdge h = mesh_.halfedge_handle(e, 0), back = mesh_.halfedge_handle(e, 1);
    const Facet f = mesh_.face_handle(h), g = mesh_.face_handle(back);
    const Vec3 &a = mesh_.point(mesh_.from_vertex_handle(h)), &b = mesh_.point(mesh_.to_vertex_handle(h));
    const Vertex aside = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
    const Vertex across = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back));
    const Vec3 &c = mesh_.point(aside), &d = mesh_.point(across);
    NewFacets& star = stars_.front();
    star.facets = {f, g};
    star.corners = {{c, a, d}, {d, b, c}};
    const bool is_exact = mesh_.is_flat(e);
    if (is_exact_only && !is_exact) return false;
    if (std::min(sine_of(star.corners[0]), sine_of(star.corners[1])) <=
        (1 + 1e-6) * std::min(mesh_.sine(f), mesh_.sine(g)) + 1e-12)
        return false;
    if (!mesh_.is_flip_ok(e)) return false;  // after the angles, which refuse most
    if (mesh_.data(aside).is_border && mesh_.data(across).is_border) return false;  // it may be outside already
    if ((mesh_.has_copies(aside) || mesh_.has_copies(across)) && mesh_.are_joined(aside, across)) return false;
    if (!bound_.keeps_turns(mesh_, star)) return false;
    star.stays = {is_exact, is_exact};
    star.points_stay = false;
    if (!is_exact && !bound_.accepts_flip(mesh_, e, star)) return false;
    points_.clear();
    for (const Facet facet : star.facets) bound_.list_points(mesh_.data(facet).first_point, points_);
    mesh_.flip(e);
    mesh_.data(e).fold = -1;
    commit_star(star);
    return true;
}

BoundedSurface::Vertex BoundedSurface::split(Edge e, double t) {
    const auto [a, b] = mesh_.ends(e);
    const Vec3 place = (1 - t) * mesh_.point(a) + t * mesh_.point(b);
    const std::int32_t seam = mesh_.data(e).seam;
    if (seam < 0) return split_in_sheet(mesh_.halfedge_handle(e, 0), place);
    mesh_.list_copies(mesh_.halfedge_handle(e, 0), along_);
    Vertex in_this_sheet;
    std::vector<Vertex> copies;
    std::vector<Edge> before, behind;
    for (const HalfEdge h : along_) {
        const Vertex from = mesh_.from_vertex_handle(h), to = mesh_.to_vertex_handle(h);
        const Vertex v = split_in_sheet(h, place);
        if (from == a && to == b) in_this_sheet = v;
        copies.push_back(v);
        before.push_back(mesh_.edge_between(from, v));
        behind.push_back(mesh_.edge_between(v, to));
    }
    mesh_.make_copies(std::move(copies));
    mesh_.change_seam(seam, std::move(before));
    mesh_.make_seam(std::move(behind));
    return in_this_sheet;
}

BoundedSurface::Vertex BoundedSurface::split_in_sheet(HalfEdge h, const Vec3& place) {
    struct Side {
        Vertex apex;
        std::remove_cvref_t<decltype(std::declval<const SheetMesh&>().data(Facet()))> data;
    };
    const Edge e = mesh_.edge_handle(h);
    const auto ends = mesh_.ends(e);
    std::vector<Side> sides;
    for (const HalfEdge side : {mesh_.halfedge_handle(e, 0), mesh_.halfedge_handle(e, 1)})
        if (!mesh_.is_boundary(side))
            sides.push_back(
                {mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side)), mesh_.data(mesh_.face_handle(side))});
    const auto edge_data = mesh_.data(e);
    const double tolerance = std::min(mesh_.data(ends[0]).tolerance, mesh_.data(ends[1]).tolerance);
    const Vertex v = mesh_.add_vertex(place);
    mesh_.data(v).tolerance = tolerance;
    mesh_.split(e, v);
    for (const Vertex end : ends) mesh_.data(mesh_.edge_between(v, end)) = edge_data;
    for (const auto& [apex, data] : sides) {
        const HalfEdge to_apex = mesh_.find_halfedge(v, apex);
        mesh_.data(mesh_.edge_handle(to_apex)) = {};
        const std::array<Facet, 2> pieces = {mesh_.face_handle(to_apex),
                                             mesh_.face_handle(mesh_.opposite_halfedge_handle(to_apex))};
        points_.clear();
        bound_.list_points(data.first_point, points_);
        for (const Facet f : pieces) mesh_.data(f) = data;
        bound_.give_points(mesh_, points_, pieces);
        note_change(pieces);
    }
    return v;
}

bool BoundedSurface::move(Vertex v, const Vec3& wanted, InputBound::Evidence evidence) {
    if (stays(v)) return false;
    const int features = mesh_.feature_count(v);
    if (features != 0 && features != 2) return false;
    const bool is_inside = mesh_.is_inside_region(v);  // and has no copies
    const std::optional<Vec3> place = bound_.place_near(mesh_, v, wanted, is_inside);
    if (!place || *place == mesh_.point(v)) return false;
    copies_.clear();
    mesh_.for_each_copy(v, [&](Vertex copy) { copies_.push_back(copy); });
    if (stars_.size() < copies_.size()) stars_.resize(copies_.size());
    for (std::size_t i = 0; i < copies_.size(); ++i)
        if (!may_move(copies_[i], *place, is_inside, evidence, stars_[i])) return false;
    for (std::size_t i = 0; i < copies_.size(); ++i) commit_move(copies_[i], *place, is_inside, stars_[i]);
    return true;
}

bool BoundedSurface::may_move(Vertex v, const Vec3& place, bool is_inside, InputBound::Evidence evidence,
                              NewFacets& star) {
    if (mesh_.has_copies(v) && !bound_.lies_on_line(mesh_, v)) return false;
    star.clear();
    double worst = 1;
    for (const auto out : mesh_.voh_range(v)) {
        const Facet f = mesh_.face_handle(out);
        if (!f.is_valid()) continue;
        worst = std::min(worst, mesh_.sine(f));
        star.facets.push_back(f);
        star.corners.push_back({place, mesh_.point(mesh_.to_vertex_handle(out)),
                                mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out)))});
    }
    const double least = std::min(worst, good_move_sine);
    for (const SheetMesh::Corners& t : star.corners)
        if (sine_of(t) < least) return false;
    return bound_.accepts_star(mesh_, v, is_inside, evidence, star);
}

void BoundedSurface::commit_move(Vertex v, const Vec3& place, bool is_inside, const NewFacets& star) {
    points_.clear();
    if (!star.points_stay)
        for (const Facet f : star.facets) bound_.list_points(mesh_.data(f).first_point, points_);
    if (!is_inside) {
        bound_.list_vertex(mesh_, v, points_);
        mesh_.data(v).input = -1;  // a facet stands for it from now on
    }
    mesh_.set_point(v, place);
    commit_star(star);
}

}  // namespace kerf
