// Names of patches and regions as words, for formats that allow no others.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// What a format asks of its words beyond letters, digits, '_' and '-' of ASCII, a letter first.
struct WordRules {
    std::size_t most_characters = 80;
    bool ignores_case = false;                       ///< so that words must differ by more than case
    std::vector<std::string> taken = {};             ///< words that no name may become
    std::vector<std::string> taken_beginnings = {};  ///< with which no word may begin
    std::string kind = "patch";                      ///< what the names are of
};

/// A word for each name, no two the same. A name that is such a word stays as it is; of several that the format cannot
/// tell apart, the first. Otherwise every run of other characters becomes one '_', but none at the ends; what does not
/// begin with a letter, or begins as no word may, then gets "patch_" in front, by their kind; too long ones are cut;
/// and a word that is taken gets the first free one of _2, _3, ... at its end. Depends on the names and their order
/// alone. O(n log n).
std::vector<std::string> word_names(std::span<const std::string> names, const WordRules& rules = {});

/// The name on one line, for comments: control characters become blanks.
std::string comment_text(std::string_view name);

}  // namespace kerf
