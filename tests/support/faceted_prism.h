// Prisms over any polygon whose faces are triangulated each for itself, and not well.
#pragma once

#include <vector>

#include "base/core/types.h"
#include "support/seeded_numbers.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// Where points are added in a face.
enum class Pattern { random, grid, circle, cluster, near_edges };
inline constexpr int pattern_count = 5;

struct FaceStyle {
    int points = 0;  ///< in each face, at most
    Pattern pattern = Pattern::random;
    double least_height = 1e-3;  ///< of triangles, over their longest edges, where that is possible; of `near_edges`
                                 ///< the distance from the edge, too
    double flips = 1;            ///< random ones, for each triangle
    bool has_star = false;       ///< one vertex of each face sees as many others as possible
};

struct PrismStyle {
    FaceStyle cap = {}, wall = {};
    int edge_parts = 1;      ///< of each edge around the caps, at most
    int height_parts = 1;    ///< of each edge from cap to cap, at most
    double roughness = 0;    ///< points inside of caps are moved inwards by less than this share of half the height
    double least_gap = 0.1;  ///< and stay this share of it from the middle at least
    double twist = 0;        ///< of the upper cap, in radians about the origin: walls are no longer planar
};

/// From z = 0 to `height`. `polygon`: simple, counter-clockwise. Ends of edges are shared by the faces there, and
/// nothing else is.
Soup faceted_prism(const std::vector<Vec2>& polygon, double height, const PrismStyle& style, SeededNumbers& random);

/// A box with these faces.
Soup faceted_box(const Vec3& low, const Vec3& high, const PrismStyle& style, SeededNumbers& random);

}  // namespace kerf::test
