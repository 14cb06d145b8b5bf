#include "remesh/edited_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace kerf {

namespace {

using Corners = std::array<Vec3, 3>;

constexpr double good_move_sine = 0.57;    // of 35 degrees: triangles may get worse down to this
constexpr double least_turn_cosine = 0.5;  // of the normal of a new facet against that of the input

constexpr double facing_cosine = -0.1;  // of a facet's normal against that of the input that it may be near
constexpr int most_divisions = 60;      // of a facet, to see that it is near the input

Vec3 area_normal(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

double squared_distance(const Vec3& p, const Corners& t) {
    return (p - closest_point(p, t[0], t[1], t[2])).squaredNorm();
}

double sine_of(const Corners& t) { return smallest_sine(t[0], t[1], t[2]); }

}  // namespace

// It lies opposite to the shortest edge.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double shortest = std::min({ab, bc, ca});
    const double product = shortest == ab ? bc * ca : shortest == bc ? ab * ca : ab * bc;
    return product > 0 ? (b - a).cross(c - a).norm() / std::sqrt(product) : 0;
}

EditedSurface::EditedSurface(const InputShape& input)
    : input_(input),
      near_input_(input.tree(), input.facets()),
      planes_(input.regions().planes),
      next_point_(input.vertices().size(), unlisted) {
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
        for (int i = 0; i < 3; ++i)
            if (input.is_feature(3 * number + i))
                mesh_.data(mesh_.edge_handle(mesh_.find_halfedge(Vertex(t[i]), Vertex(t[(i + 1) % 3])))).is_feature =
                    true;
    }
}

void EditedSurface::find_regions(double share) {
    mesh_.garbage_collection();
    const SurfaceArrays now = arrays();
    const auto is_border = [&](std::int32_t corner) {
        const Triangle& t = now.facets[corner / 3];
        return mesh_.data(mesh_.edge_handle(mesh_.find_halfedge(Vertex(t[corner % 3]), Vertex(t[(corner + 1) % 3]))))
            .is_feature;
    };
    FlatRegions regions = find_flat_regions(
        now.vertices, now.facets,
        {.tolerance = share * input_.largest_tolerance(), .noise = input_.noise(), .is_border = is_border});
    planes_ = std::move(regions.planes);
    for (const auto f : mesh_.faces()) mesh_.data(f).region = regions.of[f.idx()];
}

std::int64_t EditedSurface::last_change(Vertex v) const {
    std::int64_t last = 0;
    for (const auto f : mesh_.vf_range(v)) last = std::max(last, mesh_.data(f).changed);
    return last;
}

std::int64_t EditedSurface::last_change(Edge e) const {
    return std::max(mesh_.data(mesh_.face_handle(mesh_.halfedge_handle(e, 0))).changed,
                    mesh_.data(mesh_.face_handle(mesh_.halfedge_handle(e, 1))).changed);
}

double EditedSurface::length(Edge e) const { return mesh_.calc_edge_length(e); }

double EditedSurface::sine(Facet f) const { return sine_of(corners(f)); }

Corners EditedSurface::corners(Facet f) const {
    const HalfEdge h = mesh_.halfedge_handle(f), next = mesh_.next_halfedge_handle(h);
    return {mesh_.point(mesh_.from_vertex_handle(h)), mesh_.point(mesh_.to_vertex_handle(h)),
            mesh_.point(mesh_.to_vertex_handle(next))};
}

int EditedSurface::feature_count(Vertex v) const {
    int count = 0;
    for (const auto e : mesh_.ve_range(v)) count += mesh_.data(e).is_feature ? 1 : 0;
    return count;
}

bool EditedSurface::is_flat(Edge e) const {
    const std::int32_t region = mesh_.data(mesh_.face_handle(mesh_.halfedge_handle(e, 0))).region;
    return region >= 0 && region == mesh_.data(mesh_.face_handle(mesh_.halfedge_handle(e, 1))).region &&
           !mesh_.data(e).is_feature;
}

double EditedSurface::fold_cosine(Edge e) const {
    const Vec3 a = area_normal(corners(mesh_.face_handle(mesh_.halfedge_handle(e, 0))));
    const Vec3 b = area_normal(corners(mesh_.face_handle(mesh_.halfedge_handle(e, 1))));
    const double norms = a.norm() * b.norm();
    return norms > 0 ? a.dot(b) / norms : 1;
}

bool EditedSurface::keeps_turn(Facet f, const Corners& now) const {
    const auto& data = mesh_.data(f);
    const Vec3& wanted = data.region >= 0 ? planes_[data.region].normal : input_.normal(data.near);
    const Vec3 normal = area_normal(now);
    return normal.dot(wanted) > least_turn_cosine * normal.norm();
}

