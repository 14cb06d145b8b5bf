// Random numbers that are the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/core/mixed_bits.h"

namespace kerf::test {

/// A sequence that its seed tells. Neighbouring seeds have nothing in common.
class SeededNumbers {
 public:
    explicit SeededNumbers(std::uint64_t seed) : state_(random_bits(seed)) {}

    std::uint64_t bits() { return mixed_bits(state_ += 0x9e3779b97f4a7c15); }
    /// From 0 to below 1.
    double share() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * share(); }
    /// As likely near to `low` as near to `high`, in orders of magnitude. Requires 0 < low <= high.
    double magnitude(double low, double high) { return low * std::pow(high / low, share()); }
    /// Both ends included.
    int integer(int low, int high) {
        return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool with_chance(double chance) { return share() < chance; }

 private:
    std::uint64_t state_;
};

}  // namespace kerf::test
