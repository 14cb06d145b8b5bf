// Names of the program in the form in which people read them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace kerf {

/// Returns a name that files and options spell "first-try" in words: "first try".
inline std::string in_words(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '-', ' ');
    return words;
}

}  // namespace kerf
