// The area of the section is the sum over crossing facets of the signed triangles that their cut line forms with the
// plane's origin: no loops have to be traced.
#include "cut/band.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/check.h"

namespace kerf {

namespace {

constexpr double width = 3;  // of the band on either side, in crossing edges

bool crosses(double d_from, double d_to) { return (d_from < 0) != (d_to < 0); }

std::vector<double> vertex_distances(const Surface& surface, const Plane& plane) {
    std::vector<double> distance(surface.vertex_count());
    for (std::int32_t v = 0; v < surface.vertex_count(); ++v) distance[v] = plane.distance(surface.point(v));
    return distance;
}

double mean_crossing_length(const Surface& surface, const std::vector<double>& distance) {
    double sum = 0;
    std::int64_t count = 0;
    for (std::int32_t h = 0; h < 2 * static_cast<std::int32_t>(surface.mesh().n_edges()); h += 2) {
        const std::int32_t a = surface.from_vertex(h), b = surface.to_vertex(h);
        if (!crosses(distance[a], distance[b])) continue;
        sum += (surface.point(b) - surface.point(a)).norm();
        ++count;
    }
    return count ? sum / static_cast<double>(count) : 0;
}

// The body lies on the left of the cut line seen from above: it enters the facet where the boundary passes downwards.
double section_triangle(const Surface& surface, const Band& band, const std::array<std::int32_t, 3>& half_edges) {
    Vec2 in = Vec2::Zero(), out = Vec2::Zero();
    for (std::int32_t h : half_edges) {
        const std::int32_t a = surface.from_vertex(h), b = surface.to_vertex(h);
        const double da = band.distance[a], db = band.distance[b];
        if (!crosses(da, db)) continue;
        const Vec2 q =
            (da * band.plane.project(surface.point(b)) - db * band.plane.project(surface.point(a))) / (da - db);
        (da < 0 ? out : in) = q;
    }
    return (in.x() * out.y() - in.y() * out.x()) / 2;
}

}  // namespace

Band make_band(const Surface& surface, const Plane& plane) {
    KERF_CHECK(plane.is_orthonormal());
    Band band;
    band.plane = plane;
    band.distance = vertex_distances(surface, plane);
    band.edge_length = mean_crossing_length(surface, band.distance);
    band.half_width = width * band.edge_length;
    band.index_of.assign(surface.facet_count(), -1);
    for (std::int32_t f = 0; f < surface.facet_count(); ++f) {
        const auto half_edges = surface.half_edges(f);
        double low = band.distance[surface.to_vertex(half_edges[0])], high = low, sum = low;
        for (int i = 1; i < 3; ++i) {
            const double d = band.distance[surface.to_vertex(half_edges[i])];
            low = std::min(low, d);
            high = std::max(high, d);
            sum += d;
        }
        if (low > band.half_width || high < -band.half_width) continue;
        band.slab.push_back({f, low, high});
        const bool meets_plane = low <= 0 && high >= 0;
        if (!meets_plane && std::abs(sum) >= 3 * width * band.edge_length) continue;
        band.index_of[f] = static_cast<std::int32_t>(band.facets.size());
        band.facets.push_back(f);
        band.half_edges.push_back(half_edges);
        if (low < 0 && high >= 0) band.section_area += section_triangle(surface, band, half_edges);
    }
    return band;
}

double crossing_edge_length(const Surface& surface, const Plane& plane) {
    return mean_crossing_length(surface, vertex_distances(surface, plane));
}

std::vector<SurfaceEdge> crossed_edges(const Surface& surface, const Band& band) {
    std::vector<SurfaceEdge> edges;
    for (const auto& half_edges : band.half_edges)
        for (std::int32_t h : half_edges) {
            const SurfaceEdge edge = {surface.from_vertex(h), surface.to_vertex(h)};
            if (band.distance[edge[0]] < 0 && band.distance[edge[1]] >= 0) edges.push_back(edge);
        }
    return edges;
}

}  // namespace kerf
