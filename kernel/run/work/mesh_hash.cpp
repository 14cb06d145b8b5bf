#include "run/work/mesh_hash.h"

#include <fmt/format.h>

#include "base/core/hash.h"

namespace kerf {

std::array<std::uint64_t, 2> hash_part(const Part& part) {
    Hasher hasher;
    hasher.add(std::span(part.mesh.vertices));
    hasher.add(std::span(part.mesh.tets));
    hasher.add(std::span(part.global_id).first(part.mesh.boundary_vertex_count));
    hasher.add(std::span(part.facets));
    hasher.add(std::span(part.patch));
    hasher.add(std::span(part.facet));
    hasher.add(std::span(part.neighbour));
    return hasher.digest();
}

std::string hash_of_parts(std::span<const PartHash> parts) {
    Hasher hasher;
    hasher.add(parts);
    const auto [high, low] = hasher.digest();
    return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace kerf
