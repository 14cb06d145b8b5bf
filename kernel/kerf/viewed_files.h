// What is in memory as files that kerf-view opens.
#pragma once

#include <string>

#include "kerf/kerf.h"

namespace kerf {

/// An OBJ with all digits, the patches as groups; of several regions beside it the JSON that says what these bound,
/// which may divide patches. Throws Error(io).
void write_surface_to_view(const ClosedSurface& surface, const std::string& path);

/// A folder with the parts of a mesh as a run has them, and as much of its report as the viewer asks for: it is no
/// result, and has no hashes. Throws Error(io), and as for_each_part_of().
void write_mesh_to_view(const MeshArrays& mesh, const std::string& folder);

}  // namespace kerf
