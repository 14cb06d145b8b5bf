// How thick the body is behind the facets of a surface, and what that asks of edges.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/surface.h"
#include "surface/triangle_tree.h"

namespace kerf {

/// Thickness by rays. A facet on the other side counts if it faces the other way; one that a body on both sides has
/// counts whichever way it faces.
class Thickness {
 public:
    /// Keeps `tree`, of the facets of `surface`, and `walls` (#F): the facets that have a body on both sides; empty:
    /// none. O(#F).
    Thickness(const SurfaceArrays& surface, const TriangleTree& tree, const std::vector<char>& walls);

    /// Of the body behind facet `f` at its point `p`; of a wall, of the thinner of both bodies. Infinity where it is
    /// more than `limit`. O(log #F).
    double at(const Vec3& p, std::int32_t f, double limit) const;

    const Vec3& normal(std::int32_t f) const { return normal_[f]; }
    bool is_wall(std::int32_t f) const { return !walls_.empty() && walls_[f] != 0; }
    /// Whether two facets may bound what is between them.
    bool are_opposite(std::int32_t f, std::int32_t g) const;

 private:
    const TriangleTree& tree_;
    const std::vector<char>& walls_;
    std::vector<Vec3> normal_;
};

/// What thin walls ask for of the edges of a surface.
struct WallEdges {
    double per_thickness = 0;          ///< edges across the body; 0: nothing is asked for
    double shortest = 0, longest = 0;  ///< > 0
};

/// Points of a surface, more of larger facets, with the thickness there and the area that each stands for.
struct ThicknessSample {
    double thickness, area;
};

/// Thickness of more than `limit` is infinite. O(#F log #F).
std::vector<ThicknessSample> sample_thickness(const SurfaceArrays& surface, const Thickness& thickness, double limit);

/// The thickness that half of the area has at most; infinity if that is more than `limit`. O(#F log #F).
double median_thickness(const SurfaceArrays& surface, const TriangleTree& tree, const std::vector<char>& walls,
                        double limit);

/// `wanted`, or fewer edges across walls, and longer ones, where the walls of a very thin body would ask for more than
/// about `most` facets. Once edges are ten times as long as a wall is thick, only the shortest become longer, a few
/// times, so that there may be more than that. O(#F log #F).
WallEdges affordable_edges(const SurfaceArrays& surface, const Thickness& thickness, const WallEdges& wanted,
                           double most);

}  // namespace kerf
