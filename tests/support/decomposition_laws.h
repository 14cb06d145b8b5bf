// The laws of a decomposition without its meshes, checked from the leaves and the input alone.
#pragma once

#include <string>

#include "cut/decompose/decomposition.h"

namespace kerf::test {

/// The defaults, for so many parts.
inline DecomposeOptions in_parts(std::int32_t parts) {
    DecomposeOptions options;
    options.parts = parts;
    return options;
}

/// All leaves, by contours of edges and, where these leave parts whole and facets may be split, by straight cuts.
Decomposition decompose_whole(const Surface& surface, const DecomposeOptions& options, CutListener* listener = nullptr);

/// The laws that all leaves of `input` break, each with a count; empty if all hold. The input may touch itself, with
/// one vertex at each place.
///
/// Every leaf is a closed 2-manifold without self-intersections (exact); volumes add up to the enclosed one; every
/// facet of the input lies once in one leaf, with its vertices, orientation and patch, or its pieces cover it;
/// interface faces lie once on each side, turned round; vertex keys are dense per node of the tree, and equal keys mean
/// equal coordinates, bit for bit.
std::string broken_laws(const Decomposition& whole, const SurfaceArrays& input);

}  // namespace kerf::test
