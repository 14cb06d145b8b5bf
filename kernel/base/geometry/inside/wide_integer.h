// Integers of a fixed number of 64-bit limbs, for signs of determinants.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace kerf {

/// A whole number in two's complement, lowest limb first. A product has the limbs of both factors, so it is exact; sums
/// and differences must fit into the limbs that their terms have.
template <std::size_t limbs>
struct WideInteger {
    std::array<std::uint64_t, limbs> limb;

    bool is_negative() const { return limb[limbs - 1] >> 63 != 0; }
    int sign() const {
        if (is_negative()) return -1;
        for (const std::uint64_t x : limb)
            if (x != 0) return 1;
        return 0;
    }
};

namespace detail {
__extension__ using DoubleLimb = unsigned __int128;

template <std::size_t n>
void subtract_from_upper_limbs(std::uint64_t* upper, const WideInteger<n>& b) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const DoubleLimb difference = DoubleLimb{upper[i]} - b.limb[i] - borrow;
        upper[i] = static_cast<std::uint64_t>(difference);
        borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
    }
}
}  // namespace detail

template <std::size_t n>
WideInteger<n> operator+(const WideInteger<n>& a, const WideInteger<n>& b) {
    WideInteger<n> sum;
    detail::DoubleLimb carry = 0;
    for (std::size_t i = 0; i < n; ++i) {
        carry += detail::DoubleLimb{a.limb[i]} + b.limb[i];
        sum.limb[i] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
    }
    return sum;
}

template <std::size_t n>
WideInteger<n> operator-(WideInteger<n> a, const WideInteger<n>& b) {
    detail::subtract_from_upper_limbs(a.limb.data(), b);
    return a;
}

template <std::size_t n, std::size_t m>
WideInteger<n + m> operator*(const WideInteger<n>& a, const WideInteger<m>& b) {
    WideInteger<n + m> product{};
    for (std::size_t i = 0; i < n; ++i) {
        detail::DoubleLimb carry = 0;
        for (std::size_t j = 0; j < m; ++j) {
            carry += detail::DoubleLimb{a.limb[i]} * b.limb[j] + product.limb[i + j];
            product.limb[i + j] = static_cast<std::uint64_t>(carry);
            carry >>= 64;
        }
        product.limb[i + m] = static_cast<std::uint64_t>(carry);
    }
    // Read as unsigned numbers, negative factors are 2^(64 n) or 2^(64 m) too large.
    if (a.is_negative()) detail::subtract_from_upper_limbs(product.limb.data() + n, b);
    if (b.is_negative()) detail::subtract_from_upper_limbs(product.limb.data() + m, a);
    return product;
}

}  // namespace kerf
