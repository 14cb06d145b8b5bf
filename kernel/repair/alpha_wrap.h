// A closed surface around any set of triangles.
#pragma once

#include <functional>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Triangles with shared vertices.
struct TriangleSet {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
};

/// A closed, manifold surface without intersections, normals out of it, that has all of `facets` inside: space is
/// carved away from outside by balls of `radius` as long as these do not come nearer to the facets than `offset`, and
/// every vertex is `offset` away from them (Portaneri et al. 2022; CGAL's Alpha_wrap_3). Facets may cross, overlap and
/// be open; what the ball does not reach through an opening is filled. May have several shells, all outer ones.
/// Requires positive lengths and at least one facet, finite, none degenerate. `poll` is called every few milliseconds,
/// and ends the work by what it throws. Deterministic. Some 4000 facets of the result a second.
TriangleSet alpha_wrap(const TriangleSet& input, double radius, double offset, const std::function<void()>& poll);

}  // namespace kerf
