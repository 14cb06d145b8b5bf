// Which file holds the font of the user interface.
#pragma once

#include <string>

namespace kerf::view {

struct FontFile {
    std::string path;  ///< empty: none was found
    int number = 0;    ///< of the font in a collection
};

/// The TrueType font of the family or what fontconfig offers in its place, with Latin letters. Some milliseconds; where
/// fontconfig has no cache, each font of the system takes some.
FontFile find_font(const std::string& family);

}  // namespace kerf::view
