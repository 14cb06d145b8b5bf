// The surface as it was given: what a changed surface must stay close to.
#pragma once

#include <vector>

#include "remesh/flat_regions.h"
#include "surface/surface.h"
#include "surface/triangle_tree.h"

namespace kerf {

/// The input of the remesher and its bound. Immutable.
class InputShape {
 public:
    /// Keeps the references; `tree` is of the facets of `surface`. `tolerance` (#F): how far from a facet the new
    /// surface may be, units of the input. Edges of more than `feature_angle_deg` between the normals and those between
    /// patches are features, and so are `creases`.
    InputShape(const SurfaceArrays& surface, const TriangleTree& tree, std::vector<double> tolerance,
               double feature_angle_deg, const std::vector<UndirectedEdge>& creases = {});

    const std::vector<Vec3>& vertices() const { return surface_.vertices; }
    const std::vector<Triangle>& facets() const { return surface_.facets; }
    const TriangleTree& tree() const { return tree_; }
    std::int32_t patch(std::int32_t facet) const { return surface_.patch[facet]; }
    double tolerance(std::int32_t facet) const { return tolerance_[facet]; }
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

    const SurfaceArrays& surface_;
    const TriangleTree& tree_;
    std::vector<double> tolerance_, vertex_tolerance_;
    std::vector<char> feature_;  // 3 #F
    FlatRegions regions_;
    double largest_tolerance_ = 0, noise_ = 0;
};

/// The tolerance of every facet: `deviation`, or a third of the gap to a sheet that faces the other way, so that sheets
/// which come closer than that do not grow into each other. `tree` is of the facets of `surface`. O(#F log #F).
std::vector<double> tolerances_of_gaps(const SurfaceArrays& surface, const TriangleTree& tree, double deviation);

}  // namespace kerf
