// Files that are meshed together, as one soup.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "request/input_options.h"
#include "surface/region_finder.h"
#include "surface/soup.h"

namespace kerf {

/// What the input and InputOptions::more_files say.
struct InputFiles {
    Soup soup;
    std::string hash;  ///< of the bytes of the file, or of the hashes of all files, see hash_text()
    std::vector<std::int32_t> file_of_patch;  ///< empty for one file
    std::vector<std::string> names;           ///< of the files: their stems, all different; empty for one file
    std::string walls_file = {};              ///< the JSON beside one file, if it is there
    std::vector<NamedWall> walls = {};  ///< what the JSON beside one file says of its patches; empty: there is none
    bool is_welded = false;             ///< no two vertices of `soup` are equal, as HashedSoup has it
};

/// The JSON that says which regions the patches of a file bound: its name with ".regions.json" behind it.
std::string walls_path(const std::string& path);

/// Reads them with read_surface_or_cad(). A file alone is what that returns. Of several, facets, vertices and patches
/// follow each other, and so do their numbers; the patches are called as the file if that has one, else "file/patch".
/// Beside a file alone, walls_path() is read if it is there, see read_named_walls(); its bytes are in the hash then.
/// Throws as read_surface_or_cad(), Error(usage) if one of several files has regions already, and Error(input) if one
/// of them, or one that has regions, has such a JSON.
InputFiles read_input_files(const std::string& path, const InputOptions& options);

}  // namespace kerf
