// The text of a row of the tree, in words.
#pragma once

#include <string>

#include "viewer/model/tree.h"
#include "viewer/panels/inside/style.h"

namespace kerf::view {

/// Returns the state of a part, or the way in which an inner node was cut.
std::string word_of(const TreeRow& row, bool running);
/// Returns the colour of that word, by whether the row went well, is under way, or deserves a look.
ImVec4 color_of(const TreeRow& row, const Palette& colors);
/// Returns all that is known of the row, a line each. `region`: the region in which all of it lies; null where that has
/// no name.
std::string details(const TreeRow& row, const std::string* region);

}  // namespace kerf::view
