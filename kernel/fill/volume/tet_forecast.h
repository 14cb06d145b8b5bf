// The number of tetrahedra that a mesher will make, forecast from the surface that it is given.
#pragma once

#include "fill/volume/mesher.h"
#include "surface/complex/surface.h"

namespace kerf {

/// The lengths of a facet that a forecast uses.
struct FacetShape {
    double edge = 0;     ///< edge of an equilateral facet of the same area
    double longest = 0;  ///< longest of its own edges
};
FacetShape shape_of_facet(const Vec3& a, const Vec3& b, const Vec3& c);

/// Returns the number of tetrahedra for one facet, beside those that the volume asks for. `size`: the edge that is
/// wanted there, or infinity; `half_thickness`: volume over area of the body.
double tets_at_facet(const FacetShape& facet, double size, double half_thickness, const MesherOptions& mesher);

/// The treatment of facets that are coarser than sizes.
enum class CoarseFacets { kept, divided };

/// Returns the sum of tets_at_facet() over the facets of a surface. O(#F) where the size is constant, else with a query
/// of the field for each.
double tets_at_facets(const SurfaceArrays& surface, double half_thickness, const MesherOptions& mesher,
                      CoarseFacets coarse = CoarseFacets::kept);

/// Returns the number of tetrahedra that the volume asks for, by the sized volume (surface/size/volume_samples.h); 0
/// where no size is wanted.
double tets_inside(double sized_volume, const MesherOptions& mesher);

}  // namespace kerf
