#include "remesh/edited_surface.h"

#include <algorithm>

#include "remesh/remesh.h"

namespace kerf {

namespace {

constexpr double good_move_sine = 0.57;  // of 35 degrees: triangles may get worse down to this

double sine_of(const EditMesh::Corners& t) { return smallest_sine(t[0], t[1], t[2]); }

}  // namespace

EditedSurface::EditedSurface(const InputShape& input, const std::vector<char>& kept) : bound_(input) {
    for (const Vec3& p : input.vertices()) {
        const Vertex v = mesh_.add_vertex(p);
        mesh_.data(v).tolerance = input.vertex_tolerance(v.idx());
        mesh_.data(v).input = v.idx();
    }
    for (std::size_t f = 0; f < input.facets().size(); ++f) {
        const Triangle& t = input.facets()[f];
        const auto number = static_cast<std::int32_t>(f);
        auto& data = mesh_.data(mesh_.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])));
        data.patch = input.patch(number);
        data.region = input.regions().of[f];
        data.near = number;
        data.is_kept = !kept.empty() && kept[f] != 0;
        if (data.is_kept)
            for (const std::int32_t v : t) mesh_.data(Vertex(v)).is_fixed = true;
        for (int i = 0; i < 3; ++i)
            if (input.is_feature(3 * number + i))
                mesh_.data(mesh_.edge_between(Vertex(t[i]), Vertex(t[(i + 1) % 3]))).is_feature = true;
    }
}

bool EditedSurface::collapse(HalfEdge h, const CollapseRules& rules) {
    const Vertex v = mesh_.from_vertex_handle(h), w = mesh_.to_vertex_handle(h);
    if (mesh_.data(v).is_fixed) return false;
    const HalfEdge back = mesh_.opposite_halfedge_handle(h);
    const int features = mesh_.feature_count(v);
    const bool merges = rules.merges_features && mesh_.feature_count(w) >= 2 && mesh_.has_one_patch(v);
    if (features != 0 && !merges && !(features == 2 && mesh_.data(mesh_.edge_handle(h)).is_feature)) return false;
    if (!mesh_.is_collapse_ok(h)) return false;
    // The other edge of a feature line goes on from w.
    const std::array<Vertex, 2> sides = {mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                                         mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back))};
    std::array<bool, 2> is_feature;
    for (int i = 0; i < 2; ++i) is_feature[i] = mesh_.data(mesh_.edge_between(v, sides[i])).is_feature;
    if (!merges && (is_feature[0] || is_feature[1])) return false;

    const Facet gone = mesh_.face_handle(h), gone_too = mesh_.face_handle(back);
    double worst = std::min(mesh_.sine(gone), mesh_.sine(gone_too));
    star_.clear();
    const Vec3& target = mesh_.point(w);
    for (const auto out : mesh_.voh_range(v)) {
        const Facet f = mesh_.face_handle(out);
        if (f == gone || f == gone_too) continue;
        const Vertex b = mesh_.to_vertex_handle(out), c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
        if ((mesh_.point(b) - target).norm() > rules.longest * std::min(mesh_.size(b), mesh_.size(w))) return false;
        worst = std::min(worst, mesh_.sine(f));
        star_.facets.push_back(f);
        star_.corners.push_back({target, mesh_.point(b), mesh_.point(c)});
    }
    const double least = std::min(rules.good_sine, rules.worst_share * worst);
    for (const EditMesh::Corners& t : star_.corners)
        if (sine_of(t) < least) return false;
    if (!bound_.accepts_star(mesh_, v, mesh_.is_inside_region(v), star_)) return false;

    points_.clear();
    bound_.list_points(mesh_.data(gone).first_point, points_);
    bound_.list_points(mesh_.data(gone_too).first_point, points_);
    for (const Facet f : star_.facets) bound_.list_points(mesh_.data(f).first_point, points_);
    if (!mesh_.is_inside_region(v)) bound_.list_vertex(mesh_, v, points_);
    mesh_.collapse(h);
    for (int i = 0; i < 2; ++i)
        if (is_feature[i]) mesh_.data(mesh_.edge_between(w, sides[i])).is_feature = true;
    commit_star();
    return true;
}

bool EditedSurface::collapse_either_way(Edge e, const CollapseRules& rules) {
    const HalfEdge h = mesh_.halfedge_handle(e, 0), back = mesh_.halfedge_handle(e, 1);
    const bool first = mesh_.valence(mesh_.from_vertex_handle(h)) <= mesh_.valence(mesh_.from_vertex_handle(back));
    return collapse(first ? h : back, rules) || collapse(first ? back : h, rules);
}

// The mesh has the facets of star_ now, and points_ is what they and those that are gone stood for.
void EditedSurface::commit_star() {
    for (std::size_t i = 0; i < star_.facets.size(); ++i)
        if (star_.stays[i] == 0) mesh_.data(star_.facets[i]).region = -1;
    bound_.give_points(mesh_, points_, star_.facets);
    note_change(star_.facets);
}

