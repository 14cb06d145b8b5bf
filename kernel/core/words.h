// Names of the program as people read them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace kerf {

/// "first-try", as files and options spell it, in words: "first try".
inline std::string in_words(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '-', ' ');
    return words;
}

}  // namespace kerf
