#include "files/quality/quality_json.h"

#include <array>
#include <span>

#include <nlohmann/json.hpp>

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

constexpr int json_bins = 36;

Json percentiles_json(const Percentiles& percentiles) {
    constexpr std::array<const char*, quality_fractions.size()> names = {"min",    "p0_1", "p1", "p5",
                                                                         "median", "p95",  "max"};
    Json json = Json::object();
    for (std::size_t i = 0; i < names.size(); ++i) json[names[i]] = percentiles[i];
    return json;
}

Json distribution_json(const Distribution& d) {
    const Distribution::Histogram histogram = d.histogram(json_bins);
    Json json = percentiles_json(percentiles_of(d));
    json["histogram"] = {{"edges", histogram.edges}, {"counts", histogram.counts}};
    return json;
}

Json region_json(const RegionQuality& region) {
    Json measures = Json::object();
    for (std::size_t i = 0; i < region.measures.size(); ++i)
        measures[quality_measures[i].name] = percentiles_json(region.measures[i]);
    return {{"name", region.name}, {"tets", region.tets}, {"volume", region.volume}, {"quality", measures}};
}

Json distributions_json(std::span<const Measure> measures, const std::vector<Distribution>& distributions) {
    Json json = Json::object();
    for (std::size_t i = 0; i < distributions.size(); ++i) json[measures[i].name] = distribution_json(distributions[i]);
    return json;
}

}  // namespace

Json quality_json(const QualityDistributions& quality) {
    return distributions_json(quality_measures, quality.measures);
}

Json quality_json(const PartQuality& quality) {
    return {{"all", quality_json(quality.all)},
            {"interface", quality_json(quality.interface)},
            {"interior", quality_json(quality.interior)}};
}

Json forced_json(const ForcedDistributions& angles) {
    return {{"tets", angles.forced.count()},
            {"min_dihedral_deg", distribution_json(angles.forced)},
            {"others_min_dihedral_deg", distribution_json(angles.unforced)}};
}

Json quality_json(const MeshQuality& quality) {
    Json json = {{"path", quality.name},
                 {"parts", quality.parts},
                 {"vertices", quality.vertices},
                 {"tets", quality.tets()},
                 {"interface_tets", quality.cells.interface.measures.front().count()},
                 {"boundary_triangles", quality.boundary.measures.front().count()},
                 {"turned_tets", quality.turned_tets},
                 {"notes", quality.notes},
                 {"quality", quality_json(quality.cells)},
                 {"forced", forced_json(quality.cells.angles)},
                 {"boundary", distributions_json(triangle_measures, quality.boundary.measures)}};
    if (quality.curved)
        json["curved"] = {{"curved_cells", quality.curved->count},
                          {"worst_scaled_jacobian", quality.curved->worst_scaled_jacobian}};
    for (const RegionQuality& region : quality.regions) json["regions"].push_back(region_json(region));
    return json;
}

}  // namespace kerf
