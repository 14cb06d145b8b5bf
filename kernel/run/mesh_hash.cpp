#include "run/mesh_hash.h"

#include <fmt/format.h>

#include "core/hash.h"

namespace kerf {

std::array<std::uint64_t, 2> hash_part(const TetMesh& mesh, const SurfaceArrays& surface) {
    Hasher hasher;
    hasher.add(std::span(mesh.vertices));
    hasher.add(std::span(mesh.tets));
    hasher.add(std::span(surface.facets));
    hasher.add(std::span(surface.vertex_key));
    hasher.add(std::span(surface.facet_key));
    hasher.add(std::span(surface.patch));
    return hasher.digest();
}

std::string hash_of_parts(std::span<const PartHash> parts) {
    Hasher hasher;
    hasher.add(parts);
    const auto [high, low] = hasher.digest();
    return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace kerf
