// The thickness of a body behind the facets of its surface, and the edges that it asks for.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/complex/surface.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

/// Thickness by rays. A ray ends at the first facet that faces the other way; a facet with a body on both sides counts
/// whichever way it faces.
class Thickness {
 public:
    /// Keeps `tree`, of the facets of `surface`, and `walls` (#F), which marks the facets with a body on both sides;
    /// empty: none. O(#F).
    Thickness(const SurfaceArrays& surface, const TriangleTree& tree, const std::vector<char>& walls);

    /// Returns the thickness of the body behind facet `f` at its point `p`, for a wall that of the thinner of both
    /// bodies; infinity if it is more than `limit`. O(log #F).
    double at(const Vec3& p, std::int32_t f, double limit) const;

    const Vec3& normal(std::int32_t f) const { return normal_[f]; }
    bool is_wall(std::int32_t f) const { return !walls_.empty() && walls_[f] != 0; }
    /// Whether two facets may have a body or a gap between them: they face opposite ways, and walls face both ways.
    bool are_opposite(std::int32_t f, std::int32_t g) const;

 private:
    const TriangleTree& tree_;
    const std::vector<char>& walls_;
    std::vector<Vec3> normal_;
};

/// The edges that thin walls ask for.
struct WallEdges {
    double per_thickness = 0;          ///< edges across the body; 0: walls ask for nothing
    double shortest = 0, longest = 0;  ///< bounds of their lengths, > 0

    /// Returns the length of edges where the body is so thick; `longest` where even the shortest edges are a hundred
    /// times as long as that: cells are bad there anyway.
    double of(double thickness) const;
};

/// A point of a surface: the thickness there, and the area that it stands for.
struct ThicknessSample {
    double thickness, area;
};

/// Samples the surface, larger facets at more points. Thickness of more than `limit` is infinite. O(#F log #F), on
/// threads.
std::vector<ThicknessSample> sample_thickness(const SurfaceArrays& surface, const Thickness& thickness, double limit);

/// Returns the median of the thickness by area; infinity if it is more than `limit`. O(#F log #F).
double median_thickness(const SurfaceArrays& surface, const TriangleTree& tree, const std::vector<char>& walls,
                        double limit);

/// Returns `wanted`, or fewer edges across walls, and longer ones, if the walls of a very thin body would ask for more
/// than about `most` facets. Once edges are ten times as long as a wall is thick, only the shortest become longer, in a
/// few steps, so that there may still be more facets than that. O(#F log #F), on threads.
WallEdges affordable_edges(const SurfaceArrays& surface, const Thickness& thickness, const WallEdges& wanted,
                           double most);

}  // namespace kerf
