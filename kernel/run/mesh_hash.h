// Fingerprints of meshes, by which runs can be compared.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "mesh/tet_mesh.h"
#include "surface/surface.h"

namespace kerf {

/// 128-bit hash (XXH3) of coordinates, keys, facets and tetrahedra of a part, little-endian.
std::array<std::uint64_t, 2> hash_part(const TetMesh& mesh, const SurfaceArrays& surface);

/// The hash of a whole mesh from those of its parts in the order of the tree, as 32 hexadecimal digits.
struct PartHash {
    std::int64_t leaf = 0;
    std::array<std::uint64_t, 2> hash = {0, 0};
};
std::string hash_of_parts(std::span<const PartHash> parts);

}  // namespace kerf
