// Bodies of several regions by formula: what their surfaces are not made of cubes.
#pragma once

#include "surface/soup/soup.h"

namespace kerf::test {

/// Each facet once with what lies on its sides (Soup::sides, Soup::region_names). `fineness`: a number of facets along
/// every edge and around every circle is multiplied by it; 1 is as coarse as the shapes allow.
///
/// A ball of radius 1 in the middle of a cube of edge 3.
Soup ball_in_cube(int fineness);

/// Two rings, each through the hole of the other, in a box. Neither touches the other or the box.
Soup linked_rings_in_box(int fineness);

/// A block of 4 x 4 x 3, and four round fibres along z whose ends are in its upper side. The other ends of two are in
/// its lower side; those of two lie inside.
Soup fibres_in_block(int fineness);

}  // namespace kerf::test
