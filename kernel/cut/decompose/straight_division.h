// The division of parts without a contour of edges by straight cuts, after all other strategies.
#pragma once

#include "cut/decompose/decomposition.h"

namespace kerf {

/// Divides every leaf that wants more than one part by straight cuts, recursively, and returns the leaves of `range`.
///
/// `whole` holds all nodes and leaves of decompose(). A straight cut splits facets, and facets of interfaces belong to
/// two parts, so the parts are not independent here: every rank makes all straight cuts, on one complex of faces, in
/// the order of the tree. Interfaces are triangulated after the last cut. The result depends on `whole` and the options
/// only. Its contacts are those of `whole`, as straight cuts have divided them. A part that no plane divides stays
/// whole. O(n log n) per cut for n facets of the part and beside its section.
Decomposition divide_straight(Decomposition whole, const DecomposeOptions& options, LeafRange range,
                              CutListener* listener = nullptr);

}  // namespace kerf
