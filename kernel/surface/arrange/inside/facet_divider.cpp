// The facets of a plane are projected along a coordinate axis, which keeps crossings and the order of points on lines.
// A facet that crosses them leaves a segment, whose ends are corners, or points in which an edge goes through a facet:
// the ends are among such points of both, because the segment is the common part of both facets on the line in which
// their planes meet. Edges and segments are the constraints of a triangulation with rational coordinates (CGAL), which
// finds the points in which they cross. Its vertices are rounded to doubles and numbered by their coordinates, then
// flips make it nearly Delaunay, and the pieces of each facet are collected by walking over faces from the facet's
// border inwards. The order of faces in memory must not matter: lists follow the order in which faces were made.
#include "surface/arrange/inside/facet_divider.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#define CGAL_NO_CDT_2_WARNING  // its way to intersect constraints is used knowingly
#include <CGAL/Constrained_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/predicates.h"
#include "surface/arrange/inside/facet_contact.h"

namespace kerf {

namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint2 = ExactKernel::Point_2;
using ExactPoint3 = ExactKernel::Point_3;

struct PointNumber {
    std::int32_t value = -1;
};

// Marks of a face: its place among all before they are flipped, and, while pieces are collected, the facet that has
// reached it and, for each of its sides, the facet that is bounded by it.
struct FaceMark {
    std::int32_t place = -1;
    std::int32_t seen = -1;
    std::array<std::int32_t, 3> bounds = {-1, -1, -1};
};

using PlaneVertex = CGAL::Triangulation_vertex_base_with_info_2<PointNumber, ExactKernel>;
using PlaneFace = CGAL::Triangulation_face_base_with_info_2<FaceMark, ExactKernel,
                                                            CGAL::Constrained_triangulation_face_base_2<ExactKernel>>;
using PlaneTriangulation =
    CGAL::Constrained_triangulation_2<ExactKernel, CGAL::Triangulation_data_structure_2<PlaneVertex, PlaneFace>,
                                      CGAL::Exact_intersections_tag>;
using VertexHandle = PlaneTriangulation::Vertex_handle;
using FaceHandle = PlaneTriangulation::Face_handle;

constexpr std::int32_t no_number = -1;

// Returns the nearest double, which depends on the value only.
double nearest_double(const ExactKernel::FT& value) {
    using Rational = std::decay_t<decltype(value.exact())>;
    const Rational& exact = value.exact();
    const auto [low, high] = CGAL::to_interval(exact);
    if (low == high) return low;
    const Rational middle = (Rational(low) + Rational(high)) / 2;
    return exact > middle ? high : low;
}

class PlaneDivision {
 public:
    PlaneDivision(DistinctPoints& points, const std::vector<Triangle>& facets, std::span<const CrossedFacet> members)
        : points_(points), facets_(facets), members_(members) {
        const auto area_of = [&](const CrossedFacet& member) {
            const Corners p = corners(member.facet);
            return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm();
        };
        const CrossedFacet& largest =
            *std::max_element(members.begin(), members.end(),
                              [&](const CrossedFacet& a, const CrossedFacet& b) { return area_of(a) < area_of(b); });
        const Corners p = corners(largest.facet);
        axis_ = axis_across(p);
        plane_ = {in_frame(p[0]), in_frame(p[1]), in_frame(p[2])};
    }

    void add_constraints();
    void improve();
    void number_vertices();
    bool collect_member(std::int32_t member, std::vector<FacetPiece>& pieces, std::vector<PointOnEdge>& on_edges);
    void collect(std::vector<FacetPiece>& pieces, std::vector<PointOnEdge>& on_edges);
    double largest_rounding() const { return largest_rounding_; }

 private:
    // A corner has its number, another point the coordinates in the frame of the triangulation.
    struct Place {
        std::int32_t number = no_number;
        ExactPoint3 point = {};
    };

