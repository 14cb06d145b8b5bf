// Bodies of cubes.
#pragma once

#include "support/seeded_numbers.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// Some of edge^3 unit cubes, this share of them or more: where their surface would not be a manifold, the cubes around
/// are there, too. Several bodies with voids, by chance.
Soup random_cubes(int edge, double share, SeededNumbers& random);

}  // namespace kerf::test
