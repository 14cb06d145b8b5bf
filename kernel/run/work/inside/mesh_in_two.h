// A part that the mesher does not fill as a whole: its halves are filled, and joined again.
#pragma once

#include "fill/mesh/tet_mesh.h"
#include "fill/volume/mesher.h"
#include "surface/complex/surface.h"

namespace kerf {

/// Fills a surface as mesh_volume(), by a cut of it: both halves are filled, improved and joined at the interface,
/// whose vertices become interior ones. The boundary keeps every facet, so the neighbours of the part do not notice.
/// Throws Error(subdomain) if the surface has no contour of edges near its middle, or if a half is not filled either.
/// Deterministic.
Filling mesh_in_two(const SurfaceArrays& surface, const MesherOptions& options);

}  // namespace kerf
