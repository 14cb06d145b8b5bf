// TetGen 1.5 behind the interface of mesher.h.
#pragma once

#include "fill/volume/mesher.h"

namespace kerf {

/// Fills a surface by TetGen, see mesh_volume(), with one point of `holes` in every void. Requires checked options.
///
/// TetGen may print warnings to the standard output, so a caller that sends data there must keep it apart. It aborts
/// the process on flat or non-finite input. The orientation of tetrahedra is TetGen's in normalised coordinates; far
/// from the origin the rounding of interior vertices could turn a sliver, which verify_mesh() tells.
TetMesh mesh_with_tetgen(const SurfaceArrays& surface, const std::vector<Vec3>& holes, const MesherOptions& options);

/// Checks an expert's switches. Throws Error(usage) for switches that TetGen does not know or that ask for something
/// else than a linear mesh of the surface. Empty ones are good.
void check_tetgen_switches(const std::string& switches);

}  // namespace kerf
