#include "volume/tet_forecast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/triangle.h"
#include "volume/meshers.h"

namespace kerf {

namespace {

constexpr double least_ratio = 0.25, steps_per_octave = 2;  // of MesherForecast::tets_by_edge_ratio

// Between the entries by their logarithms' place alone; below the first of them the neighbourhood of a facet is as large
// as the cube of its edge.
double tets_by_edge_ratio(const MesherForecast& known, double ratio) {
    const auto& tets = known.tets_by_edge_ratio;
    if (ratio <= least_ratio) return tets.front() * std::pow(least_ratio / ratio, 3);
    const double place = steps_per_octave * std::log2(ratio / least_ratio);
    if (!(place < static_cast<double>(tets.size() - 1))) return tets.back();
    const auto i = static_cast<std::size_t>(place);
    return std::lerp(tets[i], tets[i + 1], place - static_cast<double>(i));
}

}  // namespace

double tets_at_facet(double area, double size, const MesherOptions& mesher) {
    const double edge = std::sqrt(4 / std::numbers::sqrt3 * area);  // of an equilateral one
    const double ratio = edge > 0 ? size / edge : std::numeric_limits<double>::infinity();
    return tets_by_edge_ratio(find_mesher(mesher.name).forecast, ratio);
}

double tets_at_facets(const SurfaceArrays& surface, const MesherOptions& mesher) {
    double tets = 0;
    for (const Triangle& t : surface.facets) {
        const std::vector<Vec3>& p = surface.vertices;
        tets += tets_at_facet(triangle_area(p, t), mesher.size.at((p[t[0]] + p[t[1]] + p[t[2]]) / 3), mesher);
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
