// The axis of a body that points up.
#pragma once

#include "viewer/model/document.h"

namespace kerf::view {

/// Returns the axis (0 to 2) that points up as far as one can guess: z, as in CAD and simulation, but y where an OBJ
/// file, of programs that have y up, holds a body that is clearly tallest or flattest along y. It is the same for a
/// surface and its runs.
int guessed_up(const Document& document);

}  // namespace kerf::view
