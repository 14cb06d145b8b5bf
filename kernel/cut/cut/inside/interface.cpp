// The section inside of the contour is triangulated in the plane, either over the contour as it projects or over one
// whose steps down steep walls are unfolded (contour_layout.h), and then lifted by harmonic heights (lift.h) within the
// ranges that leave good angles at the contour (dihedral_ranges()). Points inside of an unfolded contour are moved back
// with it by harmonic displacements. Obstacles are the vertices of the surface near the plane that do not touch the
// contour: tips and pockets that poke through the section without changing a label. The interface must pass them at a
// distance, and the nearest ones become points of it, above or below themselves.
//
// Angles at the contour: seen along an edge of it, the surface leaves the edge in two directions, below and above, with
// the material between them, and the interface in a third, which its apex point sets. Notation: e along the edge, w
// across it in the sense of the plane's normal, u = w x e into the section; angles are measured from u towards w.
#include "cut/cut/inside/interface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "cut/cut/inside/contour_layout.h"
#include "cut/cut/inside/lift.h"
#include "cut/cut/planar_triangulation.h"

namespace kerf {

namespace {

constexpr double obstacle_depth = 2.5;  // vertices further from the plane are no obstacles, in local edges
constexpr double wanted_depth = 1.2;    // nearer ones become vertices of the interface below or above them
constexpr double clearance = 0.6;       // of the interface from an obstacle, in local edges
constexpr double clearance_per_hit = 0.1;
constexpr double dihedral_margin = 3;                     // degrees above what is good enough
constexpr double hit_clearance = 0.35;                    // of vertices beside the contour, once they were hit
constexpr double steepest = 75 * std::numbers::pi / 180;  // of the interface at the contour

struct VertexRing {
    double mean_edge = 0;
    bool touches_contour = false;
};

// `on_contour`: per vertex of the band.
VertexRing ring_of(const Surface& surface, const Band& band, Vertex vertex, const std::vector<char>& on_contour) {
    VertexRing ring;
    int count = 0;
    for (const HalfEdge h : surface.around(vertex)) {
        const Vertex neighbour = surface.to_vertex(h);
        ring.mean_edge += (surface.point(neighbour) - surface.point(vertex)).norm();
        const std::int32_t i = band.vertex_index_of[neighbour];
        ring.touches_contour |= i >= 0 && on_contour[i];
        ++count;
    }
    ring.mean_edge /= count;
    return ring;
}

// Returns the distance of a vertex from the plane on its own side; negative beyond the plane.
double depth(double height, Side side) { return side == Side::below ? -height : height; }

std::vector<Obstacle> find_obstacles(const Surface& surface, const Band& band, const Array<Facet, Side>& side,
                                     const std::vector<char>& on_contour, const std::vector<std::int32_t>& hits) {
    std::vector<Obstacle> obstacles;
    std::vector<char> seen = on_contour;
    for (std::size_t i = 0; i < band.facets.size(); ++i)
        for (const Vertex v : surface.corners(band.facets[i])) {
            const std::int32_t index = band.vertex_index_of[v];
            if (seen[index]) continue;
            seen[index] = 1;
            const VertexRing ring = ring_of(surface, band, v, on_contour);
            if (depth(band.distance[v], side[band.facets[i]]) >= obstacle_depth * ring.mean_edge) continue;
            if (ring.touches_contour && !hits[index])
                continue;  // its facets leave the contour at an angle that is checked
            const double wanted = (ring.touches_contour ? hit_clearance : clearance) + clearance_per_hit * hits[index];
            obstacles.push_back(
                {band.plane.project(surface.point(v)), band.distance[v], ring.mean_edge, side[band.facets[i]], wanted});
        }
    return obstacles;
}

bool is_closed_path(const Surface& surface, const std::vector<Vertex>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i)
        if (!surface.find_half_edge(loop[i], loop[(i + 1) % loop.size()]).is_valid()) return false;
    return loop.size() >= 3;
}

struct EdgeFrame {
    Vec3 origin, u, w;

