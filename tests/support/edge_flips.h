// Surfaces with other diagonals.
#pragma once

#include "support/seeded_numbers.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// Flips edges between facets of nearly the same direction, at random: `share` tries for each facet. None becomes lower
/// than 1e-3 of its longest edge. Facets of a curved surface may meet then. The soup must be a closed, oriented
/// manifold.
Soup with_flips(Soup soup, double share, SeededNumbers& random);

}  // namespace kerf::test
