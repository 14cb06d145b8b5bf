// Fingerprints (XXH3) of bytes that come piece by piece.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/core/padding.h"

namespace kerf {

/// The 128 bits of Hasher::digest().
using FileHash = std::array<std::uint64_t, 2>;

/// Hashes the bytes that are added, in their order, however they are divided into pieces.
class Hasher {
 public:
    Hasher() { XXH3_128bits_reset(&state_); }

    void add_bytes(const void* data, std::size_t size) { XXH3_128bits_update(&state_, data, size); }
    /// Adds the number of items, then their bytes.
    template <class T>
    void add(std::span<const T> items) {
        static_assert(HasNoPadding<T>::value);
        const std::uint64_t count = items.size();
        add_bytes(&count, sizeof count);
        add_bytes(items.data(), items.size_bytes());
    }
    /// Returns the hash of all bytes added so far: 128 bits, the higher 64 first.
    FileHash digest() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(&state_);
        return {hash.high64, hash.low64};
    }

 private:
    XXH3_state_t state_;
};

/// Returns the hash of bytes that are all at hand.
inline FileHash digest_of(std::string_view bytes) {
    Hasher hasher;
    hasher.add_bytes(bytes.data(), bytes.size());
    return hasher.digest();
}

/// Returns a hash of 64 bits, which tells damaged bytes from good ones.
inline std::uint64_t hash_bytes(std::span<const char> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace kerf
