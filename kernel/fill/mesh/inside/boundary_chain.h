// A proof that cells have a given boundary, by a sum, without looking for their faces.
//
// The boundary of a set of tetrahedra, taken with signs, is the sum of their outward faces: the two sides of a face
// inside cancel each other. Put vertex v on a curve, at (r, r^2, r^3) for a number r(v): six times the signed volume of
// a tetrahedron is then the product of the six differences of its numbers (Vandermonde), and six times that of the cone
// from the origin over a triangle is the product of its three numbers and three differences. The former is the sum of
// the latter over the four outward faces, for any numbers. So the sum over all cells equals the sum over the triangles
// of a surface if their boundary is that surface. If it is not, the sums differ by a polynomial in all r(v) that is not
// zero, because no other triangle has the term r(a) r(b)^2 r(c)^3 of (a, b, c). Its degree is 6, so it vanishes for at
// most 6/p of all numbers in the field of p elements (Schwartz 1980, schwartz1980; Zippel 1979, zippel1979). Here p =
// 2^61 - 1, and the numbers come from a generator that no mesher asks.
#pragma once

#include <cstdint>

#include "base/core/mixed_bits.h"
#include "base/core/types.h"

namespace kerf {

/// A sum over cells or triangles, in any order. Two sums over the same boundary are equal; those over different ones
/// are equal with a probability of 3e-18. 10 ns a cell; no memory.
class BoundaryChain {
 public:
    /// Adds a cell. One that is turned round counts negative; one with two equal corners counts nothing.
    void add(const Tetrahedron& cell) {
        const std::uint64_t a = number(cell[0]), b = number(cell[1]), c = number(cell[2]), d = number(cell[3]);
        const std::uint64_t low = product(product(difference(b, a), difference(c, a)), difference(d, a));
        const std::uint64_t high = product(product(difference(c, b), difference(d, b)), difference(d, c));
        sum_ = reduced(sum_ + product(low, high));
    }
    /// Adds a triangle of a surface, whose corners run counter-clockwise seen from outside.
    void add(const Triangle& triangle) {
        const std::uint64_t a = number(triangle[0]), b = number(triangle[1]), c = number(triangle[2]);
        const std::uint64_t differences = product(product(difference(b, a), difference(c, a)), difference(c, b));
        sum_ = reduced(sum_ + product(product(product(a, b), c), differences));
    }

    bool operator==(const BoundaryChain& other) const { return sum_ % prime == other.sum_ % prime; }

 private:
    static constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;

    // Takes a value from 0 to 2^64 - 1 and returns an equal one of the field, from 0 to prime + 7: 2^61 is 1 there.
    static constexpr std::uint64_t reduced(std::uint64_t value) { return (value & prime) + (value >> 61); }
    // Returns the product of two factors below 2^62. As an integer it is below 2^124, so that its upper part is below
    // 2^63.
    static constexpr std::uint64_t product(std::uint64_t x, std::uint64_t y) {
        __extension__ using Wide = unsigned __int128;
        const Wide wide = static_cast<Wide>(x) * y;
        return reduced((static_cast<std::uint64_t>(wide) & prime) + static_cast<std::uint64_t>(wide >> 61));
    }
    // Returns the difference of two numbers of vertices, below 2^62.
    static constexpr std::uint64_t difference(std::uint64_t x, std::uint64_t y) { return x + (prime - y); }
    // Returns the number of a vertex, at most the prime.
    static constexpr std::uint64_t number(std::int32_t vertex) {
        return random_bits(static_cast<std::uint32_t>(vertex)) >> 3;
    }

    std::uint64_t sum_ = 0;
};

}  // namespace kerf
