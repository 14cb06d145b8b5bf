// The file that holds the font of the user interface.
#pragma once

#include <string>

namespace kerf::view {

struct FontFile {
    std::string path;  ///< empty: none was found
    int number = 0;    ///< index of the font in a collection
};

/// Returns the TrueType font of the family, or the one that fontconfig offers in its place, with Latin letters. It
/// takes some milliseconds; where fontconfig has no cache, some for each font of the system.
FontFile find_font(const std::string& family);

}  // namespace kerf::view
