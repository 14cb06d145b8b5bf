// Distributions of quality as JSON: those of a run's report, and of kerf quality --json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "files/quality/inside/measured_mesh.h"

namespace kerf {

/// Returns an object of the measures by name, each with min, p0_1, p1, p5, median, p95, max and a histogram of 36 bins;
/// null stands for infinite numbers.
nlohmann::ordered_json quality_json(const QualityDistributions& quality);

/// Returns an object with all, interface and interior: each an object of measures.
nlohmann::ordered_json quality_json(const PartQuality& quality);

/// Returns the number of cells that the surface forces, with the smallest dihedral angles of these and of the other
/// cells, each as a measure in quality_json().
nlohmann::ordered_json forced_json(const ForcedDistributions& angles);

/// Returns name, counts, the number of turned tetrahedra, notes, the quality of cells, which are forced, and the angles
/// of boundary triangles; for several regions a list of them with name, cells, volume, and the measures without
/// histograms.
nlohmann::ordered_json quality_json(const MeshQuality& quality);

}  // namespace kerf
