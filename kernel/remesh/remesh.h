// A surface worth meshing: well-shaped triangles of wanted sizes within a bound of the input.
#pragma once

#include <functional>
#include <vector>

#include "surface/facet_sides.h"
#include "surface/surface.h"

namespace kerf {

struct RemeshOptions {
    double deviation = 0;           ///< largest distance between input and result, both ways; units of the input, > 0
    double share_of_thickness = 0;  ///< of a body, which the distance is at most there, too; 0: that asks for nothing
    double volume_tolerance = 1;    ///< of a region, as a share: above it all is done again with smaller deviations
    double longest = 0;             ///< edge anywhere, > 0
    double growth = 0.4;            ///< of the size along the surface
    double feature_angle_deg = 30;  ///< between facets: their edge stays an edge
    std::vector<UndirectedEdge> creases = {};  ///< edges of the surface that stay edges, flat as they may be
    std::vector<char> kept = {};               ///< facets of the surface that stay as they are; empty: none
    double edges_per_thickness = 0.5;          ///< across thin walls; 0: they ask for nothing
    double shortest_on_walls = 0;              ///< that these ask for; 0: three quarters of the deviation
    std::function<double(const Vec3&, std::int32_t)> wanted =
        {};                              ///< edge length at a point of a patch, if given: besides `longest`
    std::function<void()> poll = {};     ///< called every few milliseconds, if given; ends the work by what it throws
    std::vector<char> walls = {};        ///< facets of the surface that have a body on both sides; empty: none
    std::vector<FacetSides> sides = {};  ///< of patches: the regions beside them; empty: one, behind all facets
};

/// Of a facet, as a share of the square of the length that is wanted there; measured.
inline constexpr double facet_area_per_squared_length = 0.342;

/// The shortest edges that walls ask for.
double shortest_on_walls(const RemeshOptions& options);

/// Of the area of a surface, where its shape asks for smaller edges than `wanted` and `longest`, by what does.
struct FinerShares {
    double bound = 0;     ///< it is curved: a larger deviation allows longer edges
    double features = 0;  ///< it has strips between features
    double walls = 0;     ///< it is thin

    double sum() const { return bound + features + walls; }
};

struct RemeshReport {
    std::int64_t rounds = 0;  ///< with smaller tolerances where the result was refused; 1: nowhere
    double distance_to_input = 0,
           distance_from_input = 0;  ///< nothing of the new surface, and of the old, is further away; proven
    std::int64_t feature_edges = 0;  ///< of the new surface
    FinerShares finer;
    std::int64_t facets_left = 0;  ///< of the input, as they were, because no change of them stayed within the bound
    double volume_difference = 0;  ///< the largest of a region's volume to that in the input, as a share of it
};

/// sin of the smallest angle of a triangle, 0 for a degenerate one.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c);

/// What a vertex stands for.
struct InputPlace {
    std::int32_t facet;  ///< of the input, the closest
    Vec3 point;          ///< of it
};

struct Remeshed {
    SurfaceArrays surface;
    std::vector<InputPlace> places;  ///< of the vertices
    RemeshReport report;
};

/// Splits, collapses, flips and moves edges and vertices until triangles are well shaped and as long as their place
/// asks for: as the surface folds there, as walls are thick, as `wanted` says, with growth between.
///
/// Topology, features (sharp edges and the borders of patches) and the patches of facets stay. More than two facets may
/// meet in an edge, as walls do: such seams are features that all of their sheets have in common, changed once for all,
/// and their ends stay. No point of either
/// surface is further than `deviation` from the other, which is proven (Nearness), and the result has no
/// self-intersections, by exact predicates: where one of them fails, the tolerance of the facets there is made smaller
/// and all is done again; where that does not help, they stay as they are (RemeshReport::facets_left). Keys are the
/// numbers in the result. Where the volume of a region is another than before by more than 5e-5 of it, vertices leave
/// the input until it is the same, if that stays within the deviation and makes no intersections; where it does not,
/// and more than `volume_tolerance` is left of the difference, all is done again within half of the tolerances, and
/// within a quarter. Throws Error(input) with the place if no facet can be changed. Requires a surface without
/// intersections and open edges; facets that meet in an edge of two have it in opposite directions. Deterministic.
/// O(#F log #F) for the larger of both surfaces.
///
/// The bound of operations instead of the whole follows Cohen et al. 1996; sizes by distance between folds are those of
/// Ruppert 1995.
Remeshed remesh(const SurfaceArrays& surface, const RemeshOptions& options);

/// How many facets the result has where `longest` and `wanted` ask for more than the shape does, within a fifth; more
/// elsewhere. O(#F).
double forecast_facets(const SurfaceArrays& surface, const RemeshOptions& options);

}  // namespace kerf
