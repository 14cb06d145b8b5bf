// Makes words of the names of patches and regions, for formats that allow no other names.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// The rules of a format for words, beyond letters, digits, '_' and '-' of ASCII, a letter first.
struct WordRules {
    std::size_t most_characters = 80;
    bool ignores_case = false;                       ///< words must differ by more than case
    std::vector<std::string> taken = {};             ///< words that no name may become
    std::vector<std::string> taken_beginnings = {};  ///< beginnings that no word may have
    std::string kind = "patch";                      ///< kind of the named things, in front of words that begin badly
};

/// Returns a word for each name, no two the same. A name that is such a word stays as it is; of several that the format
/// cannot tell apart, the first. Otherwise every run of other characters becomes one '_', but none at the ends; a
/// result that does not begin with a letter, or begins as no word may, then gets "patch_" in front, by their kind; too
/// long ones are cut; and a word that is taken gets the first free one of _2, _3, ... at its end. Depends on the names
/// and their order alone. O(n log n).
std::vector<std::string> word_names(std::span<const std::string> names, const WordRules& rules = {});

/// Returns the name on one line, for comments: control characters become blanks.
std::string comment_text(std::string_view name);

}  // namespace kerf
