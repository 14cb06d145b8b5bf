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

/// A sequence of random numbers that follows from its state: the linear congruential generator of Knuth's MMIX, whose
/// upper bits are the better ones. Meshes and modes depend on its numbers to the last bit.
class RandomSequence {
 public:
    explicit constexpr RandomSequence(std::uint64_t state) : state_(state) {}

    constexpr std::uint64_t next() { return state_ = state_ * 6364136223846793005 + 1442695040888963407; }
    /// Returns the next number as one from -1/2 to 1/2, of 24 bits.
    constexpr double next_centred() { return (next() >> 40) * 0x1p-24 - 0.5; }

 private:
    std::uint64_t state_;
};

}  // namespace kerf
