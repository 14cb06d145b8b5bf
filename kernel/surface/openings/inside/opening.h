// The rims at which a surface is open, and the openings between them, as they may be closed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/openings/inside/patch_fairing.h"
#include "surface/openings/inside/patch_mesh.h"
#include "surface/openings/inside/rim_triangulation.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The reason why a rim cannot be spanned, if it cannot.
enum class RimObstacle {
    none,
    no_loop,    ///< the rim ends at an edge of more than two facets
    one_sided,  ///< the surface has only one side
    infinite,   ///< a vertex has no finite coordinates
};

/// Open edges, of one facet each, that follow each other.
struct Rim {
    std::vector<std::int32_t> vertices;  ///< numbers in the soup, in the direction of facets that would fill the rim
    std::vector<std::int32_t> facets;    ///< of the soup: facets[i] has the edge from vertices[i] to its successor
    std::vector<Vec3> apexes;            ///< the third corners of these facets
    RimObstacle obstacle = RimObstacle::none;
    double length = 0;

    std::vector<Vec3> points(const Soup& soup) const;
    Vec3 centre(const Soup& soup) const;
};

/// All rims of a soup, and the facets at them. Facets with a repeated vertex are passed over. Facets may be turned
/// against each other: rims have the direction that they would have if each facet were turned like most of its shell.
class OpenRims {
 public:
    /// Keeps the reference. O(#F log #F).
    explicit OpenRims(const Soup& soup);

    const std::vector<Rim>& all() const { return rims_; }
    /// Returns the facets at a vertex of a rim, ascending; empty at other vertices.
    std::span<const std::int32_t> facets_at(std::int32_t vertex) const;
    /// Whether only one rim passes a vertex, and once.
    bool is_passed_once(std::int32_t vertex) const { return passes_[vertex] == 1; }
    const Soup& soup() const { return soup_; }

 private:
    void find_facets();

    const Soup& soup_;
    std::vector<Rim> rims_;
    std::vector<std::int32_t> passes_;          // #V
    std::vector<std::int32_t> first_, facets_;  // vertex v has facets_ from first_[v] up to first_[v + 1]
};

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
