// Closed surfaces whose facets a Delaunay triangulation does not have: thin, folded, nested, near-touching, coplanar,
// cospherical, with needles, full of reflex edges.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "support/seeded_numbers.h"
#include "surface/complex/surface.h"
#include "surface/soup/soup.h"

namespace kerf::test {

struct HardFamily {
    const char* name;
    /// Of some `facets` facets: half as many to twice as many, mostly.
    Soup (*make)(int facets, SeededNumbers& random);
};

/// All of them, in a fixed order.
std::span<const HardFamily> hard_families();

/// The number of a family of that name. Throws Error(usage) with all names where there is none.
std::size_t hard_family_number(const std::string& name);

struct HardSurface {
    const char* family;
    SurfaceArrays surface;
};

/// A surface of the family of seed modulo their number, turned, scaled by 1e-3 to 1e3 and moved at random, of 20
/// to some 2,000 facets: small ones are as frequent as large ones, by orders of magnitude. No facet is lower than 1e-8
/// of its longest edge. Where chance makes one, or facets that meet, which is found exactly
/// (surface/diagnosis/diagnosis.h), the next surface that chance gives is taken; nothing where that happens ten times.
/// Deterministic.
std::optional<HardSurface> hard_surface(std::uint64_t seed, int most_facets = 2000);

}  // namespace kerf::test
