// The area of the section is the sum over crossing facets of the signed triangles that their cut line forms with the
// plane's origin: no loops have to be traced. Terms are computed on threads and summed in order (ordered_terms.h), so
// that the last bits do not depend on threads.
#include "cut/cut/inside/band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "cut/cut/inside/ordered_terms.h"

namespace kerf {

namespace {

constexpr double width = 3;  // of the band on either side, in crossing edges
constexpr double slab_width =
    6;  // of the slab: contours may run far from the plane, interfaces between them even further

bool crosses(double d_from, double d_to) { return (d_from < 0) != (d_to < 0); }

Array<Vertex, double> vertex_distances(const Surface& surface, const Plane& plane) {
    Array<Vertex, double> distance(surface.vertex_count());
    for_ranges_on_threads(distance.size(), items_of_thread, [&](const IndexRange& range) {
        for (const Vertex v : IdRange(Vertex(range.first), Vertex(range.last)))
            distance[v] = plane.distance(surface.point(v));
    });
    return distance;
}

double mean_crossing_length(const Surface& surface, const Array<Vertex, double>& distance) {
    const std::vector<double> lengths =
        selected_on_threads<double>(surface.edge_count(), [&](std::size_t edge, std::vector<double>& selected) {
            const HalfEdge h = Surface::first_half_edge(Edge(edge));
            const Vertex a = surface.from_vertex(h), b = surface.to_vertex(h);
            if (crosses(distance[a], distance[b])) selected.push_back((surface.point(b) - surface.point(a)).norm());
        });
    double sum = 0;
    for (const double length : lengths) sum += length;
    return lengths.empty() ? 0 : sum / static_cast<double>(lengths.size());
}

// Lifting a point and projecting it again are each a few sums of products of coordinates.
double rounding_of(const Surface& surface, const Plane& plane) {
    const double largest = bounds_on_threads(surface.vertex_count(), [&](std::size_t v) {
                               return surface.point(Vertex(v)).cwiseAbs().maxCoeff();
                           }).second;
    return 64 * std::numeric_limits<double>::epsilon() * std::max(largest, plane.origin.cwiseAbs().maxCoeff());
}

// The body lies on the left of the cut line seen from above: it enters the facet where the boundary passes downwards.
double section_triangle(const Surface& surface, const Band& band, const std::array<HalfEdge, 3>& half_edges) {
    Vec2 in = Vec2::Zero(), out = Vec2::Zero();
    for (const HalfEdge h : half_edges) {
        const Vertex a = surface.from_vertex(h), b = surface.to_vertex(h);
        const double da = band.distance[a], db = band.distance[b];
        if (!crosses(da, db)) continue;
        const Vec2 q =
            (da * band.plane.project(surface.point(b)) - db * band.plane.project(surface.point(a))) / (da - db);
        (da < 0 ? out : in) = q;
    }
    return (in.x() * out.y() - in.y() * out.x()) / 2;
}

// A facet of the slab, and whether it belongs to the band.
struct SlabItem {
    SlabFacet reach;
    bool in_band;
};

// The slab and its band; fills the labels of all facets.
std::vector<SlabItem> find_slab(const Surface& surface, Band& band) {
    band.majority.resize(surface.facet_count());
    return selected_on_threads<SlabItem>(band.majority.size(), [&](std::size_t index, std::vector<SlabItem>& slab) {
        const Facet f(index);
        double low = INFINITY, high = -INFINITY, sum = 0;
        int above = 0;
        for (const HalfEdge h : surface.half_edges(f)) {
            const double d = band.distance[surface.to_vertex(h)];
            low = std::min(low, d);
            high = std::max(high, d);
            sum += d;
            above += d >= 0;
        }
        band.majority[f] = above >= 2 ? Side::above : Side::below;
        if (low > band.slab_half_width || high < -band.slab_half_width) return;
        const bool meets_plane = low <= 0 && high >= 0;
        const bool in_band = meets_plane || std::abs(sum) < 3 * width * band.edge_length;
        slab.push_back({{f, low, high}, in_band});
    });
}

void add_facet(const Surface& surface, const SlabFacet& facet, Band& band) {
    const auto half_edges = surface.half_edges(facet.facet);
    band.index_of[facet.facet] = count_of(band.facets);
    band.facets.push_back(facet.facet);
    band.half_edges.push_back(half_edges);
    for (const Vertex v : surface.corners(facet.facet))
        if (band.vertex_index_of[v] < 0) {
            band.vertex_index_of[v] = count_of(band.vertices);
            band.vertices.push_back(v);
        }
    if (facet.low < 0 && facet.high >= 0) band.section_area += section_triangle(surface, band, half_edges);
}

}  // namespace

Band make_band(const Surface& surface, const Plane& plane) {
    KERF_CHECK(plane.is_orthonormal() && surface.facet_count() > 0);
    Band band;
    band.plane = plane;
    band.rounding = rounding_of(surface, plane);
    band.distance = vertex_distances(surface, plane);
    band.edge_length = mean_crossing_length(surface, band.distance);
    band.half_width = width * band.edge_length;
    band.slab_half_width = slab_width * band.edge_length;
    band.index_of.assign(surface.facet_count(), -1);
    band.vertex_index_of.assign(surface.vertex_count(), -1);
    for (const SlabItem& item : find_slab(surface, band)) {
        band.slab.push_back(item.reach);
        if (item.in_band) add_facet(surface, item.reach, band);
    }
    return band;
}

double crossing_edge_length(const Surface& surface, const Plane& plane) {
    return mean_crossing_length(surface, vertex_distances(surface, plane));
}

std::vector<SurfaceEdge> crossed_edges(const Surface& surface, const Band& band) {
    std::vector<SurfaceEdge> edges;
    for (const auto& half_edges : band.half_edges)
        for (const HalfEdge h : half_edges) {
            const SurfaceEdge edge = {surface.from_vertex(h), surface.to_vertex(h)};
            if (band.distance[edge[0]] < 0 && band.distance[edge[1]] >= 0) edges.push_back(edge);
        }
    return edges;
}

}  // namespace kerf
