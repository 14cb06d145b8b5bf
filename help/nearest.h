// What a word that nobody knows may have been meant to be.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// The candidate into which the fewest letters turn that are added, left out, changed or swapped with the next one; the
/// first of several. If that is more than one letter in three, the first one that begins with the word; else empty.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// " Did you mean X?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace kerf
