// Files that are meshed together, read as one soup.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/request/input_options.h"
#include "surface/regions/region_finder.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The content of the input and of InputOptions::more_files.
struct InputFiles {
    Soup soup;
    std::string hash;  ///< hash of the bytes of the file, or of the hashes of all files, see hash_text()
    std::vector<std::int32_t> file_of_patch;  ///< the file of each patch; empty for one file
    std::vector<std::string> names;           ///< stems of the files, all different; empty for one file
    std::string walls_file = {};              ///< the JSON beside a single file, if it is there
    std::vector<NamedWall> walls = {};        ///< the regions that this JSON names for patches; empty: there is none
    bool is_welded = false;                   ///< whether no two vertices of `soup` are equal, see HashedSoup
    std::vector<PatchFace> faces_of_patches = {};  ///< of CAD files; patches that have other names now have none
};

/// Returns the path of the JSON that names the regions which the patches of a file bound: the path of the file with
/// ".regions.json" behind it.
std::string walls_path(const std::string& path);

/// Reads files with read_surface_or_cad(). A single file is returned as that does. For several files, facets, vertices
/// and patches follow each other, and so do their numbers; a patch is called as the file if that has one patch, else
/// "file/patch". For a single file, walls_path() is read if it is there, see read_named_walls(); its bytes are in the
/// hash then. Throws as read_surface_or_cad(), Error(usage) if one of several files has regions already or is given
/// twice, and Error(input) if one of several, or one that has regions, has such a JSON.
InputFiles read_input_files(const std::string& path, const InputOptions& options);

}  // namespace kerf
