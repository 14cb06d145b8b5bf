// A surface worth meshing: well-shaped triangles of the wanted sizes within a bound of the input.
#pragma once

#include <functional>
#include <vector>

#include "surface/complex/surface.h"
#include "surface/soup/facet_sides.h"

namespace kerf {

struct RemeshOptions {
    double deviation = 0;           ///< largest distance between input and result, both ways; units of the input, > 0
    double share_of_thickness = 0;  ///< largest distance as a share of the body's thickness there; 0: no such limit
    double reference_volume = 0;    ///< > 0: differences are shares of it where a region has more; 0: of the region
    double volume_tolerance = 1;    ///< of a region, relative: if it is missed by more, all is done again with smaller
                                    ///< deviations
    double longest = 0;             ///< longest edge anywhere, > 0
    double growth = 0.4;            ///< increase of the size per distance along the surface
    double feature_angle_deg = 30;  ///< an edge with more between its facets' normals stays an edge
    std::vector<UndirectedEdge> creases = {};  ///< edges of the surface that stay edges, even if flat
    std::vector<char> kept = {};               ///< #F; facets of the surface that stay as they are; empty: none
    double edges_per_thickness = 0.5;          ///< across thin walls; 0: walls ask for nothing
    double shortest_on_walls = 0;              ///< lower bound of the sizes that walls ask for; 0: three quarters of
                                               ///< the deviation
    std::function<double(const Vec3&, std::int32_t)> wanted =
        {};  ///< edge length at a point of a patch, if given, in addition to `longest`
    std::function<void()> check_cancelled = {};  ///< called every few milliseconds, if given; ends the work by throwing
    std::function<void(double)> tell_share = {};  ///< called with the share of the work that is done, if given
    std::vector<char> walls = {};                 ///< #F; facets of the surface with a body on both sides; empty: none
    std::vector<FacetSides> sides = {};  ///< of each patch: the regions beside it; empty: one region, behind all facets
};

/// The mean area of a facet over the square of the length that is wanted there; measured.
inline constexpr double facet_area_per_squared_length = 0.342;

/// Returns the shortest edges that walls ask for.
double shortest_on_walls(const RemeshOptions& options);

/// The shares of a surface's area in which its shape asks for smaller edges than `wanted` and `longest`, by the reason.
struct FinerShares {
    double bound = 0;     ///< curvature: a larger deviation would allow longer edges
    double features = 0;  ///< strips between features
    double walls = 0;     ///< thin walls

    double sum() const { return bound + features + walls; }
};

/// The facets of a result, without those that are kept, by what decides about the smallest length that is wanted at
/// their corners.
struct FacetsByReason {
    std::int64_t asked = 0;     ///< `wanted` and `longest`, or growth from where these decide
    std::int64_t bound = 0;     ///< as in FinerShares
    std::int64_t features = 0;  ///< as in FinerShares
    std::int64_t walls = 0;     ///< as in FinerShares
};

struct RemeshReport {
    std::int64_t rounds = 0;  ///< one more for each time that all was done again with smaller tolerances
    double distance_to_input = 0,
           distance_from_input = 0;  ///< no point of the new surface, and of the old one, is further from the other;
                                     ///< proven
    std::int64_t feature_edges = 0;  ///< of the new surface
    FinerShares finer;
    FacetsByReason facets_by;
    std::int64_t facets_left = 0;  ///< facets of the input kept as they were, because no change of them stayed within
                                   ///< the bound
    double volume_difference = 0;  ///< of a region against its volume in the input, the largest of all, as a share
};

/// Returns the sine of the smallest angle of a triangle, 0 for a degenerate one.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c);

/// The place on the input that a vertex stands for.
struct InputPlace {
    std::int32_t facet;  ///< the closest facet of the input
    Vec3 point;          ///< the closest point of this facet
};

struct Remeshed {
    SurfaceArrays surface;
    std::vector<InputPlace> places;  ///< of the vertices
    RemeshReport report;
};

/// Splits, collapses, flips and moves edges and vertices until triangles are well shaped and as long as their place
/// asks for: by the folds of the surface, the thickness of walls and `wanted`, with growth between.
///
/// Works on threads, with the same result for any number of them; it calls `check_cancelled` and `tell_share` on that
/// of the caller alone, `wanted` on all.
///
/// Topology, features (sharp edges and the borders of patches) and the patches of facets stay. More than two facets may
/// meet in an edge, as at walls: such seams are features that all of their sheets have in common, changed once for all,
/// and their ends stay.
/// No point of either surface is further than `deviation` from the other, which is proven (Nearness), and the result
/// has no self-intersections, by exact predicates: where one of these fails, the tolerance of the facets there is made
/// smaller and all is done again; where that does not help, the facets stay as they are (RemeshReport::facets_left).
/// Keys are the numbers in the result. If the volume of a region has changed by more than 5e-5 of it, vertices leave
/// the input until it is the same, if that stays within the deviation and makes no intersections; if not, and the
/// difference is still more than `volume_tolerance`, all is done again within half of the tolerances, and then within a
/// quarter. Throws Error(input) with the place if no facet can be changed. Requires a surface without intersections and
/// open edges, in which the facets at an edge of two have it in opposite directions. Deterministic. O(#F log #F) for
/// the larger of both surfaces.
///
/// The bound of each operation, instead of the whole, follows Cohen et al. (1996, cohen1996); sizes by the distance
/// between folds are those of Ruppert (1995, ruppert1995).
Remeshed remesh(const SurfaceArrays& surface, const RemeshOptions& options);

/// Returns the number of facets of the result, within a fifth, where `longest` and `wanted` ask for more than the shape
/// does; elsewhere the result has more. O(#F).
double forecast_facets(const SurfaceArrays& surface, const RemeshOptions& options);

}  // namespace kerf
