// The kinds of files that hold a surface, for lists of what can be opened and for messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kerf {

/// A kind of file, as people call it. Its content tells the format, not its ending.
struct SurfaceFormat {
    const char* words;         ///< "VTK's .vtp, .vtu or .vtk"
    std::string_view endings;  ///< endings that such files usually have, with spaces between: ".vtp .vtu .vtk"
    bool is_imported = false;  ///< a program of its own reads it, of CAD files or 3MF
};

/// Returns all kinds that can be read.
std::span<const SurfaceFormat> surface_formats();
/// Returns whether the name has the ending of one of them, in capitals or not, also before that of a compressed file.
bool has_surface_ending(std::string_view name);
/// Returns "STL, OBJ, ... or 3MF".
std::string words_of_surface_formats();

}  // namespace kerf
