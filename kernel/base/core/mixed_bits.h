// Numbers that look random, computed from other numbers, the same on every machine.
#pragma once

#include <cstdint>

namespace kerf {

/// Maps 64 bits to 64 bits one to one, so that every bit of `bits` influences every bit of the result (the finaliser of
/// splitmix64).
constexpr std::uint64_t mixed_bits(std::uint64_t bits) {
    bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
    return bits ^ bits >> 31;
}

/// Returns the random number at this place of a sequence that is always the same (splitmix64, seeded by 0).
constexpr std::uint64_t random_bits(std::uint64_t place) { return mixed_bits((place + 1) * 0x9e3779b97f4a7c15); }

}  // namespace kerf
