// The surface as it was given, near which the changed surface must stay.
#pragma once

#include <algorithm>
#include <vector>

#include "base/core/cancellation.h"
#include "surface/diagnosis/nearness.h"
#include "surface/remesh/inside/flat_regions.h"
#include "surface/remesh/inside/sheets.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

/// The largest distance of the new surface from each facet, in units of the input.
struct Tolerances {
    std::vector<double> of_facet;      ///< #F
    std::vector<double> by_thickness;  ///< #F; the largest distance that the thickness of the body there would allow by
                                       ///< itself

    void multiply(double factor);
};

/// The input of the remesher and its bound. Immutable.
class InputShape {
 public:
    /// Keeps the references; `tree` and `nearness` are of the facets of `sheets`. Features are the edges of more than
    /// `feature_angle_deg` between the normals, those between patches, the seams, and the `creases`, which have the
    /// numbers of vertices before the sheets were taken apart. `walls` (#F) marks the facets with a body on both sides;
    /// empty: none.
    InputShape(const Sheets& sheets, const TriangleTree& tree, const Nearness& nearness, Tolerances tolerances,
               double feature_angle_deg, const std::vector<UndirectedEdge>& creases = {},
               const std::vector<char>& walls = {});

    const Sheets& sheets() const { return sheets_; }
    const std::vector<Vec3>& vertices() const { return sheets_.surface.vertices; }
    const std::vector<Triangle>& facets() const { return sheets_.surface.facets; }
    const TriangleTree& tree() const { return tree_; }
    const Nearness& nearness() const { return nearness_; }
    std::int32_t patch(std::int32_t facet) const { return sheets_.surface.patch[facet]; }
    bool is_wall(std::int32_t facet) const { return !walls_.empty() && walls_[facet] != 0; }
    double tolerance(std::int32_t facet) const { return tolerances_.of_facet[facet]; }
    /// The tolerance that the thickness there allows, over largest_tolerance(); 1 where the body is thick. Flat regions
    /// follow from the largest tolerance, and are made flatter by this factor in thin places.
    double share_by_thickness(std::int32_t facet) const {
        return std::min(1.0, tolerances_.by_thickness[facet] / largest_tolerance_);
    }
    /// The smallest tolerance of the facets around a vertex.
    double vertex_tolerance(std::int32_t vertex) const { return vertex_tolerance_[vertex]; }

    /// Whether the edge at a corner is a feature. Corner 3 f + i is the edge of facet f from its vertex i.
    bool is_feature(std::int32_t corner) const { return feature_[corner] != 0; }
    /// The flat region that a facet belongs to; every facet has one.
    const FlatRegions& regions() const { return regions_; }
    /// The normal of the flat region of a facet, whose own normal may be noise.
    const Vec3& normal(std::int32_t facet) const { return regions_.planes[regions_.of[facet]].normal; }
    /// The height of a facet below which its normal is noise.
    double noise() const { return noise_; }
    double largest_tolerance() const { return largest_tolerance_; }

 private:
    void find_features(double feature_angle_deg, std::vector<UndirectedEdge> creases);

    const Sheets& sheets_;
    const TriangleTree& tree_;
    const Nearness& nearness_;
    const std::vector<char>& walls_;
    Tolerances tolerances_;
    std::vector<double> vertex_tolerance_;
    std::vector<char> feature_;  // 3 #F
    FlatRegions regions_;
    double largest_tolerance_ = 0, noise_ = 0;
};

struct ToleranceRules {
    double deviation = 0;           ///< the largest tolerance, > 0
    double share_of_thickness = 0;  ///< largest tolerance as a share of the thickness; 0: the thickness does not count
};

/// Returns the tolerance of every facet: the deviation, or a third of the gap to a sheet that faces the other way (any
/// way if one of them is a wall), so that sheets which come close do not grow into each other; and no more than the
/// share of the thickness of the body behind it, so that slender bodies do not lose much. `tree` is of the facets of
/// `surface`, `walls` as for InputShape. O(#F log #F).
Tolerances find_tolerances(const SurfaceArrays& surface, const TriangleTree& tree, const ToleranceRules& rules,
                           const std::vector<char>& walls = {}, const CancellationCheck& check_cancelled = {});

}  // namespace kerf
