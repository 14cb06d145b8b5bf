// Surfaces and meshes in memory as files that kerf-view opens.
#pragma once

#include <string>

#include "kerf/kerf.h"

namespace kerf {

/// Writes an OBJ with all digits and the patches as groups; for several regions, whose walls may divide patches, also
/// the JSON beside it that names the two regions of each group. Throws Error(io).
void write_surface_to_view(const ClosedSurface& surface, const std::string& path);

/// Writes a folder with the parts of a mesh as a run has them, and as much of its report as the viewer asks for, with
/// the hashes of the files: it is no result of a run. Throws Error(usage) for a mesh without tetrahedra, Error(io), and
/// as for_each_part_of().
void write_mesh_to_view(const MeshArrays& mesh, const std::string& folder);

}  // namespace kerf