void EditedSurface::note_change(std::span<const Facet> facets) {
    ++changes_;
    for (const Facet f : facets) mesh_.note_change(f, changes_);
}

bool EditedSurface::take_flip(Edge e, bool is_exact_only) {
    if (mesh_.data(e).is_feature || mesh_.is_fixed(e)) return false;
    const HalfEdge h = mesh_.halfedge_handle(e, 0), back = mesh_.halfedge_handle(e, 1);
    const Facet f = mesh_.face_handle(h), g = mesh_.face_handle(back);
    const Vec3 &a = mesh_.point(mesh_.from_vertex_handle(h)), &b = mesh_.point(mesh_.to_vertex_handle(h));
    const Vec3& c = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)));
    const Vec3& d = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back)));
    star_.facets = {f, g};
    star_.corners = {{c, a, d}, {d, b, c}};
    const bool is_exact = mesh_.is_flat(e);
    if (is_exact_only && !is_exact) return false;
    if (std::min(sine_of(star_.corners[0]), sine_of(star_.corners[1])) <=
        (1 + 1e-6) * std::min(mesh_.sine(f), mesh_.sine(g)) + 1e-12)
        return false;
    if (!mesh_.is_flip_ok(e)) return false;  // after the angles, which refuse most
    if (!bound_.keeps_turns(mesh_, star_)) return false;
    star_.stays = {is_exact, is_exact};
    if (!is_exact && !bound_.accepts_flip(mesh_, e, star_)) return false;
    points_.clear();
    for (const Facet facet : star_.facets) bound_.list_points(mesh_.data(facet).first_point, points_);
    mesh_.flip(e);
    mesh_.data(e).fold = -1;
    commit_star();
    return true;
}

EditedSurface::Vertex EditedSurface::split(Edge e, double t) {
    const HalfEdge h = mesh_.halfedge_handle(e, 0), back = mesh_.halfedge_handle(e, 1);
    const Vertex a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
    const std::array<Vertex, 2> apex = {mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                                        mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back))};
    const std::array<Facet, 2> old = {mesh_.face_handle(h), mesh_.face_handle(back)};
    const auto data = std::array{mesh_.data(old[0]), mesh_.data(old[1])};
    const auto edge_data = mesh_.data(e);
    const double tolerance = std::min(mesh_.data(a).tolerance, mesh_.data(b).tolerance);
    const Vertex v = mesh_.add_vertex((1 - t) * mesh_.point(a) + t * mesh_.point(b));
    mesh_.data(v).tolerance = tolerance;
    mesh_.split(e, v);
    for (const Vertex end : {a, b}) mesh_.data(mesh_.edge_between(v, end)) = edge_data;
    for (int side = 0; side < 2; ++side) {
        const HalfEdge to_apex = mesh_.find_halfedge(v, apex[side]);
        mesh_.data(mesh_.edge_handle(to_apex)) = {};
        const std::array<Facet, 2> pieces = {mesh_.face_handle(to_apex),
                                             mesh_.face_handle(mesh_.opposite_halfedge_handle(to_apex))};
        points_.clear();
        bound_.list_points(data[side].first_point, points_);
        for (const Facet f : pieces) mesh_.data(f) = data[side];
        bound_.give_points(mesh_, points_, pieces);
        note_change(pieces);
    }
    return v;
}

bool EditedSurface::move(Vertex v, const Vec3& wanted) {
    if (mesh_.data(v).is_fixed) return false;
    const int features = mesh_.feature_count(v);
    if (features != 0 && features != 2) return false;
    const bool is_inside = mesh_.is_inside_region(v);
    const std::optional<Vec3> place = bound_.place_near(mesh_, v, wanted, is_inside);
    if (!place || *place == mesh_.point(v)) return false;
    star_.clear();
    double worst = 1;
    for (const auto out : mesh_.voh_range(v)) {
        const Facet f = mesh_.face_handle(out);
        worst = std::min(worst, mesh_.sine(f));
        star_.facets.push_back(f);
        star_.corners.push_back({*place, mesh_.point(mesh_.to_vertex_handle(out)),
                                 mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out)))});
    }
    const double least = std::min(worst, good_move_sine);
    for (const EditMesh::Corners& t : star_.corners)
        if (sine_of(t) < least) return false;
    if (!bound_.accepts_star(mesh_, v, is_inside, star_)) return false;
    points_.clear();
    for (const Facet f : star_.facets) bound_.list_points(mesh_.data(f).first_point, points_);
    if (!is_inside) bound_.list_vertex(mesh_, v, points_);
    mesh_.set_point(v, *place);
    commit_star();
    return true;
}

}  // namespace kerf
