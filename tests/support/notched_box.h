// Chazelle's polyhedron.
#pragma once

#include "support/seeded_numbers.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// A box with so many notches from below, along x, and from above, along y, whose ridges nearly meet on the surface
/// z = x y, so that tetrahedra between them need many points more (chazelle1984). `gap`: between the ridges; `width`:
/// half of a notch's, where the notches are 1 apart. The sides are triangulated at random. 24 notches + 12 facets.
Soup notched_box(int notches, double gap, double width, SeededNumbers& random);

}  // namespace kerf::test
