// A place where a surface is open, as it may be closed.
#pragma once

#include <vector>

#include "surface/openings/inside/open_rims.h"
#include "surface/openings/inside/patch_fairing.h"
#include "surface/openings/inside/patch_mesh.h"
#include "surface/openings/inside/rim_triangulation.h"

namespace kerf {

/// One rim, or two of them between which a band is missing, with triangles over their vertices.
struct RimOpening {
    std::vector<const Rim*> rims;
    std::vector<Triangle> triangles;  ///< over the points of all rims, numbered on; empty if there are none
    /// Degrees by which triangles stand off the facets at the rims, on average over the length of the rims: 0 where
    /// they go on straight, 90 for the lid of a box, 180 where they fold back.
    double bend = 0;
    bool is_flat = false;  ///< is planar, and not part of a surface that is curved there

    std::int32_t edges() const;
    double length() const;
};

/// Bounds of RimOpening::bend. Up to `straight` triangles go on as they are; below `lid` a patch is to go on as the
/// surface does; above, it is a lid; and beyond `folded` a lid would lie over a sheet that has an end there, not a
/// hole.
struct BendDegrees {
    static constexpr double straight = 1, lid = 45, folded = 135;
};

/// Makes an opening of one rim, or of two with a band between them, all closed and without an obstacle.
RimOpening make_opening(const OpenRims& all, std::vector<const Rim*> rims);

/// The shapes of a patch, in the order in which they are tried: each where the one before crosses the surface.
enum class PatchShape {
    smooth,   ///< refined, and goes on as the surface around it does
    relaxed,  ///< refined, with points in the middle of their neighbours: planar where the rim is
    plain,    ///< triangles over the vertices of the rims alone
};

/// A patch of one shape; not usable if it does not span the rims, or is not fair.
struct ShapedPatch {
    PatchMesh mesh;
    bool is_usable;
};
/// Makes a patch of one shape for an opening. `growth`: see PatchMesh::refine().
ShapedPatch make_patch(const OpenRims& all, const RimOpening& opening, PatchShape shape, double growth);

}  // namespace kerf