bool EditedSurface::stays_in_region(Facet f, const Corners& now) const {
    const std::int32_t region = mesh_.data(f).region;
    if (region < 0) return false;
    const FlatRegion& flat = planes_[region];
    return flat.contains(now[0]) && flat.contains(now[1]) && flat.contains(now[2]);
}

bool EditedSurface::is_near_input(Facet f, const Corners& now) {
    const Vec3 normal = area_normal(now);
    const double least = facing_cosine * normal.norm();
    return near_input_.holds(
        now, share_ * input_.largest_tolerance(),
        [&](std::int32_t facet) {
            return input_.normal(facet).dot(normal) > least ? share_ * input_.tolerance(facet) : -1;
        },
        most_divisions, mesh_.data(f).near);
}

bool EditedSurface::holds_points(std::span<const std::int32_t> points, std::span<const Corners> facets) const {
    return std::all_of(points.begin(), points.end(), [&](std::int32_t point) {
        const Vec3& p = input_.vertices()[point];
        const double tolerance = share_ * input_.vertex_tolerance(point);
        return std::any_of(facets.begin(), facets.end(),
                           [&](const Corners& t) { return squared_distance(p, t) <= tolerance * tolerance; });
    });
}

void EditedSurface::list_points(Facet f, std::vector<std::int32_t>& points) const {
    for (std::int32_t p = mesh_.data(f).first_point; p >= 0; p = next_point_[p]) points.push_back(p);
}

// To the closest of them.
void EditedSurface::give_points(std::span<const std::int32_t> points, std::span<const Facet> facets) {
    for (const Facet f : facets) mesh_.data(f).first_point = -1;
    for (const std::int32_t point : points) {
        const Vec3& p = input_.vertices()[point];
        Facet best = facets.front();
        double least = std::numeric_limits<double>::infinity();
        for (const Facet f : facets)
            if (const double squared = squared_distance(p, corners(f)); squared < least) {
                least = squared;
                best = f;
            }
        next_point_[point] = mesh_.data(best).first_point;
        mesh_.data(best).first_point = point;
    }
}

// A vertex of the input that is about to leave its place: unlisted says that no list has it yet.
void EditedSurface::list_vertex(Vertex v, std::vector<std::int32_t>& points) const {
    const std::int32_t number = mesh_.data(v).input;
    if (number >= 0 && next_point_[number] == unlisted) points.push_back(number);
}

bool EditedSurface::is_inside_region(Vertex v) const {
    std::int32_t region = -1;
    for (const auto f : mesh_.vf_range(v)) {
        if (mesh_.data(f).region < 0 || (region >= 0 && mesh_.data(f).region != region)) return false;
        region = mesh_.data(f).region;
    }
    return feature_count(v) == 0;
}

bool EditedSurface::collapse(HalfEdge h, const CollapseRules& rules) {
    const Vertex v = mesh_.from_vertex_handle(h), w = mesh_.to_vertex_handle(h);
    const HalfEdge back = mesh_.opposite_halfedge_handle(h);
    const int features = feature_count(v);
    if (features != 0 && !(features == 2 && mesh_.data(mesh_.edge_handle(h)).is_feature)) return false;
    if (!mesh_.is_collapse_ok(h)) return false;
    // The other edge of a feature line goes on from w.
    const Vertex left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
    const Vertex right = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back));
    const Edge to_left = mesh_.edge_handle(mesh_.find_halfedge(v, left));
    const Edge to_right = mesh_.edge_handle(mesh_.find_halfedge(v, right));
    if (mesh_.data(to_left).is_feature || mesh_.data(to_right).is_feature) return false;

    const Facet gone = mesh_.face_handle(h), gone_too = mesh_.face_handle(back);
    double worst = std::min(sine(gone), sine(gone_too));
    star_.facets.clear();
    star_.corners.clear();
    const Vec3& target = mesh_.point(w);
    for (const auto out : mesh_.voh_range(v)) {
        const Facet f = mesh_.face_handle(out);
        if (f == gone || f == gone_too) continue;
        const Vertex b = mesh_.to_vertex_handle(out), c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out));
        if ((mesh_.point(b) - target).norm() > rules.longest * std::min(size(b), size(w))) return false;
        worst = std::min(worst, sine(f));
        star_.facets.push_back(f);
        star_.corners.push_back({target, mesh_.point(b), mesh_.point(c)});
    }
    const double least = std::min(rules.good_sine, rules.worst_share * worst);
    for (const Corners& t : star_.corners)
        if (sine_of(t) < least) return false;
    if (!accepts_star(v, is_inside_region(v))) return false;

    points_.clear();
    list_points(gone, points_);
    list_points(gone_too, points_);
    for (const Facet f : star_.facets) list_points(f, points_);
    if (!is_inside_region(v)) list_vertex(v, points_);
    mesh_.collapse(h);
    commit_star();
    return true;
}

