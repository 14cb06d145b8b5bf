// A change is accepted in this order: no facet turns over against the normal of its flat region, or of the input near
// it; the place that a vertex leaves, and every vertex of the input for which the facets stand, stays within its
// tolerance of one of the new facets; and each new facet is near the input as a whole, by Nearness. A facet that stays
// in its flat region needs no proof, as the plane is near the input. Only facets of the input that face the same way
// count as near, lest a facet comes to the other side of a thin wall. The vertices for which a facet stands are a list
// through SheetState::next_point, from the facet's first_point to -1; those that are in no list have not moved, or only
// within a flat region, where none is needed. A list belongs to one facet, so pieces do not share any.
#include "surface/remesh/inside/input_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/ids.h"
#include "base/geometry/closest_point.h"

namespace kerf {

namespace {

constexpr double least_turn_cosine = 0.5;  // of the normal of a new facet against that of the input
constexpr double facing_cosine = -0.1;     // of a facet's normal against that of the input that it may be near
constexpr int most_divisions = 60;         // of a facet, to see that it is near the input
// Of the tolerance, for samples. An edge over a fold is up to twice as high as in its middle, and up to 4/3 as high as
// at the highest of its quarters; the inspection allows a quarter more than the tolerance.
constexpr double share_of_few_samples = 0.45, share_of_many_samples = 0.9;
constexpr double share_of_own = 0.5;  // of the tolerance, within which a facet goes on standing for a point

double squared_distance(const Vec3& p, const SheetMesh::Corners& t) {
    return (p - closest_point(p, t[0], t[1], t[2])).squaredNorm();
}

}  // namespace

InputBound::InputBound(const InputShape& input, SheetState& state)
    : input_(&input), near_input_(input.nearness()), planes_(&state.planes), next_point_(&state.next_point) {}

bool InputBound::keeps_turns(const SheetMesh& mesh, const NewFacets& star) const {
    for (std::size_t i = 0; i < star.facets.size(); ++i) {
        const auto& data = mesh.data(star.facets[i]);
        const Vec3& wanted = data.region >= 0 ? (*planes_)[data.region].normal : input_->normal(data.near);
        const Vec3 normal = area_normal(star.corners[i]);
        if (!(normal.dot(wanted) > least_turn_cosine * normal.norm())) return false;
    }
    return true;
}

bool InputBound::stays_in_region(std::int32_t region, const SheetMesh::Corners& now) const {
    if (region < 0) return false;
    const FlatRegion& flat = (*planes_)[region];
    return flat.contains(now[0]) && flat.contains(now[1]) && flat.contains(now[2]);
}

bool InputBound::is_near_input(SheetMesh& mesh, SheetMesh::FaceHandle f, const SheetMesh::Corners& now) {
    const Vec3 normal = area_normal(now);
    const double least = facing_cosine * normal.norm();
    return near_input_.holds(
        now, share_ * input_->largest_tolerance(),
        [&](std::int32_t facet) {
            return input_->normal(facet).dot(normal) > least ? share_ * input_->tolerance(facet) : -1;
        },
        most_divisions, mesh.data(f).near);
}

// First few points that must be well within the tolerance, then more that may be nearer to it.
bool InputBound::has_near_samples(SheetMesh& mesh, SheetMesh::FaceHandle f, const SheetMesh::Corners& now) {
    std::int32_t& near = mesh.data(f).near;
    double largest = 0;  // over the tolerance
    // Returns false for a point above the limit, and where the walk to the facet below it is lost.
    const auto is_below = [&](double limit, double a, double b) {
        const Vec3 p = (1 - a - b) * now[0] + a * now[1] + b * now[2];
        const std::int32_t below = near_input_.facet_below(p, near);
        if (below < 0) return false;
        near = below;
        largest =
            std::max(largest, std::sqrt(near_input_.squared_distance(p, below)) / (share_ * input_->tolerance(below)));
        return largest <= limit;
    };
    constexpr double third = 1. / 3;
    for (const auto& [a, b] : {std::pair(third, third), {0.5, 0.}, {0.5, 0.5}, {0., 0.5}})
        if (!is_below(share_of_many_samples, a, b)) return false;
    if (largest <= share_of_few_samples) return true;
    for (const auto& [a, b] : {std::pair(0.25, 0.),
                               {0.75, 0.},
                               {0.75, 0.25},
                               {0.25, 0.75},
                               {0., 0.75},
                               {0., 0.25},
                               {0.25, 0.25},
                               {0.5, 0.25},
                               {0.25, 0.5}})
        if (!is_below(share_of_many_samples, a, b)) return false;
    return true;
}

void InputBound::list_points(std::int32_t first, std::int32_t own) {
    for (std::int32_t p = first; p >= 0; p = (*next_point_)[p]) points_.push_back({p, own});
}

bool InputBound::holds_points(std::span<const SheetMesh::Corners> facets, bool& stay) const {
    stay = true;
    for (const auto& [point, own] : points_) {
        const Vec3& p = input_->vertices()[point];
        const double tolerance = share_ * input_->vertex_tolerance(point);
        const auto is_within = [&](const SheetMesh::Corners& t, double distance) {
            return squared_distance(p, t) <= distance * distance;
        };
        if (own >= 0 && is_within(facets[own], share_of_own * tolerance)) continue;
        stay = false;
        if (std::none_of(facets.begin(), facets.end(), [&](const auto& t) { return is_within(t, tolerance); }))
            return false;
    }
    return true;
}

bool InputBound::accepts_star(SheetMesh& mesh, SheetMesh::VertexHandle v, bool is_inside, Evidence evidence,
                              NewFacets& star) {
    if (!keeps_turns(mesh, star)) return false;
    star.stays.clear();
    star.points_stay = false;
    for (std::size_t i = 0; i < star.facets.size(); ++i)
        star.stays.push_back(stays_in_region(mesh.data(star.facets[i]).region, star.corners[i]));
    const bool all_stay = std::all_of(star.stays.begin(), star.stays.end(), [](char stays) { return stays != 0; });
    if (is_inside && all_stay) return true;
    const double tolerance = share_ * mesh.data(v).tolerance;
    const bool holds_vertex = std::any_of(star.corners.begin(), star.corners.end(), [&](const SheetMesh::Corners& t) {
        return squared_distance(mesh.point(v), t) <= tolerance * tolerance;
    });
    if (!holds_vertex) return false;
    points_.clear();
    for (const auto f : mesh.vf_range(v)) {
        const auto own = std::find(star.facets.begin(), star.facets.end(), f);
        list_points(mesh.data(f).first_point, own == star.facets.end() ? -1 : own - star.facets.begin());
    }
    if (const std::int32_t number = mesh.data(v).input; number >= 0) points_.push_back({number, -1});
    if (!holds_points(star.corners, star.points_stay)) return false;
    for (std::size_t i = 0; i < star.facets.size(); ++i) {
        if (star.stays[i] != 0) continue;
        if (evidence == Evidence::samples && has_near_samples(mesh, star.facets[i], star.corners[i])) continue;
        if (!is_near_input(mesh, star.facets[i], star.corners[i])) return false;
    }
    return true;
}

bool InputBound::accepts_flip(SheetMesh& mesh, SheetMesh::EdgeHandle e, const NewFacets& pair) {
    points_.clear();
    for (std::int32_t i = 0; i < count_of(pair.facets); ++i) list_points(mesh.data(pair.facets[i]).first_point, i);
    bool stay = false;
    if (!holds_points(pair.corners, stay)) return false;
    // The edge that goes must be near the new facets as well.
    const SheetMesh::VertexHandle a = mesh.from_vertex_handle(mesh.halfedge_handle(e, 0));
    const SheetMesh::VertexHandle b = mesh.to_vertex_handle(mesh.halfedge_handle(e, 0));
    const Vec3 middle = (mesh.point(a) + mesh.point(b)) / 2;
    const double tolerance = share_ * std::min(mesh.data(a).tolerance, mesh.data(b).tolerance);
    if (std::min(squared_distance(middle, pair.corners[0]), squared_distance(middle, pair.corners[1])) >
        tolerance * tolerance)
        return false;
    return is_near_input(mesh, pair.facets[0], pair.corners[0]) && is_near_input(mesh, pair.facets[1], pair.corners[1]);
}

bool InputBound::lies_on_line(const SheetMesh& mesh, SheetMesh::VertexHandle v) {
    return std::count_if(mesh.cve_begin(v), mesh.cve_end(v),
                         [&](SheetMesh::EdgeHandle e) { return !mesh.is_flat(e); }) == 2;
}

std::optional<Vec3> InputBound::place_near(const SheetMesh& mesh, SheetMesh::VertexHandle v, const Vec3& wanted,
                                           bool is_inside) const {
    if (is_inside) {
        const FlatRegion& flat = (*planes_)[mesh.data(*mesh.cvf_begin(v)).region];
        return Vec3(wanted - flat.normal.dot(wanted - mesh.point(v)) * flat.normal);
    }
    std::array<Vec3, 2> ends;
    int borders = 0, features = 0;
    for (const auto out : mesh.voh_range(v)) {
        const SheetMesh::EdgeHandle e = mesh.edge_handle(out);
        features += mesh.data(e).is_feature ? 1 : 0;
        if (mesh.is_flat(e)) continue;
        if (borders < 2) ends[borders] = mesh.point(mesh.to_vertex_handle(out));
        ++borders;
    }
    if (borders == 2) {  // along the line towards the end that lies in the wanted direction
        const Vec3 &p = mesh.point(v), step = wanted - p;
        const Vec3& end = step.dot(ends[0] - p) > step.dot(ends[1] - p) ? ends[0] : ends[1];
        const double t = step.dot(end - p) / (end - p).squaredNorm();
        return t > 0 ? std::optional<Vec3>(p + std::min(t, 0.5) * (end - p)) : std::nullopt;
    }
    if (features > 0) return std::nullopt;
    // Any facet below will do, not only the closest one: accepts_star() decides whether the place is near enough.
    const std::int32_t near = mesh.data(*mesh.cvf_begin(v)).near;
    if (const std::int32_t below = near_input_.facet_below(wanted, near); below >= 0) {
        const auto& [a, b, c] = input_->tree().corners(below);
        const Vec3 place = closest_point(wanted, a, b, c);
        if ((place - wanted).norm() < mesh.size(v)) return place;
    }
    // No further than a facet that is known to be near.
    const double squared = input_->tree().squared_distance_to(wanted, near);
    return squared == 0 ? wanted : input_->tree().closest(wanted, (1 + 1e-6) * squared).point;
}

void InputBound::list_vertex(const SheetMesh& mesh, SheetMesh::VertexHandle v, std::vector<std::int32_t>& points) {
    if (const std::int32_t number = mesh.data(v).input; number >= 0) points.push_back(number);
}

void InputBound::give_points(SheetMesh& mesh, std::span<const std::int32_t> points,
                             std::span<const SheetMesh::FaceHandle> facets) {
    for (const SheetMesh::FaceHandle f : facets) mesh.data(f).first_point = -1;
    for (const std::int32_t point : points) {
        const Vec3& p = input_->vertices()[point];
        SheetMesh::FaceHandle best = facets.front();
        double least = std::numeric_limits<double>::infinity();
        for (const SheetMesh::FaceHandle f : facets)
            if (const double squared = squared_distance(p, mesh.corners(f)); squared < least) {
                least = squared;
                best = f;
            }
        (*next_point_)[point] = mesh.data(best).first_point;
        mesh.data(best).first_point = point;
    }
}

}  // namespace kerf
