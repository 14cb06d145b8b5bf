// Options that had other names in older versions. They are answered with the new ones.
#pragma once

#include <string_view>

namespace kerf {

struct OldSpelling {
    std::string_view commands;  ///< commands that had it, with spaces between
    std::string_view option;    ///< option with its dashes
    std::string_view value;     ///< value that alone is spelled otherwise now; empty: the option itself is
    std::string_view now;       ///< option and value that mean the same now
};

inline constexpr OldSpelling old_spellings[] = {
    {"screenshot", "--size", "", "--resolution WxH"},
    {"view screenshot", "--case", "", "--load-case NAME"},
    {"mesh decompose solve", "--remesh", "", "--surface remesh"},
    {"mesh decompose solve view screenshot", "--surface", "by-file", "--surface auto"},
    {"mesh decompose solve view screenshot", "--surface", "remesh-cad", "--surface auto"},
};

}  // namespace kerf
