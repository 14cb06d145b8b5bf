// Finds a choice by its name; only for the files of this folder.
#pragma once

#include <array>
#include <string>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf::view {

/// Returns the value of an enumeration by its name; the names are in the order of the values. Throws Error(usage)
/// naming all of them.
template <class Enum, std::size_t N>
Enum value_named(const std::array<const char*, N>& names, const std::string& text, const char* what) {
    for (std::size_t i = 0; i < N; ++i)
        if (text == names[i]) return static_cast<Enum>(i);
    throw Error(ErrorCode::usage, fmt::format("'{}' is no {}. There are {}.", text, what, fmt::join(names, ", ")));
}

}  // namespace kerf::view
