// Distributions of quality as JSON: those of a run's report, and of kerf quality --json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "quality/measured_mesh.h"

namespace kerf {

/// An object of the measures by name, each with min, p0_1, p1, p5, median, p95, max and a histogram of 36 bins; null
/// for what is infinite.
nlohmann::ordered_json quality_json(const QualityDistributions& quality);

/// all, interface, interior: each as above.
nlohmann::ordered_json quality_json(const PartQuality& quality);

/// The number of cells that the surface forces, with their smallest dihedral angles and those of the others: each as a
/// measure above.
nlohmann::ordered_json forced_json(const ForcedDistributions& angles);

/// Name, counts, the number of turned tetrahedra, notes, the quality of cells, which are forced, and the angles of
/// boundary triangles. Of several regions a list of them: name, cells, volume, and the measures without histograms.
nlohmann::ordered_json quality_json(const MeshQuality& quality);

}  // namespace kerf
