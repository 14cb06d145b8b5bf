// The piece of each patch that a part has.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "files/part/part.h"

namespace kerf {

/// The triangles that a part lists on one patch, and the nodes that count as lying there: the nodes of a wall count on
/// both of its sides, though only one part lists its triangles.
struct PatchPiece {
    std::int32_t patch = -1;
    std::vector<std::int32_t> facets;  ///< numbers of facets of the part, ascending
    std::vector<std::int32_t> places;  ///< numbers of `facets` among all facets that the part lists, from 0
    std::vector<std::int32_t> nodes;   ///< nodes on this patch and on none before it
    Eigen::AlignedBox3d box;           ///< box of the triangles' nodes
};

/// The pieces of all patches in a part. Every node is listed once: on its first patch, or else inside.
struct PatchPieces {
    std::vector<PatchPiece> on_patches;  ///< ascending by patch; only patches that the part touches
    std::vector<std::int32_t> inside;    ///< nodes on no patch
    Eigen::AlignedBox3d box;             ///< of the part
};

/// Returns the number of pieces without triangles.
std::int64_t pieces_without_facets(const PatchPieces& pieces);

/// Returns the pieces of a part. O(#V + #E + #F + the largest number of a patch).
PatchPieces patch_pieces(const Part& part);
/// Returns the pieces with only those nodes that the part owns: the pieces of all parts list every node of the whole
/// once.
PatchPieces owned_patch_pieces(const Part& part);

}  // namespace kerf
