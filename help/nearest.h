// The known word that an unknown one may have been meant to be.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// Returns the candidate that is the fewest changes away from the word, the first of several; a change adds, leaves out
/// or replaces a letter or swaps it with the next one. More than max(1, letters / 3) changes are too many: then it
/// returns the first candidate that begins with the word, or nothing.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// Returns " Did you mean X?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace kerf
