// Checks the options and hands the surface to the mesher that they name.
#include "volume/mesher.h"

#include "core/check.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "volume/meshers.h"

namespace kerf {

void check_mesher_options(const MesherOptions& options) {
    require_in(radius_edge_range, "radius-edge", options.radius_edge);
    find_mesher(options.name).check(options);
}

void improve_filling(Filling& filling, const MesherOptions& options, double threshold_deg) {
    if (!options.improve || !options.tetgen.switches.empty()) return;
    const Stopwatch stopwatch;
    filling.improvement.add(
        improve(filling.mesh, {.threshold_deg = threshold_deg,
                               .max_size = options.size,
                               .adds_vertices = options.radius_edge > 0 || !options.size.is_empty()}));
    filling.improve_seconds += stopwatch.seconds();
}

Filling mesh_volume(const SurfaceArrays& surface, const MesherOptions& options) {
    KERF_CHECK(is_well_formed(surface) && !surface.facets.empty());
    check_mesher_options(options);
    return find_mesher(options.name).fill(surface, options);
}

}  // namespace kerf
