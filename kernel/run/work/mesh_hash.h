// Fingerprints of meshes, by which runs can be compared.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "files/part/part.h"

namespace kerf {

/// Returns the 128-bit hash (XXH3) of a part, little-endian: coordinates, tetrahedra, the boundary with its global
/// numbers, its patches and facets of the input, and the neighbours on the other side of interfaces. All of it is in a
/// part's file.
std::array<std::uint64_t, 2> hash_part(const Part& part);

/// The hash of a part by its leaf.
struct PartHash {
    std::int64_t leaf = 0;
    std::array<std::uint64_t, 2> hash = {0, 0};
};
/// Returns the hash of a whole mesh from those of its parts in the order of the tree, as 32 hexadecimal digits.
std::string hash_of_parts(std::span<const PartHash> parts);

}  // namespace kerf