// Whether the facets of star_ may take the place of those around v.
bool EditedSurface::accepts_star(Vertex v, bool is_inside) {
    for (std::size_t i = 0; i < star_.facets.size(); ++i)
        if (!keeps_turn(star_.facets[i], star_.corners[i])) return false;
    star_.stays.clear();
    for (std::size_t i = 0; i < star_.facets.size(); ++i)
        star_.stays.push_back(stays_in_region(star_.facets[i], star_.corners[i]));
    const bool all_stay = std::all_of(star_.stays.begin(), star_.stays.end(), [](char stays) { return stays != 0; });
    if (is_inside && all_stay) return true;
    const double tolerance = share_ * mesh_.data(v).tolerance;
    const bool holds_vertex = std::any_of(star_.corners.begin(), star_.corners.end(), [&](const Corners& t) {
        return squared_distance(mesh_.point(v), t) <= tolerance * tolerance;
    });
    if (!holds_vertex) return false;
    points_.clear();
    for (const auto f : mesh_.vf_range(v)) list_points(f, points_);
    list_vertex(v, points_);
    if (!holds_points(points_, star_.corners)) return false;
    for (std::size_t i = 0; i < star_.facets.size(); ++i)
        if (star_.stays[i] == 0 && !is_near_input(star_.facets[i], star_.corners[i])) return false;
    return true;
}

// The mesh has the facets of star_ now, and points_ is what they and those that are gone stood for.
void EditedSurface::commit_star() {
    for (std::size_t i = 0; i < star_.facets.size(); ++i)
        if (star_.stays[i] == 0) mesh_.data(star_.facets[i]).region = -1;
    give_points(points_, star_.facets);
    note_change(star_.facets);
}

void EditedSurface::note_change(std::span<const Facet> facets) {
    ++changes_;
    for (const Facet f : facets) mesh_.data(f).changed = changes_;
}

bool EditedSurface::take_flip(Edge e, bool is_exact_only) {
    if (mesh_.data(e).is_feature) return false;
    const HalfEdge h = mesh_.halfedge_handle(e, 0), back = mesh_.halfedge_handle(e, 1);
    const Facet f = mesh_.face_handle(h), g = mesh_.face_handle(back);
    const Vec3 &a = mesh_.point(mesh_.from_vertex_handle(h)), &b = mesh_.point(mesh_.to_vertex_handle(h));
    const Vec3& c = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)));
    const Vec3& d = mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(back)));
    star_.facets = {f, g};
    star_.corners = {{c, a, d}, {d, b, c}};
    const bool is_exact = is_flat(e);
    if (is_exact_only && !is_exact) return false;
    if (std::min(sine_of(star_.corners[0]), sine_of(star_.corners[1])) <=
        (1 + 1e-6) * std::min(sine(f), sine(g)) + 1e-12)
        return false;
    if (!mesh_.is_flip_ok(e)) return false;  // after the angles, which refuse most
    for (int i = 0; i < 2; ++i)
        if (!keeps_turn(star_.facets[i], star_.corners[i])) return false;
    points_.clear();
    list_points(f, points_);
    list_points(g, points_);
    star_.stays = {is_exact, is_exact};
    if (!is_exact) {
        if (!holds_points(points_, star_.corners)) return false;
        // The edge that goes must be near the new facets as well.
        const Vec3 middle = (a + b) / 2;
        const double tolerance = share_ * std::min(mesh_.data(mesh_.from_vertex_handle(h)).tolerance,
                                                   mesh_.data(mesh_.to_vertex_handle(h)).tolerance);
        if (std::min(squared_distance(middle, star_.corners[0]), squared_distance(middle, star_.corners[1])) >
            tolerance * tolerance)
            return false;
        for (int i = 0; i < 2; ++i)
            if (!is_near_input(star_.facets[i], star_.corners[i])) return false;
    }
    mesh_.flip(e);
    mesh_.data(e).fold = -1;
    commit_star();
    return true;
}

bool EditedSurface::flip(Edge e) { return take_flip(e, false); }

