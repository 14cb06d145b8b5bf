// Numbers and places in the form in which people read them.
#pragma once

#include <string>

#include <fmt/format.h>

#include "base/core/types.h"

namespace kerf {

/// Returns 1234567 as "1,234,567".
inline std::string grouped(std::int64_t n) {
    std::string digits = std::to_string(n);
    for (auto i = std::ssize(digits) - 3; i > 0; i -= 3) digits.insert(i, ",");
    return digits;
}

/// Returns 12345678 as "12.3 M", 12345 as "12 k", 123456789012 as "1.2e+11".
inline std::string short_number(double n) {
    if (n >= 1e10) return fmt::format("{:.2g}", n);
    if (n >= 1e6) return fmt::format("{:.1f} M", n / 1e6);
    return n >= 1e3 ? fmt::format("{:.0f} k", n / 1e3) : fmt::format("{:.0f}", n);
}

/// Returns a point as "(1, 2.5, 0)", with nine digits.
inline std::string place_text(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x(), p.y(), p.z()); }

}  // namespace kerf
