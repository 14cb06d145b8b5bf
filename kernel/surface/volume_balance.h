// Facets that hold what curved faces hold, with few chords.
#pragma once

#include <span>
#include <vector>

#include "core/types.h"
#include "surface/facet_sides.h"

namespace kerf {

/// Facets in place of faces, which may be curved. Refers to arrays that have to outlive it.
struct FacetsOfFaces {
    std::span<const Triangle> facets;
    std::span<const std::int32_t> patch;  ///< #F; the face that each is of
    std::span<const Vec3> plane;          ///< #F; normal of the face if that is planar, else 0
    std::span<const double> rise;         ///< #F; height of the face over the facet, along its normal, in the mean
    std::span<const FacetSides> sides;    ///< #F; empty: region 0 is behind all facets

    FacetSides sides_of(std::size_t facet) const { return sides.empty() ? FacetSides{} : sides[facet]; }
};

/// Of the moves that facets ask for, which balances take multiples of.
struct ScaleRange {
    double least, most;
};

/// How far balances go.
namespace balance_limits {
// What is far from 1 has other causes than chords.
inline constexpr ScaleRange chords = {0.4, 2.5};
inline constexpr int secant_steps = 3, most_rounds = 12;
inline constexpr double precision = 1e-7;  // of a volume
}  // namespace balance_limits

/// A move is right for a vertex if it makes up for what the chords around it leave out of their faces: by the mean rise
/// of its facets, away from each curved face and within each planar one. O(#F log #F).
std::vector<Vec3> moves_to_faces(const std::vector<Vec3>& vertices, const FacetsOfFaces& faces);

/// Normals with the areas as their lengths.
std::vector<Vec3> area_vectors(const std::vector<Vec3>& vertices, std::span<const Triangle> facets);

/// Takes their moves from the corners of facets that have turned by much: `normals` as area_vectors() had them before.
/// True if there are any.
bool keep_turned(const std::vector<Vec3>& vertices, std::span<const Triangle> facets, const std::vector<Vec3>& normals,
                 std::vector<Vec3>& moves);

/// Volumes of the regions.
std::vector<double> region_volumes(const std::vector<Vec3>& vertices, const FacetsOfFaces& faces, std::size_t regions);

/// Moves vertices off their faces until the regions have the `volumes`. Chords on a curve leave out what is between
/// them and it; vertices that stand out by the mean of that give it back, and their distance from the curve is no
/// larger than that of the chords was. A vertex of a wall moves for both of its regions: of all moves that give every
/// region its volume those are taken that differ the least from what the faces ask for. `is_fixed`: of each vertex,
/// whether it stays.
///
/// False, and nothing is moved, if that takes multiples out of `range`, or turns too many facets. The result may
/// intersect itself. O(#F (log #F + regions)), deterministic.
bool balance_volumes(std::vector<Vec3>& vertices, const FacetsOfFaces& faces, const std::vector<double>& volumes,
                     const std::vector<char>& is_fixed, const ScaleRange& range);

}  // namespace kerf
