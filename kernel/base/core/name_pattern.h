// Names of patches as users write them, in which '*' stands for any characters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"

namespace kerf {

/// Whether the pattern, in which '*' stands for any characters, is all of the text. O(n m).
inline bool matches_pattern(std::string_view pattern, std::string_view text) {
    std::vector<char> matched(text.size() + 1, 0);  // [i]: whether the pattern so far may be the first i characters
    matched[0] = 1;
    for (const char c : pattern) {
        if (c == '*') {
            for (std::size_t i = 0; i < text.size(); ++i)
                if (matched[i]) matched[i + 1] = 1;
            continue;
        }
        for (std::size_t i = text.size(); i > 0; --i) matched[i] = matched[i - 1] && text[i - 1] == c;
        matched[0] = 0;
    }
    return matched.back() != 0;
}

/// Returns the first twenty names in quotes with commas between, and how many more there are.
inline std::string listed_names(std::span<const std::string> names) {
    constexpr std::size_t most = 20;
    const std::size_t shown = std::min(names.size(), most);
    return fmt::format("'{}'{}", fmt::join(names.first(shown), "', '"),
                       names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "");
}

/// Returns the numbers of the names that match the pattern, ascending. Throws Error(usage) if there are none, with the
/// names that there are. `who`, such as "--size-on", has given the pattern, `kind` is what it stands for: "patch".
inline std::vector<std::int32_t> matching_names(std::string_view who, std::string_view kind, std::string_view pattern,
                                                std::span<const std::string> names) {
    std::vector<std::int32_t> matching;
    for (std::int32_t n = 0; n < count_of(names); ++n)
        if (matches_pattern(pattern, names[n])) matching.push_back(n);
    if (!matching.empty()) return matching;
    throw Error(ErrorCode::usage, fmt::format("{} names the {} '{}', which the surface does not have. It has {}.", who,
                                              kind, pattern, names.empty() ? "none" : listed_names(names)));
}

}  // namespace kerf
