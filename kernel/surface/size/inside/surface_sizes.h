// The sizes that a surface asks for by its edges, its curvature, its thickness and its patches.
#pragma once

#include <vector>

#include "surface/complex/surface.h"
#include "surface/size/inside/sized_triangles.h"

namespace kerf {

/// Returns every facet with the mean length of its edges as its size.
std::vector<SizedTriangle> sizes_of_edges(const SurfaceArrays& surface);

/// Returns the facets of one patch with this size, up to `reach` away from them.
std::vector<SizedTriangle> sizes_on_patch(const SurfaceArrays& surface, std::int32_t patch, double size, double reach);

/// The sizes that follow from a radius of curvature R.
struct CurvatureSizes {
    double chord_error = 0;  ///< largest distance between an edge and the surface that the facets stand for, taken as a
                             ///< circle: edges sqrt(8 R error); 0: none
    double segments_per_turn = 0;  ///< edges of a full circle: 2 pi R / segments; 0: none
};
/// Returns the facets with a curved vertex, with the size of the most curved of their vertices. The larger principal
/// curvature at a vertex follows from the mean and Gaussian curvature of its facets (Meyer et al. 2003, meyer2003);
/// edges that turn by more than 40 degrees are features, and do not count as curvature.
std::vector<SizedTriangle> sizes_of_curvature(const SurfaceArrays& surface, const CurvatureSizes& wanted);

/// Returns facets with the depth of the body behind them over `cells_across` as their size. The depth is the distance
/// from the centroid, against the normal, to the next facet that faces the other way by 120 degrees or more; facets
/// without one are left out.
std::vector<SizedTriangle> sizes_of_thickness(const SurfaceArrays& surface, double cells_across);

}  // namespace kerf
