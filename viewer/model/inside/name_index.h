// Finds a choice by its name; only for the files of this folder.
#pragma once

#include <array>
#include <string>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf::view {

/// Returns the index of a text among the names. Throws Error(usage) naming all of them.
template <std::size_t N>
int index_of(const std::array<const char*, N>& names, const std::string& text, const char* what) {
    for (std::size_t i = 0; i < N; ++i)
        if (text == names[i]) return static_cast<int>(i);
    throw Error(ErrorCode::usage, fmt::format("'{}' is no {}. There are {}.", text, what, fmt::join(names, ", ")));
}

}  // namespace kerf::view
