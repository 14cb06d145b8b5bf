// A part that could not be meshed, kept so that the failure can be repeated.
#pragma once

#include <string>

#include "fill/volume/mesher.h"
#include "surface/complex/surface.h"

namespace kerf {

/// Writes FOLDER/part_0011 with the data by which the mesher repeats the call (Mesher::reproducer), and part_0011.txt
/// with the reason, the place, the command line that repeats the call and the one that shows the part. Creates the
/// folder. Throws Error(io), and Error(usage) where no mesher has the name.
void write_failed_part(const std::string& folder, NodeId leaf, const SurfaceArrays& surface,
                       const MesherOptions& mesher, const std::string& reason);

}  // namespace kerf
