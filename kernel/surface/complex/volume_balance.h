// Moves vertices off curved faces so that facets enclose the volume of the faces.
#pragma once

#include <span>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"
#include "surface/soup/facet_sides.h"

namespace kerf {

/// Facets that stand for faces, which may be curved. Refers to arrays that must outlive it.
struct FacetsOfFaces {
    std::span<const Triangle> facets;
    std::span<const std::int32_t> patch;  ///< #F; the face of each facet
    std::span<const Vec3> plane;          ///< #F; normal of a planar face, else 0
    std::span<const double> rise;         ///< #F; mean height of the face over the facet, along the facet's normal
    std::span<const FacetSides> sides;    ///< #F; empty: region 0 is behind all facets

    FacetSides sides_of(std::size_t facet) const { return sides.empty() ? FacetSides{} : sides[facet]; }
};

/// The range of the factors by which a balance may scale the moves of moves_to_faces().
struct ScaleRange {
    double least, most;
};

/// The limits of a balance.
namespace balance_limits {
// A factor far from 1 has other causes than chords.
inline constexpr ScaleRange chords = {0.4, 2.5};
inline constexpr int secant_steps = 3, most_rounds = 12;
inline constexpr double precision = 1e-7;  // relative, per volume
}  // namespace balance_limits

/// Returns for each vertex the move that makes up for the space between its facets, as chords, and their faces: by the
/// mean rise of the facets, away from each curved face and within each planar one. O(#F log #F).
std::vector<Vec3> moves_to_faces(const std::vector<Vec3>& vertices, const FacetsOfFaces& faces);

/// Returns the normals of facets, with their areas as lengths.
std::vector<Vec3> area_vectors(const std::vector<Vec3>& vertices, std::span<const Triangle> facets);

/// Sets the moves of the corners to 0 for facets that have turned too far. `normals` are the area_vectors() before the
/// moves. Returns whether some move has become 0.
bool keep_turned(const std::vector<Vec3>& vertices, std::span<const Triangle> facets, const std::vector<Vec3>& normals,
                 std::vector<Vec3>& moves);

/// Returns the volumes of the regions, numbered from 0 to `regions` - 1.
Array<RegionIndex, double> region_volumes(const std::vector<Vec3>& vertices, const FacetsOfFaces& faces,
                                          std::size_t regions);

/// Moves vertices off their faces until the regions have the `volumes`. Chords on a curve leave out the space between
/// them and the curve; vertices that stand out by its mean height give it back, and then are no farther from the curve
/// than the chords were. A vertex of a wall moves for both of its regions: of all moves that give every region its
/// volume, the method takes those that differ least from the moves_to_faces(). `is_fixed` (#V): vertices that stay.
///
/// Returns false, and moves nothing, if that takes factors out of `range`, or turns too many facets. The result may
/// intersect itself. O(#F (log #F + regions)), deterministic.
bool balance_volumes(std::vector<Vec3>& vertices, const FacetsOfFaces& faces, const Array<RegionIndex, double>& volumes,
                     const std::vector<char>& is_fixed, const ScaleRange& range);

}  // namespace kerf
