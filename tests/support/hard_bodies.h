// Families of hard surfaces (support/hard_surfaces.h) that are not prisms alone.
#pragma once

#include <vector>

#include "base/core/types.h"
#include "support/seeded_numbers.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// Each of some `facets` facets. Facets of some may meet, by chance.
Soup nested(int facets, SeededNumbers& random);
Soup touching(int facets, SeededNumbers& random);
Soup spikes(int facets, SeededNumbers& random);
Soup grid(int facets, SeededNumbers& random);
Soup cospherical(int facets, SeededNumbers& random);
Soup reflex(int facets, SeededNumbers& random);
Soup woven(int facets, SeededNumbers& random);

/// A sphere or torus.
Soup smooth_body(int facets, SeededNumbers& random);
/// Made smaller by this factor along a random direction.
Soup squashed(Soup soup, double factor, SeededNumbers& random);
/// Fans from (0, 0, height) and, if that is not 0, (0, 0, -depth) over a polygon in the plane z = 0 around the origin.
Soup pyramid(const std::vector<Vec2>& polygon, double height, double depth, SeededNumbers& random);

}  // namespace kerf::test
