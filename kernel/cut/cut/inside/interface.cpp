// The section inside of the contour is triangulated in the plane, either over the contour as it projects or over one
// whose steps down steep walls are unfolded (contour_layout.h), and then lifted by harmonic heights (lift.h) within the
// ranges that leave good angles at the contour (dihedral_ranges.h). Points inside of an unfolded contour are moved back
// with it by harmonic displacements. Obstacles are the vertices of the surface near the plane that do not touch the
// contour: tips and pockets that poke through the section without changing a label. The interface must pass them at a
// distance, and the nearest ones become points of it, above or below themselves.
#include "cut/cut/inside/interface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/triangle.h"
#include "cut/cut/inside/contour_layout.h"
#include "cut/cut/inside/dihedral_ranges.h"
#include "cut/cut/inside/lift.h"
#include "cut/cut/triangulation.h"

namespace kerf {

namespace {

constexpr double obstacle_depth = 2.5;  // vertices further from the plane are no obstacles, in local edges
constexpr double wanted_depth = 1.2;    // nearer ones become vertices of the interface below or above them
constexpr double clearance = 0.6;       // of the interface from an obstacle, in local edges
constexpr double clearance_per_hit = 0.1;
constexpr double dihedral_margin = 3;   // degrees above what is good enough
constexpr double hit_clearance = 0.35;  // of vertices beside the contour, once they were hit

struct VertexRing {
    double mean_edge = 0;
    bool touches_contour = false;
};

// `on_contour`: per vertex of the band.
VertexRing ring_of(const Surface& surface, const Band& band, std::int32_t vertex, const std::vector<char>& on_contour) {
    VertexRing ring;
    int count = 0;
    for (const auto h : surface.around(vertex)) {
        const std::int32_t neighbour = h.to().idx();
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

std::vector<Obstacle> find_obstacles(const Surface& surface, const Band& band, const std::vector<Side>& side,
                                     const std::vector<char>& on_contour, const std::vector<std::int32_t>& hits) {
    std::vector<Obstacle> obstacles;
    std::vector<char> seen = on_contour;
    for (std::size_t i = 0; i < band.facets.size(); ++i)
        for (std::int32_t v : surface.vertices(band.facets[i])) {
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

bool is_closed_path(const Surface& surface, const std::vector<std::int32_t>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i)
        if (surface.find_half_edge(loop[i], loop[(i + 1) % loop.size()]) < 0) return false;
    return loop.size() >= 3;
}

}  // namespace

InterfaceAttempt build_interface(const Surface& surface, const Band& band, const std::vector<Side>& side,
                                 const std::vector<std::vector<std::int32_t>>& loops,
                                 const std::vector<std::int32_t>& hits, const CutOptions& options,
                                 ContourLayout layout) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    KERF_CHECK(hits.size() == band.vertices.size());
    KERF_CHECK(
        std::all_of(loops.begin(), loops.end(), [&](const auto& loop) { return is_closed_path(surface, loop); }));
    InterfaceAttempt attempt;
    std::vector<std::int32_t>& contour = attempt.interface.contour;
    std::vector<double> contour_height;
    std::vector<char> on_contour(band.vertices.size(), 0);
    for (const auto& loop : loops) contour.insert(contour.end(), loop.begin(), loop.end());
    for (const std::int32_t v : contour) {
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
    if (!options.size.is_empty())
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
