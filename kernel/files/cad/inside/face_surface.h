// The surface in which a face of a model lies.
#pragma once

#include "files/io/cad_body.h"

class TopoDS_Face;

namespace kerf::cad {

/// Returns kind and radii of the surface of a face, in the units of the model, without the name of a patch.
PatchFace surface_of(const TopoDS_Face& face);

}  // namespace kerf::cad
