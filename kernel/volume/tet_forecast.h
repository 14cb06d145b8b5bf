// How many tetrahedra a mesher will make, told from the surface that it is given.
#pragma once

#include "surface/surface.h"
#include "volume/mesher.h"

namespace kerf {

/// Those for one facet, beside those that the volume asks for; `size`: the edge that is wanted there, or infinity.
double tets_at_facet(double area, double size, const MesherOptions& mesher);

/// The sum over the facets of a surface. O(#F) where the size is constant, else with a query of the field for each.
double tets_at_facets(const SurfaceArrays& surface, const MesherOptions& mesher);

/// Those that the volume asks for, told from the sized volume (size/volume_samples.h); 0 where no size is wanted.
double tets_inside(double sized_volume, const MesherOptions& mesher);

}  // namespace kerf
