#include "run/mesh_hash.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace kerf {

namespace {

class Hasher {
 public:
    Hasher() { XXH3_128bits_reset(&state_); }
    template <class T>
    void add(std::span<const T> items) {
        const std::uint64_t count = items.size();
        XXH3_128bits_update(&state_, &count, sizeof count);
        XXH3_128bits_update(&state_, items.data(), items.size_bytes());
    }
    std::array<std::uint64_t, 2> digest() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(&state_);
        return {hash.high64, hash.low64};
    }

 private:
    XXH3_state_t state_;
};

}  // namespace

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

std::uint64_t hash_bytes(std::span<const char> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace kerf
