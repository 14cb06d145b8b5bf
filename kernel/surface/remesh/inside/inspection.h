// The check that a remeshed surface keeps its bound.
#pragma once

#include <vector>

#include "surface/remesh/remesh.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

/// Calls visit(point) for the points of a lattice in the facet that divides each of its edges in six.
template <class Visit>
void for_each_sample(const std::vector<Vec3>& vertices, const Triangle& t, Visit visit) {
    constexpr int samples_per_edge = 6;
    for (int i = 0; i <= samples_per_edge; ++i)
        for (int j = 0; i + j <= samples_per_edge; ++j)
            visit(Vec3((i * vertices[t[0]] + j * vertices[t[1]] + (samples_per_edge - i - j) * vertices[t[2]]) /
                       samples_per_edge));
}

/// Compares a result with the input: finds facets that meet, and points too far from the other surface. Returns for
/// each facet of the input whether the result is refused there, and puts the distances into the report. `input_tree` is
/// of the facets of `input`. O(#F log #F).
std::vector<char> inspect(const SurfaceArrays& input, const TriangleTree& input_tree, const RemeshOptions& options,
                          const SurfaceArrays& result, RemeshReport& report);

}  // namespace kerf
