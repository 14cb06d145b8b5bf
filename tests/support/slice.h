// Long tests under the sanitizers, where everything takes several times as long: a slice of the cases of each.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace kerf::test {

/// Whether this is the build of ./run sanitize, but not of ./run sanitize all.
constexpr bool in_slices() { return KERF_TEST_SLICE; }

/// Whether a sanitizer slows everything down.
constexpr bool is_sanitized() { return KERF_TEST_SANITIZED; }

/// All cases, or only some where slices are asked for.
template <class Case>
std::vector<Case> slice(std::vector<Case> all, std::vector<Case> some) {
    return in_slices() ? some : all;
}

inline std::vector<std::int32_t> slice(std::vector<std::int32_t> all, std::vector<std::int32_t> some) {
    return in_slices() ? some : all;
}

/// So many repetitions, or a third of them.
inline unsigned slice(unsigned all) { return in_slices() ? (all + 2) / 3 : all; }

}  // namespace kerf::test
