// A surface that was made of a CAD file, moved back onto the faces of that file.
#pragma once

#include <vector>

#include "run/prepare/input.h"
#include "run/request/run_request.h"

namespace kerf {

/// Moves the vertices of the surface onto the faces of the file as make_surface_nodes() says, and returns the points of
/// the faces that are nearest to the middles of all edges, in the order of PlacedSurface::edges; NaN for edges that end
/// beside the faces, since their vertices had to stay. Returns nothing, with a note, for an input of several files.
/// Throws as project_on_cad_file().
std::vector<Vec3> move_onto_cad(Input& input, const RunRequest& options);

}  // namespace kerf
