// kerf remesh: a surface worth meshing, as a file.
#pragma once

#include <string>

#include "request/options.h"

namespace kerf {

/// Remeshes options.input within options.deviation to the wanted lengths and writes it to `output`, an .obj with
/// patches or an .stl. Tells what was done. Returns the exit code. Throws Error.
int remesh_surface(const RunOptions& options, const std::string& output, bool quiet);

}  // namespace kerf
