// A surface file repaired for its own sake, and written to another file.
#pragma once

#include <string>

#include "prepare/input.h"
#include "request/input_options.h"

namespace kerf {

/// What repair_file() has written.
struct RepairedFile {
    CheckedSoup checked;        ///< what was written, and what is still wrong with it
    bool is_unchanged = false;  ///< nothing was found to be repaired
};

/// Does what `options` ask for to a file, and writes what came of it to `output`, an .obj with patches or an .stl,
/// whether it can be meshed or not. Throws Error, before the work where the output cannot be written.
RepairedFile repair_file(const std::string& path, const InputOptions& options, const std::string& output);

}  // namespace kerf
