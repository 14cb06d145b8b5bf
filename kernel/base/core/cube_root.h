// The cube root, the same for any unit of length.
#pragma once

#include <cmath>

namespace kerf {

/// Returns the cube root of x >= 0, within 2^-52. The root of 8^k x is 2^k times that of x to the last bit, which
/// std::cbrt() does not promise.
inline double cube_root(double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    const int rest = ((exponent % 3) + 3) % 3;
    return std::ldexp(std::cbrt(std::ldexp(mantissa, rest)), (exponent - rest) / 3);
}

}  // namespace kerf
