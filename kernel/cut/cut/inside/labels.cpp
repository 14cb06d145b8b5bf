// Nodes of the graph are the facets of the band; the source is the half below, the sink the half above. A facet outside
// of the band is part of its terminal, so an edge to it becomes a terminal edge.
#include "cut/cut/inside/labels.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/max_flow.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

constexpr std::int64_t steps_per_facet = 2000;  // of the flow; well-shaped surfaces need fewer than 100

struct FacetTerms {
    double area = 0;
    double slope = 0;     // |n_z|^4
    double distance = 0;  // of the centroid
};

FacetTerms facet_terms(const Surface& surface, const Band& band, Facet facet) {
    const auto t = surface.corners(facet);
    const Vec3 cross = doubled_area_vector(surface.point(t[0]), surface.point(t[1]), surface.point(t[2]));
    const double norm = cross.norm();
    const double n_z = norm > 0 ? cross.dot(band.plane.normal) / norm : 1;
    return {norm / 2, n_z * n_z * n_z * n_z, band.facet_distance(surface, facet)};
}

}  // namespace

bool minimum_cut_labels(const Surface& surface, const Band& band, const std::vector<double>& penalty,
                        Array<Facet, Side>& side, std::int64_t& step_budget) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    KERF_CHECK(penalty.size() == band.facets.size());
    KERF_CHECK(std::all_of(penalty.begin(), penalty.end(), [](double p) { return p >= 1; }));
    const std::int32_t count = count_of(band.facets);
    const double h = band.edge_length;
    if (h == 0) return true;  // the plane crosses no edge: there is no contour to be made shorter
    std::vector<FacetTerms> terms(count);
    for (std::int32_t i = 0; i < count; ++i) terms[i] = facet_terms(surface, band, band.facets[i]);

    MaxFlow flow(count);
    for (std::int32_t i = 0; i < count; ++i) {
        const double wrong_side = terms[i].area * std::abs(terms[i].distance) / (h * h);
        flow.add_terminal(i, terms[i].distance < 0 ? wrong_side : 0, terms[i].distance < 0 ? 0 : wrong_side);
        for (const HalfEdge half_edge : band.half_edges[i]) {
            const Facet neighbour = surface.facet_of(Surface::opposite(half_edge));
            const std::int32_t j = band.index_of[neighbour];
            if (j >= 0 && j < i) continue;  // the edge was added with its other facet
            const Vertex a = surface.from_vertex(half_edge), b = surface.to_vertex(half_edge);
            const double deviation = std::max(std::abs(band.distance[a]), std::abs(band.distance[b])) / h;
            const double slope = j >= 0 ? std::max(terms[i].slope, terms[j].slope) : terms[i].slope;
            const double raised = j >= 0 ? std::max(penalty[i], penalty[j]) : penalty[i];
            const double weight =
                (surface.point(b) - surface.point(a)).norm() * (1 + deviation * deviation) * (1 + 3 * slope) * raised;
            if (j >= 0)
                flow.add_edge(i, j, weight);
            else
                flow.add_terminal(i, side[neighbour] == Side::below ? weight : 0,
                                  side[neighbour] == Side::below ? 0 : weight);
        }
    }
    const bool solved = flow.solve(std::min(step_budget, steps_per_facet * count));
    step_budget -= flow.steps();
    if (!solved) return false;
    for (std::int32_t i = 0; i < count; ++i) side[band.facets[i]] = flow.on_sink_side(i) ? Side::above : Side::below;
    return true;
}

}  // namespace kerf
