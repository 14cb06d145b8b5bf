// A surface in sheets at rest, as flat arrays, between the stages that change it by half-edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/complex/surface.h"
#include "surface/remesh/inside/flat_regions.h"
#include "surface/remesh/inside/input_shape.h"

namespace kerf {

/// The reason for the wanted length of the edges at a vertex: `asked`, the user asks for it; `bound`, the surface is
/// curved, and the bound allows no longer chord; `features`, strips between features; `walls`, thin walls.
enum class LengthRule : std::uint8_t { asked, bound, features, walls };

struct WantedLength {
    double length = 0;
    LengthRule rule = LengthRule::asked;

    void shorten(double other, LengthRule other_rule) {
        if (other < length) *this = {other, other_rule};
    }
};

struct SheetVertex {
    WantedLength wanted;       ///< of the edges at the vertex
    double asked = 0;          ///< by the user alone, at least the wanted length
    double tolerance = 0;      ///< the smallest of the input around
    std::int32_t input = -1;   ///< the vertex of the input that it is, -1: none, or a facet stands for it
    std::int32_t place = -1;   ///< number of the place that it shares with its copies, -1: it has none
    std::int32_t whole = -1;   ///< its number in the whole surface, -1: it is new
    std::int64_t changed = 0;  ///< the last operation that changed a facet around it
    bool is_fixed = false;     ///< corner of a facet that is kept
    bool is_border = false;    ///< corner of a facet outside the block, too: stays where it is
    bool is_end = false;       ///< a copy at which seams end, part or touch: stays where it is
};

struct SheetFacet {
    std::int32_t patch = 0;
    std::int32_t region = -1;       ///< flat region that contains its corners, -1: none
    std::int32_t near = -1;         ///< a facet of the input near it
    std::int32_t first_point = -1;  ///< head of the list of the input's vertices that it stands for
    std::int32_t block = -1;        ///< number of the block that it belongs to, -1: none
    std::int64_t changed = 0;       ///< the last operation that changed it
    bool is_kept = false;           ///< stays as it was given
    bool is_wall = false;           ///< has a body on both sides
};

struct SheetEdge {
    bool is_feature = false;
    bool is_border = false;  ///< between the block and other facets: stays as it is
    std::int32_t fold = -1;  ///< number of the fold that it is a piece of, -1: none
    std::int32_t seam = -1;  ///< number of the seam that it is an edge of, -1: it is in one sheet only
};

/// Facets and vertices in sheets: copies of a vertex share a place, copies of an edge a seam.
struct SheetArrays {
    std::vector<Vec3> points;           // #V
    std::vector<SheetVertex> vertices;  // #V
    std::vector<Triangle> corners;      // #F
    std::vector<SheetFacet> facets;     // #F
    std::vector<SheetEdge> edges;       // 3 #F: that of each corner, the same for both facets at it

    std::array<Vec3, 3> triangle(std::size_t f) const {
        const Triangle& t = corners[f];
        return {points[t[0]], points[t[1]], points[t[2]]};
    }
};

/// The whole surface, with what its blocks have in common.
struct SheetState {
    SheetArrays arrays;
    std::int32_t places = 0, seams = 0;    ///< how many numbers have been given
    std::vector<FlatRegion> planes;        ///< of flat regions
    std::vector<std::int32_t> next_point;  ///< per vertex of the input: the next one in the list of a facet, -1: none
};

/// Returns the input as it is. `kept` (#F of the input) marks facets that no operation may change; empty: none. O(#F).
SheetState sheet_state(const InputShape& input, const std::vector<char>& kept);

/// Finds the flat regions of the state anew, of facets that lie within `share` of the tolerance of a plane. O(#F log
/// #F).
void find_regions(const InputShape& input, double share, SheetState& state);

/// Returns for each vertex the first of the copies at its place. O(#V).
std::vector<std::int32_t> first_copies(const SheetArrays& sheets);

/// Returns the facets in their order, with one vertex at each place, whose key is its number. O(#V + #F).
SurfaceArrays joined_surface(const SheetArrays& sheets);

/// Returns the number of edges that are features, of a seam one. O(#F log #F).
std::int64_t count_features(const SheetArrays& sheets);

}  // namespace kerf