    double angle(const Vec3& direction) const { return std::atan2(direction.dot(w), direction.dot(u)); }
};

EdgeFrame edge_frame(const Vec3& from, const Vec3& to, const Vec3& normal) {
    const Vec3 e = (to - from).normalized();
    const Vec3 w = (normal - normal.dot(e) * e).normalized();
    return {from, w.cross(e), w};
}

// Angles of the surface below and above; the material lies between them.
std::array<double, 2> surface_angles(const Surface& surface, const Array<Facet, Side>& side, HalfEdge half_edge,
                                     const EdgeFrame& frame, const Vec3& from, const Vec3& to) {
    std::array<double, 2> angle = {0, 0};
    for (const HalfEdge h : {half_edge, Surface::opposite(half_edge)}) {
        const Vec3& apex = surface.point(surface.to_vertex(surface.next(h)));
        angle[side[surface.facet_of(h)] == Side::above] = frame.angle(towards_apex(from, to, apex));
    }
    if (angle[0] > angle[1]) {  // one of them passes the far side of the edge
        if (angle[0] > -angle[1])
            angle[0] -= 2 * std::numbers::pi;
        else
            angle[1] += 2 * std::numbers::pi;
    }
    return angle;
}

// Returns for every point of a section's triangulation the range of heights in which its triangles at the contour form
// at least `angle_deg` with the surface on either side; unbounded for points off these triangles. Where the two sides
// enclose less than twice the angle, the range is the middle between them. `contour` are vertices of the surface, the
// first of the points; `places` (#P) are the points in the plane. O(#triangles).
std::vector<HeightRange> dihedral_ranges(const Surface& surface, const Band& band, const Array<Facet, Side>& side,
                                         const std::vector<Vertex>& contour, const std::vector<Triangle>& triangles,
                                         const std::vector<Vec2>& places, double angle_deg) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    KERF_CHECK(contour.size() <= places.size());
    const std::int32_t contour_count = count_of(contour);
    const double wanted = angle_deg * std::numbers::pi / 180;
    std::vector<HeightRange> ranges(places.size());
    for (const Triangle& t : triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3], apex = t[(i + 2) % 3];
            if (a >= contour_count || b >= contour_count || apex < contour_count) continue;
            const HalfEdge h = surface.find_half_edge(contour[a], contour[b]);
            if (!h.is_valid()) continue;  // an edge across the section
            const Vec3 &from = surface.point(contour[a]), &to = surface.point(contour[b]);
            const EdgeFrame frame = edge_frame(from, to, band.plane.normal);
            auto [low, high] = surface_angles(surface, side, h, frame, from, to);
            low += wanted;
            high -= wanted;
            if (low > high) low = high = (low + high) / 2;
            const Vec3 flat = band.plane.lift(places[apex], 0) - frame.origin;
            const auto height_at = [&](double angle) {
                return (flat.dot(frame.u) * std::tan(angle) - flat.dot(frame.w)) / band.plane.normal.dot(frame.w);
            };
            HeightRange& range = ranges[apex];
            if (low > -steepest) range.low = std::max(range.low, height_at(std::min(low, steepest)));
            if (high < steepest) range.high = std::min(range.high, height_at(std::max(high, -steepest)));
        }
    return ranges;
}

}  // namespace

InterfaceAttempt build_interface(const Surface& surface, const Band& band, const Array<Facet, Side>& side,
                                 const std::vector<std::vector<Vertex>>& loops, const std::vector<std::int32_t>& hits,
                                 const CutOptions& options, ContourLayout layout) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    KERF_CHECK(hits.size() == band.vertices.size());
    KERF_CHECK(
        std::all_of(loops.begin(), loops.end(), [&](const auto& loop) { return is_closed_path(surface, loop); }));
    InterfaceAttempt attempt;
    std::vector<Vertex>& contour = attempt.interface.contour;
    std::vector<double> contour_height;
    std::vector<char> on_contour(band.vertices.size(), 0);
    for (const auto& loop : loops) contour.insert(contour.end(), loop.begin(), loop.end());
    for (const Vertex v : contour) {
        on_contour[band.vertex_index_of[v]] = 1;
        contour_height.push_back(band.distance[v]);
    }
    ContourInPlane planar_contour = project_contour(surface, band.plane, loops);
    std::vector<Vec2> displacement = planar_contour.points;  // from the layout back to the projection
    if (layout == ContourLayout::unfolded && !unfold(surface, contour, options.good_dihedral_deg, planar_contour)) {
        attempt.refusal = Refusal::crossing_projection;
        return attempt;
    }
    for (std::size_t i = 0; i < displacement.size(); ++i) displacement[i] -= planar_contour.points[i];

    PlanarRegion region;
    if (!options.size.is_empty() && !options.has_coarse_interfaces)
        region.max_edge = [&](const Vec2& p) { return options.max_interface_edge(band.plane.lift(p, 0)); };
    region.max_points = options.max_interface_points;
    region.check_cancelled = options.check_cancelled;
    if (layout == ContourLayout::unfolded) region.sizes = sizes_in_space(surface, contour, planar_contour);
    region.contour = std::move(planar_contour.points);
    region.edges = std::move(planar_contour.edges);
    const std::vector<Obstacle> obstacles = find_obstacles(surface, band, side, on_contour, hits);
    for (const Obstacle& o : obstacles)
        if (depth(o.height, o.side) < wanted_depth * o.size) region.wanted.push_back({o.position, o.size});

    PlanarTriangulation planar = triangulate(region);
    attempt.refusal = planar.refusal;
    for (std::int32_t i : planar.failed) attempt.failed.push_back(contour[i]);
    if (attempt.refusal != Refusal::none) return attempt;

    options.check_cancelled();
    std::vector<Vec2> places = planar.points;
    if (layout == ContourLayout::unfolded) {
        const std::vector<Vec2> moved = harmonic_displacements(planar, displacement, options.check_cancelled);
        for (std::size_t i = 0; i < places.size(); ++i) places[i] += moved[i];
    }
    const std::vector<double> height =
        lift_heights(planar, places, contour_height, obstacles,
                     dihedral_ranges(surface, band, side, contour, planar.triangles, places,
                                     options.good_dihedral_deg + dihedral_margin),
                     options.check_cancelled);
    for (std::size_t i = 0; i < places.size(); ++i)
        attempt.interface.points.push_back(i < contour.size() ? surface.point(contour[i])
                                                              : band.plane.lift(places[i], height[i]));
    attempt.interface.planar = std::move(planar.points);
    attempt.interface.triangles = std::move(planar.triangles);
    return attempt;
}

double interface_area(const Interface& interface) {
    double area = 0;
    for (const Triangle& t : interface.triangles) area += triangle_area(interface.points, t);
    return area;
}

}  // namespace kerf
