// Makes facets hold the volume of the solid with few chords.
#pragma once

#include <vector>

#include "base/core/ids.h"
#include "files/cad/inside/tessellation.h"

namespace kerf::cad {

/// Returns the volume between the facets and their faces, whichever side it is on, in mm3: the volume that chords leave
/// out or add.
double volume_between(const Tessellation& mesh);

/// Moves vertices off their faces until the facets hold `volume` (mm3, signed as Tessellation::volume). Chords on a
/// curve leave out the volume between them and it; vertices that stand out by the mean height of that give it back, and
/// their distance from the curve is no larger than that of the chords was. Vertices of planar faces stay in their
/// planes.
///
/// Returns false, and nothing is moved, if the difference is not the volume that the facets have missed of their faces.
/// The result may intersect itself. O(#F log #F), deterministic.
bool balance_volume(Tessellation& mesh, double volume);

/// Returns the volumes of the regions of facets with `sides`.
Array<RegionIndex, double> region_volumes(const Tessellation& mesh, std::size_t regions);

/// Returns volume_between() for each region; facets of walls count for both.
Array<RegionIndex, double> volumes_between(const Tessellation& mesh, std::size_t regions);

/// Does the same as balance_volume() for facets with `sides`; `volumes`: of all regions. A vertex of a wall moves for
/// both of its regions: of all moves that give every region its volume those are taken that differ the least from the
/// moves that the faces ask for. `is_fixed`: for each vertex, whether it stays. O(#F (log #F + regions)).
bool balance_volumes(Tessellation& mesh, const Array<RegionIndex, double>& volumes, const std::vector<char>& is_fixed);

}  // namespace kerf::cad
