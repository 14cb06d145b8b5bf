// A closed surface around any set of triangles.
#pragma once

#include <functional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Triangles with shared vertices.
struct TriangleSet {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
};

/// Returns a closed, manifold surface without intersections, its normals pointing out of it, that has all facets of
/// `input` inside. Balls of `radius` carve space away from outside as long as they do not come nearer to the facets
/// than `offset`, and every vertex is `offset` away from them (Portaneri et al. 2022, portaneri2022; CGAL's
/// Alpha_wrap_3). Facets may cross, overlap and be open; space that the ball does not reach through an opening is
/// filled. The result may have several shells, all of them outer ones. Requires positive lengths, and at least one
/// facet, all finite and none degenerate. `check_cancelled` is called every few milliseconds, and ends the work by
/// throwing. Deterministic. Some 4000 facets of the result a second.
TriangleSet alpha_wrap(const TriangleSet& input, double radius, double offset,
                       const std::function<void()>& check_cancelled);

}  // namespace kerf
