// What a part has of each patch.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "part/part.h"

namespace kerf {

/// The triangles that a part lists on one patch, and the nodes that count as lying there: those of both sides of a
/// wall, of which one part lists the triangles.
struct PatchPiece {
    std::int32_t patch = -1;
    std::vector<std::int32_t> facets;  ///< of the part, ascending
    std::vector<std::int32_t> places;  ///< of the same among all facets that the part lists, from 0
    std::vector<std::int32_t> nodes;   ///< that are on no patch before this one
    Eigen::AlignedBox3d box;           ///< of the triangles' nodes
};

/// Every node is listed once: on its first patch, or else inside.
struct PatchPieces {
    std::vector<PatchPiece> on_patches;  ///< ascending by patch, none that the part does not touch
    std::vector<std::int32_t> inside;    ///< nodes on no patch
    Eigen::AlignedBox3d box;             ///< of the part
};

/// How many pieces have no triangles.
std::int64_t pieces_without_facets(const PatchPieces& pieces);

/// O(#V + #E + #F + the largest number of a patch).
PatchPieces patch_pieces(const Part& part);
/// The pieces with those nodes alone that the part owns: those of all parts list every node of the whole once.
PatchPieces owned_patch_pieces(const Part& part);

}  // namespace kerf