    const Vec3& at(std::int32_t vertex) const { return points_.all()[vertex]; }
    Corners corners(std::int32_t facet) const {
        const Triangle& t = facets_[facet];
        return {at(t[0]), at(t[1]), at(t[2])};
    }
    // Returns the point with the axis of projection last, which keeps orientations.
    ExactPoint3 in_frame(const Vec3& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3], p[axis_]}; }

    static ExactPoint2 projected(const ExactPoint3& p) { return {p.x(), p.y()}; }

    VertexHandle insert(std::int32_t vertex);
    VertexHandle insert(const Place& place) {
        return place.number != no_number ? insert(place.number) : insert(projected(place.point));
    }
    VertexHandle insert(const ExactPoint2& p) {
        return last_ = triangulation_.insert(p, last_ == VertexHandle() ? FaceHandle() : last_->face());
    }
    void constrain(VertexHandle a, VertexHandle b) {
        if (a != b) triangulation_.insert_constraint(a, b);
    }
    void add_contact(std::int32_t facet, std::int32_t other);
    void add_places(std::int32_t of, std::int32_t on, const std::array<int, 3>& side, std::vector<Place>& places) const;
    bool is_flippable(FaceHandle face, int i) const;
    bool is_better_flipped(FaceHandle face, int i) const;
    void flip(FaceHandle face, int i);
    std::vector<PlaneTriangulation::Edge> edges();
    std::int32_t rounded(const ExactPoint2& p);
    bool bound(std::int32_t member, VertexHandle from, VertexHandle to, std::vector<FaceHandle>& inner,
               std::vector<PointOnEdge>& on_edges);

    DistinctPoints& points_;
    const std::vector<Triangle>& facets_;
    std::span<const CrossedFacet> members_;
    int axis_;
    ExactKernel::Plane_3 plane_ = {};  // of the largest facet, in the frame
    double largest_rounding_ = 0;
    PlaneTriangulation triangulation_;
    VertexHandle last_ = {};  // the vertex inserted last, near which the next one is looked for
    std::unordered_map<std::int32_t, VertexHandle> vertex_of_;  // only looked up
};

VertexHandle PlaneDivision::insert(std::int32_t vertex) {
    const auto [known, is_new] = vertex_of_.try_emplace(vertex);
    if (!is_new) return known->second;
    const VertexHandle v = insert(ExactPoint2(at(vertex)[(axis_ + 1) % 3], at(vertex)[(axis_ + 2) % 3]));
    v->info().value = vertex;
    return known->second = v;
}

void PlaneDivision::add_constraints() {
    for (const CrossedFacet& member : members_)
        for (const std::int32_t v : facets_[member.facet]) insert(v);
    for (const CrossedFacet& member : members_) {
        const Triangle& t = facets_[member.facet];
        for (int i = 0; i < 3; ++i) constrain(insert(t[i]), insert(t[(i + 1) % 3]));
    }
    for (const CrossedFacet& member : members_)
        for (const std::int32_t other : member.others) add_contact(member.facet, other);
}

std::array<int, 3> sides_of_plane(const Corners& plane, const Corners& of) {
    std::array<int, 3> side;
    for (int i = 0; i < 3; ++i) side[i] = orientation(plane[0], plane[1], plane[2], of[i]);
    return side;
}

void PlaneDivision::add_contact(std::int32_t facet, std::int32_t other) {
    const Corners p = corners(facet), q = corners(other);
    const std::array<int, 3> side_q = sides_of_plane(p, q);
    if (std::all_of(side_q.begin(), side_q.end(), [](int side) { return side == 0; })) {  // they touch in a line
        for (const std::int32_t v : facets_[other])
            if (has_point(p, axis_, at(v))) insert(v);
        return;
    }
    std::vector<Place> places;
    add_places(other, facet, side_q, places);
    add_places(facet, other, sides_of_plane(q, p), places);
    if (places.empty()) return;
    const auto point_of = [&](const Place& place) {
        return place.number != no_number ? in_frame(at(place.number)) : place.point;
    };
    const auto is_less = [&](const Place& a, const Place& b) {
        if (a.number != no_number && a.number == b.number) return false;
        return CGAL::compare_xyz(point_of(a), point_of(b)) == CGAL::SMALLER;
    };
    const auto [first, last] = std::minmax_element(places.begin(), places.end(), is_less);
    constrain(insert(*first), insert(*last));
}

