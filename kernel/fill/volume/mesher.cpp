// Checks the options and hands the surface to the mesher that they name.
#include "fill/volume/mesher.h"

#include <algorithm>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/core/stopwatch.h"
#include "base/geometry/tetrahedron.h"
#include "fill/volume/meshers.h"

namespace kerf {

void check_mesher_options(const MesherChoices& options) {
    require_in(radius_edge_range, "radius-edge", options.radius_edge);
    find_mesher(options.name).check(MesherOptions(options));
}

namespace {

bool has_cell_without_volume(const TetMesh& mesh) {
    const std::vector<Vec3>& p = mesh.vertices;
    return !std::all_of(mesh.tets.begin(), mesh.tets.end(), [&](const Tetrahedron& tet) {
        return has_volume_in_any_order(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
    });
}

// Replaces cells without volume. A cell that is not inverted may be so thin that it has no volume as doubles have it:
// behind two facets in one plane, for instance, whose corners are rounded. Programs that compute with it divide by
// zero, so others are put in its place, also where cells are not to be improved. Where nothing else helps, those around
// it change, too.
void replace_cells_without_volume(Filling& filling, const MesherOptions& options) {
    for (const double threshold_deg : {0.001, 1.0, ImproveOptions().threshold_deg}) {
        if (!has_cell_without_volume(filling.mesh)) return;
        const Improvement again = timed(filling.improve_seconds, [&] {
            return improve(
                filling.mesh,
                {.threshold_deg = threshold_deg, .max_size = options.size, .frozen_cells = filling.core_tets});
        });
        filling.improvement.add_operations(again);
    }
}

}  // namespace

void improve_filling(Filling& filling, const MesherOptions& options, double threshold_deg) {
    if (!options.improve || !options.tetgen.switches.empty()) return;
    filling.improvement.add(timed(filling.improve_seconds, [&] {
        return improve(filling.mesh, {.threshold_deg = threshold_deg,
                                      .max_size = options.size,
                                      .adds_vertices = options.radius_edge > 0 || !options.size.is_empty()});
    }));
}

Filling mesh_volume(const SurfaceArrays& surface, const MesherOptions& options) {
    KERF_CHECK(is_well_formed(surface) && !surface.facets.empty());
    check_mesher_options(options);
    Filling filling = find_mesher(options.name).fill(surface, options);
    replace_cells_without_volume(filling, options);
    return filling;
}

}  // namespace kerf
