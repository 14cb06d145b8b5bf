// A place where a surface is open, as it may be closed.
#pragma once

#include <vector>

#include "repair/open_rims.h"
#include "repair/patch_fairing.h"
#include "repair/patch_mesh.h"
#include "repair/rim_triangulation.h"

namespace kerf {

/// One rim, or two of them between which a band is missing, with triangles over their vertices.
struct RimOpening {
    std::vector<const Rim*> rims;
    std::vector<Triangle> triangles;  ///< over the vertices of the rims, counted on; empty if there are none
    /// Degrees by which triangles stand off the facets at the rims, on average over their length: 0 where they go on
    /// straight, 90 for the lid of a box, 180 where they fold back.
    double bend = 0;
    bool is_flat = false;  ///< planar, and no part of a surface that is curved there

    std::int32_t edges() const;
    double length() const;
};

/// Below, a patch is to go on as the surface does; above, it is a lid; and beyond `folded` a lid would lie over a sheet
/// that has an end there, not a hole.
struct BendDegrees {
    static constexpr double straight = 1, lid = 45, folded = 135;
};

/// `rims`: closed ones without an obstacle.
RimOpening make_opening(const OpenRims& all, std::vector<const Rim*> rims);

/// How a patch is made: each but the first is tried where the one before crosses the surface.
enum class PatchShape {
    smooth,   ///< refined, and goes on as the surface around it does
    relaxed,  ///< refined, with points in the middle of their neighbours: planar where the rim is
    plain,    ///< triangles over the vertices of the rims alone
};

/// A patch of that shape; false if it does not span the rims, or is not fair. `growth` as PatchMesh::refine() has it.
struct ShapedPatch {
    PatchMesh mesh;
    bool is_usable;
};
ShapedPatch make_patch(const OpenRims& all, const RimOpening& opening, PatchShape shape, double growth);

}  // namespace kerf
