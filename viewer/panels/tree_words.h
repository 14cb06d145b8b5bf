// What a row of the tree says in words.
#pragma once

#include <string>

#include "viewer/model/tree.h"
#include "viewer/panels/style.h"

namespace kerf::view {

/// The state of a part, or how an inner node was cut.
std::string word_of(const TreeRow& row, bool running);
/// Of that word: what went well, is under way, or deserves a look.
ImVec4 color_of(const TreeRow& row, const Palette& colors);
/// All that is known, a line each. `region`: in which all of it lies; null where that has no name.
std::string details(const TreeRow& row, const std::string* region);

}  // namespace kerf::view
