// Facets that hold what the solid holds, with few chords.
#pragma once

#include "cad/tessellation.h"

namespace kerf::cad {

/// Volume between the facets and their faces, whichever side it is on, in mm3: what chords leave out or add.
double volume_between(const Tessellation& mesh);

/// Moves vertices off their faces until the facets hold `volume` (mm3, signed as Tessellation::volume). Chords on a
/// curve leave out what is between them and it; vertices that stand out by the mean of that give it back, and their
/// distance from the curve is no larger than that of the chords was. Vertices of planar faces stay in their planes.
///
/// False, and nothing is moved, if the difference is not what the facets have missed of their faces. The result may
/// intersect itself. O(#F log #F), deterministic.
bool balance_volume(Tessellation& mesh, double volume);

}  // namespace kerf::cad