bool EditedSurface::make_delaunay(Edge e) { return take_flip(e, true); }

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
    for (const Vertex end : {a, b}) mesh_.data(mesh_.edge_handle(mesh_.find_halfedge(v, end))) = edge_data;
    for (int side = 0; side < 2; ++side) {
        const HalfEdge to_apex = mesh_.find_halfedge(v, apex[side]);
        mesh_.data(mesh_.edge_handle(to_apex)) = {};
        const std::array<Facet, 2> pieces = {mesh_.face_handle(to_apex),
                                             mesh_.face_handle(mesh_.opposite_halfedge_handle(to_apex))};
        points_.clear();
        for (std::int32_t p = data[side].first_point; p >= 0; p = next_point_[p]) points_.push_back(p);
        for (const Facet f : pieces) mesh_.data(f) = data[side];
        give_points(points_, pieces);
        note_change(pieces);
    }
    return v;
}

// Where v may go: in its flat region, along the line that it lies on, or on the input.
std::optional<Vec3> EditedSurface::place_near(Vertex v, const Vec3& wanted, bool is_inside) const {
    if (is_inside) {
        const FlatRegion& flat = planes_[mesh_.data(*mesh_.cvf_begin(v)).region];
        return Vec3(wanted - flat.normal.dot(wanted - mesh_.point(v)) * flat.normal);
    }
    std::array<Vec3, 2> ends;
    int borders = 0, features = 0;
    for (const auto out : mesh_.voh_range(v)) {
        const Edge e = mesh_.edge_handle(out);
        features += mesh_.data(e).is_feature ? 1 : 0;
        if (is_flat(e)) continue;
        if (borders < 2) ends[borders] = mesh_.point(mesh_.to_vertex_handle(out));
        ++borders;
    }
    if (borders == 2) {  // along the line towards the end that lies in the wanted direction
        const Vec3 &p = mesh_.point(v), step = wanted - p;
        const Vec3& end = step.dot(ends[0] - p) > step.dot(ends[1] - p) ? ends[0] : ends[1];
        const double t = step.dot(end - p) / (end - p).squaredNorm();
        return t > 0 ? std::optional<Vec3>(p + std::min(t, 0.5) * (end - p)) : std::nullopt;
    }
    if (features > 0) return std::nullopt;
    // No further than a facet that is known to be near.
    const double squared = input_.tree().squared_distance_to(wanted, mesh_.data(*mesh_.cvf_begin(v)).near);
    return squared == 0 ? wanted : input_.tree().closest(wanted, (1 + 1e-6) * squared).point;
}

bool EditedSurface::move(Vertex v, const Vec3& wanted) {
    const int features = feature_count(v);
    if (features != 0 && features != 2) return false;
    const bool is_inside = is_inside_region(v);
    const std::optional<Vec3> place = place_near(v, wanted, is_inside);
    if (!place || *place == mesh_.point(v)) return false;
    star_.facets.clear();
    star_.corners.clear();
    double worst = 1;
    for (const auto out : mesh_.voh_range(v)) {
        const Facet f = mesh_.face_handle(out);
        worst = std::min(worst, sine(f));
        star_.facets.push_back(f);
        star_.corners.push_back({*place, mesh_.point(mesh_.to_vertex_handle(out)),
                                 mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(out)))});
    }
    const double least = std::min(worst, good_move_sine);
    for (const Corners& t : star_.corners)
        if (sine_of(t) < least) return false;
    if (!accepts_star(v, is_inside)) return false;
    points_.clear();
    for (const Facet f : star_.facets) list_points(f, points_);
    if (!is_inside) list_vertex(v, points_);
    mesh_.set_point(v, *place);
    commit_star();
    return true;
}

std::int64_t EditedSurface::feature_edges() const {
    return std::count_if(mesh_.edges_begin(), mesh_.edges_end(),
                         [&](const auto& e) { return !mesh_.status(e).deleted() && mesh_.data(e).is_feature; });
}

SurfaceArrays EditedSurface::arrays() {
    mesh_.garbage_collection();
    SurfaceArrays result;
    for (const auto v : mesh_.vertices()) {
        result.vertices.push_back(mesh_.point(v));
        result.vertex_key.push_back(make_key(0, v.idx()));
    }
    for (const auto f : mesh_.faces()) {
        const HalfEdge h = mesh_.halfedge_handle(f), next = mesh_.next_halfedge_handle(h);
        result.facets.push_back(
            {mesh_.from_vertex_handle(h).idx(), mesh_.to_vertex_handle(h).idx(), mesh_.to_vertex_handle(next).idx()});
        result.facet_key.push_back(make_key(0, f.idx()));
        result.patch.push_back(mesh_.data(f).patch);
    }
    return result;
}

}  // namespace kerf
