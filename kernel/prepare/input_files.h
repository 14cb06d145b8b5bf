// Files that are meshed together, as one soup.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "request/input_options.h"
#include "surface/soup.h"

namespace kerf {

/// What the input and InputOptions::more_files say.
struct InputFiles {
    Soup soup;
    std::string hash;  ///< of the bytes of the file, or of the hashes of all files, see hash_text()
    std::vector<std::int32_t> file_of_patch;  ///< empty for one file
    std::vector<std::string> names;           ///< of the files: their stems, all different; empty for one file
};

/// Reads them with read_surface_or_cad(). A file alone is what that returns. Of several, facets, vertices and patches
/// follow each other, and so do their numbers; the patches are called as the file if that has one, else "file/patch".
/// Throws as read_surface_or_cad(), and Error(usage) if one of several files has regions already.
InputFiles read_input_files(const std::string& path, const InputOptions& options);

}  // namespace kerf
