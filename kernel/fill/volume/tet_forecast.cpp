// Beside a coarse facet lie small cells: its neighbourhood is as large as the cube of its edge, and ends in the middle
// of the body. Beside a fine facet cells grow to the wanted size, in a number of layers like the logarithm of the
// depth; there needles need more cells than other facets.
#include "fill/volume/tet_forecast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry/triangle.h"
#include "fill/volume/meshers.h"

namespace kerf {

namespace {

constexpr double least_ratio = 0.25, steps_per_octave = 2;  // places of MesherForecast::tets_by_edge_ratio
// Fitted to 12 surfaces of well-shaped facets with 8 sizes each, and to 8 others.
constexpr double coarse_ratio = 0.5, reach_of_coarse = 2.45;  // ratio of edges, and a length in edges
constexpr double growing_octaves = 3, tets_by_depth = 0.43, usual_depth = 2.1, least_by_depth = -0.9;
constexpr double usual_slenderness = 1.06, largest_slenderness = 1.6, power_of_slenderness = 1.5;

double tets_by_edge_ratio(const MesherForecast& known, double ratio) {
    const auto& tets = known.tets_by_edge_ratio;
    if (ratio <= least_ratio) return tets.front() * std::pow(least_ratio / ratio, 3);
    const double place = steps_per_octave * std::log2(ratio / least_ratio);
    if (!(place < static_cast<double>(tets.size() - 1))) return tets.back();
    const auto i = static_cast<std::size_t>(place);
    return std::lerp(tets[i], tets[i + 1], place - static_cast<double>(i));
}

}  // namespace

FacetShape shape_of_facet(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {std::sqrt(4 / std::numbers::sqrt3 * triangle_area(a, b, c)),
            std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()})};
}

double tets_at_facet(const FacetShape& facet, double size, double half_thickness, const MesherOptions& mesher) {
    const MesherForecast& known = find_mesher(mesher.name).forecast;
    if (!(facet.edge > 0)) return known.tets_by_edge_ratio.back();
    const double ratio = size / facet.edge, depth = half_thickness / facet.edge;
    const double usual = tets_by_edge_ratio(known, ratio);
    if (ratio < coarse_ratio) return usual * std::min(1.0, reach_of_coarse * depth);
    const double growing = std::clamp(std::log2(ratio) / growing_octaves, 0.0, 1.0);
    const double by_depth = std::max(least_by_depth, tets_by_depth * std::log(depth / usual_depth));
    const double slenderness = std::clamp(facet.longest / facet.edge / usual_slenderness, 1.0, largest_slenderness);
    return (usual + growing * by_depth) * std::lerp(1.0, std::pow(slenderness, power_of_slenderness), growing);
}

double tets_at_facets(const SurfaceArrays& surface, double half_thickness, const MesherOptions& mesher,
                      CoarseFacets coarse) {
    double tets = 0;
    for (const Triangle& t : surface.facets) {
        const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
        const double size = mesher.size.at((a + b + c) / 3);
        const FacetShape facet = shape_of_facet(a, b, c);
        const double parts = coarse == CoarseFacets::divided ? std::max(1.0, facet.edge / size) : 1;
        const FacetShape part = {facet.edge / parts, facet.longest / parts};
        tets += parts * parts * tets_at_facet(part, size, half_thickness, mesher);
    }
    return tets;
}

double tets_inside(double sized_volume, const MesherOptions& mesher) {
    if (mesher.size.is_empty()) return 0;
    const MesherForecast& known = find_mesher(mesher.name).forecast;
    const double tets = mesher.size.is_constant() ? known.tets_per_volume_bound : known.tets_per_sized_volume;
    return tets * sized_volume / mesher.size.reference_volume();
}

}  // namespace kerf
