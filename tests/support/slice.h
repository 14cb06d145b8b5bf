// Long tests under the sanitizers, where everything takes several times as long: a slice of the cases of each.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace kerf::test {

/// Whether the environment asks for slices: KERF_TEST_SLICE is set, as ./run sanitize does, but not ./run sanitize all.
inline bool in_slices() { return std::getenv("KERF_TEST_SLICE") != nullptr; }

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

/// One case of a suite with many: skipped, and counted as that, where slices are asked for and this is not `wanted`.
#define KERF_SKIP_UNLESS_IN_SLICE(wanted) \
    if (::kerf::test::in_slices() && !(wanted)) GTEST_SKIP() << "not in the slice of the cases"