// Corners of `of` that lie in the plane of `on`, and points in which its edges go through that plane, if they are in
// the facet. `side`: of the corners.
void PlaneDivision::add_places(std::int32_t of, std::int32_t on, const std::array<int, 3>& side,
                               std::vector<Place>& places) const {
    const Triangle& t = facets_[of];
    const Corners facet = corners(on);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (side[i] == 0 && has_point(facet, axis_across(facet), at(t[i]))) places.push_back({t[i]});
        if (side[i] * side[j] >= 0) continue;
        const auto [from, to] = std::minmax(t[i], t[j]);
        std::array<int, 3> pass;
        for (int k = 0; k < 3; ++k) pass[k] = orientation(at(from), at(to), facet[k], facet[(k + 1) % 3]);
        const auto [low, high] = std::minmax_element(pass.begin(), pass.end());
        if (*low < 0 && *high > 0) continue;
        places.push_back({no_number, ExactKernel().construct_plane_line_intersection_point_3_object()(
                                         in_frame(facet[0]), in_frame(facet[1]), in_frame(facet[2]), in_frame(at(from)),
                                         in_frame(at(to)))});
    }
}

std::int32_t PlaneDivision::rounded(const ExactPoint2& p) {
    const ExactKernel::FT height = -(plane_.a() * p.x() + plane_.b() * p.y() + plane_.d()) / plane_.c();
    const std::array<ExactKernel::FT, 3> exact = {p.x(), p.y(), height};
    Vec3 place;
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        const double x = nearest_double(exact[i]);
        place[(axis_ + 1 + i) % 3] = x;
        const double off = CGAL::to_double(exact[i] - x);
        square += off * off;
    }
    largest_rounding_ = std::max(largest_rounding_, std::sqrt(square));
    return points_.number_of(place);
}

void PlaneDivision::number_vertices() {
    for (const VertexHandle v : triangulation_.finite_vertex_handles())
        if (v->info().value == no_number) v->info().value = rounded(v->point());
}

// Cotangents of the angles opposite to the edge, which are less than 0 together where both are more than flat.
bool PlaneDivision::is_better_flipped(FaceHandle face, int i) const {
    const FaceHandle beyond = face->neighbor(i);
    const int j = triangulation_.mirror_index(face, i);
    const Vec3 &a = at(face->vertex(i)->info().value), &c = at(beyond->vertex(j)->info().value);
    const Vec3 &b = at(face->vertex(triangulation_.cw(i))->info().value),
               &d = at(face->vertex(triangulation_.ccw(i))->info().value);
    const auto cotangent = [&](const Vec3& tip) {
        const Vec3 u = b - tip, v = d - tip;
        return u.dot(v) / u.cross(v).norm();
    };
    constexpr double least_gain = 1e-9;
    return cotangent(a) + cotangent(c) < -least_gain;
}

bool PlaneDivision::is_flippable(FaceHandle face, int i) const {
    const FaceHandle beyond = face->neighbor(i);
    if (triangulation_.is_infinite(face) || triangulation_.is_infinite(beyond) || face->is_constrained(i)) return false;
    const auto &a = face->vertex(i)->point(), &c = triangulation_.mirror_vertex(face, i)->point();
    const auto &b = face->vertex(triangulation_.cw(i))->point(), &d = face->vertex(triangulation_.ccw(i))->point();
    // face: a d b, beyond: c b d
    return triangulation_.orientation(a, d, c) == CGAL::LEFT_TURN &&
           triangulation_.orientation(c, b, a) == CGAL::LEFT_TURN;
}

void PlaneDivision::flip(FaceHandle face, int i) {
    const FaceHandle beyond = face->neighbor(i);
    std::array<std::pair<FaceHandle, int>, 4> around;
    std::array<bool, 4> constrained;
    int count = 0;
    for (const FaceHandle f : {face, beyond})
        for (int k = 0; k < 3; ++k) {
            if (f->neighbor(k) == (f == face ? beyond : face)) continue;
            around[count] = {f->neighbor(k), triangulation_.mirror_index(f, k)};
            constrained[count++] = f->is_constrained(k);
        }
    triangulation_.tds().flip(face, i);
    face->set_constraint(face->index(beyond), false);
    beyond->set_constraint(beyond->index(face), false);
    for (int k = 0; k < count; ++k) {
        const auto [outer, side] = around[k];
        outer->neighbor(side)->set_constraint(triangulation_.mirror_index(outer, side), constrained[k]);
    }
}

