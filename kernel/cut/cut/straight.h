// The straight cut, which splits facets where they cross a coordinate plane. It is the strategy for surfaces without a
// contour of edges, such as those of CAD programs whose triangles are as long as the part.
#pragma once

#include <optional>

#include "cut/cut/inside/facet_split.h"
#include "cut/cut/inside/options.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

/// The plane x[axis] = height.
struct StraightPlane {
    int axis = 0;
    double height = 0;
};

/// Returns planes for a straight cut that leaves about `fraction`, in (0, 1), of the load below, best first, at most
/// twelve. Each runs through a gap between the vertices' coordinates within the load window. Wide gaps are preferred,
/// because short new edges do the harm; then planes near the wanted load, planes that cross few facets, and the long
/// directions of the body. Planes are across coordinate axes, so that every decision about them is exact. O(#F log #F).
std::vector<StraightPlane> straight_planes(const Surface& surface, double fraction, const CutOptions& options);

/// The result of a straight cut.
struct StraightCut {
    PlaneSplit split;  ///< the parent with its facets split at the plane
    Surface parent;    ///< the split parent as a surface
    Cut cut;           ///< vertices, facets and sides are those of `parent`; strategy and tries are set
};

/// Cuts along the first of straight_planes() that lies between bodies, or gives simple closed contours with the section
/// inside and children free of self-intersections (exact). The interface lies in the plane and has no interior points
/// yet: it is triangulated finely after the last cut that crosses it. Returns nothing if every plane was refused;
/// `tries` has the reasons. `untested` (#F, or empty for none) are facets of `surface` that may intersect others; the
/// rest must not.
std::optional<StraightCut> cut_straight(const Surface& surface, NodeId node, double fraction, const CutOptions& options,
                                        std::vector<CutTry>& tries, const Array<Facet, char>& untested = {});

}  // namespace kerf
