// The surface as it was given: what a changed surface must stay close to.
#pragma once

#include <algorithm>
#include <vector>

#include "core/cancellation.h"
#include "remesh/flat_regions.h"
#include "remesh/sheets.h"
#include "surface/triangle_tree.h"

namespace kerf {

/// How far from each facet the new surface may be, units of the input.
struct Tolerances {
    std::vector<double> of_facet;      ///< #F
    std::vector<double> by_thickness;  ///< #F; what the thickness of the body there would allow alone

    void multiply(double factor);
};

/// The input of the remesher and its bound. Immutable.
class InputShape {
 public:
    /// Keeps the references; `tree` is of the facets of `sheets`. Edges of more than `feature_angle_deg` between the
    /// normals, those between patches and seams are features, and so are `creases`, by the numbers before the sheets
    /// were taken apart. `walls` (#F): the facets that have a body on both sides; empty: none.
    InputShape(const Sheets& sheets, const TriangleTree& tree, Tolerances tolerances, double feature_angle_deg,
               const std::vector<UndirectedEdge>& creases = {}, const std::vector<char>& walls = {});

    const Sheets& sheets() const { return sheets_; }
    const std::vector<Vec3>& vertices() const { return sheets_.surface.vertices; }
    const std::vector<Triangle>& facets() const { return sheets_.surface.facets; }
    const TriangleTree& tree() const { return tree_; }
    std::int32_t patch(std::int32_t facet) const { return sheets_.surface.patch[facet]; }
    bool is_wall(std::int32_t facet) const { return !walls_.empty() && walls_[facet] != 0; }
    double tolerance(std::int32_t facet) const { return tolerances_.of_facet[facet]; }
    /// What the thickness there allows, of largest_tolerance(): 1 where the body is thick. Flat regions, which follow
    /// from the largest tolerance elsewhere, are flatter by that.
    double share_by_thickness(std::int32_t facet) const {
        return std::min(1.0, tolerances_.by_thickness[facet] / largest_tolerance_);
    }
    /// The smallest tolerance of the facets around a vertex.
    double vertex_tolerance(std::int32_t vertex) const { return vertex_tolerance_[vertex]; }

    /// Corner 3 f + i is the edge of facet f from its vertex i.
    bool is_feature(std::int32_t corner) const { return feature_[corner] != 0; }
    /// The flat region that a facet belongs to; every facet has one.
    const FlatRegions& regions() const { return regions_; }
    /// The normal of the flat region of a facet: its own may be noise.
    const Vec3& normal(std::int32_t facet) const { return regions_.planes[regions_.of[facet]].normal; }
    /// Height of a facet below which its normal says nothing.
    double noise() const { return noise_; }
    double largest_tolerance() const { return largest_tolerance_; }

 private:
    void find_features(double feature_angle_deg, std::vector<UndirectedEdge> creases);

    const Sheets& sheets_;
    const TriangleTree& tree_;
    const std::vector<char>& walls_;
    Tolerances tolerances_;
    std::vector<double> vertex_tolerance_;
    std::vector<char> feature_;  // 3 #F
    FlatRegions regions_;
    double largest_tolerance_ = 0, noise_ = 0;
};

struct ToleranceRules {
    double deviation = 0;           ///< the largest tolerance, > 0
    double share_of_thickness = 0;  ///< that a tolerance may be at most; 0: the thickness says nothing
};

/// The tolerance of every facet: the deviation, or a third of the gap to a sheet that faces the other way, or any way
/// if one of them is a wall, so that sheets which come closer than that do not grow into each other; and no more than
/// the share of the thickness of the body behind it, lest what it loses is much of a slender one. `tree` is of the
/// facets of `surface`, `walls` as for InputShape. O(#F log #F).
Tolerances find_tolerances(const SurfaceArrays& surface, const TriangleTree& tree, const ToleranceRules& rules,
                           const std::vector<char>& walls = {}, const CancellationCheck& poll = {});

}  // namespace kerf