// Each once, by the face that was made first: CGAL's own list takes that with the smaller address.
std::vector<PlaneTriangulation::Edge> PlaneDivision::edges() {
    std::int32_t count = 0;
    for (const FaceHandle face : triangulation_.all_face_handles()) face->info().place = count++;
    std::vector<PlaneTriangulation::Edge> edges;
    for (const FaceHandle face : triangulation_.all_face_handles())
        for (int i = 0; i < 3; ++i)
            if (face->info().place < face->neighbor(i)->info().place && !triangulation_.is_infinite(face, i))
                edges.emplace_back(face, i);
    return edges;
}

// Towards the constrained Delaunay triangulation of the rounded points, by flips that are exact.
void PlaneDivision::improve() {
    std::vector<PlaneTriangulation::Edge> open = edges();
    for (std::size_t left = 20 * open.size(); !open.empty() && left > 0; --left) {
        const auto [face, i] = open.back();
        open.pop_back();
        if (!is_flippable(face, i) || !is_better_flipped(face, i)) continue;
        const FaceHandle beyond = face->neighbor(i);
        flip(face, i);
        for (const FaceHandle f : {face, beyond})
            for (int k = 0; k < 3; ++k) open.emplace_back(f, k);
    }
}

// Marks the edges between two corners, and has the faces on the left of them in `inner`. False if there are none.
bool PlaneDivision::bound(std::int32_t member, VertexHandle from, VertexHandle to, std::vector<FaceHandle>& inner,
                          std::vector<PointOnEdge>& on_edges) {
    const UndirectedEdge edge = undirected(from->info().value, to->info().value);
    while (from != to) {
        VertexHandle next;
        FaceHandle right;
        int i = 0;
        if (!triangulation_.includes_edge(from, to, next, right, i)) return false;
        const FaceHandle left = right->neighbor(i);
        left->info().bounds[triangulation_.mirror_index(right, i)] = member;
        inner.push_back(left);
        from = next;
        const std::int32_t v = from->info().value;
        if (v != edge[0] && v != edge[1])
            on_edges.push_back({edge, (at(v) - at(edge[0])).norm(), v, members_[member].facet});
    }
    return true;
}

// A facet without area in the projection has no pieces: its edges are those of others.
bool PlaneDivision::collect_member(std::int32_t member, std::vector<FacetPiece>& pieces,
                                   std::vector<PointOnEdge>& on_edges) {
    const std::int32_t facet = members_[member].facet;
    Triangle t = facets_[facet];
    const Corners p = corners(facet);
    const int turn = projected_orientation(axis_, p[0], p[1], p[2]);
    if (turn == 0) return true;
    if (turn < 0) std::swap(t[1], t[2]);
    std::vector<FaceHandle> open;
    for (int i = 0; i < 3; ++i)
        if (!bound(member, vertex_of_[t[i]], vertex_of_[t[(i + 1) % 3]], open, on_edges)) return false;
    while (!open.empty()) {
        const FaceHandle face = open.back();
        open.pop_back();
        if (triangulation_.is_infinite(face)) return false;
        FaceMark& mark = face->info();
        if (std::exchange(mark.seen, member) == member) continue;
        for (int i = 0; i < 3; ++i)
            if (mark.bounds[i] != member) open.push_back(face->neighbor(i));
        Triangle piece = {face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value};
        if (turn < 0) std::swap(piece[1], piece[2]);
        pieces.push_back({facet, piece});
    }
    return true;
}

// Collects the pieces of all facets. Where corners fall upon each other in the projection, so that edges are not found,
// a facet stays whole in this round.
void PlaneDivision::collect(std::vector<FacetPiece>& pieces, std::vector<PointOnEdge>& on_edges) {
    for (std::int32_t m = 0; m < count_of(members_); ++m) {
        const std::size_t piece_count = pieces.size(), point_count = on_edges.size();
        if (collect_member(m, pieces, on_edges)) continue;
        pieces.resize(piece_count);
        on_edges.resize(point_count);
        pieces.push_back({members_[m].facet, facets_[members_[m].facet]});
    }
}

}  // namespace

void FacetDivider::divide(std::span<const CrossedFacet> facets_of_plane, std::vector<FacetPiece>& pieces,
                          std::vector<PointOnEdge>& on_edges) {
    PlaneDivision division(points_, facets_, facets_of_plane);
    division.add_constraints();
    division.number_vertices();
    division.improve();
    division.collect(pieces, on_edges);
    largest_rounding_ = std::max(largest_rounding_, division.largest_rounding());
}

}  // namespace kerf
