// Bodies of several regions, made of cubes: every way in which regions can touch.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "surface/complex/complex.h"

namespace kerf::test {

/// The region of each cube of a grid, -1 for none.
using RegionOfCube = std::function<std::int32_t(std::array<std::int32_t, 3> cube)>;

/// What lies between cubes of different regions: two triangles a square, unit cubes in the box from the origin. The
/// regions that occur get the numbers from 0 in their order, and are called "region_0", "region_1", ... Patches: 0
/// outside, 1 between regions.
struct VoxelBody {
    SurfaceArrays facets;
    std::vector<FacetSides> sides;
    std::vector<std::string> names;
    Array<RegionIndex, double> volumes;  ///< of the regions
};
VoxelBody voxel_body(std::array<std::int32_t, 3> cubes, const RegionOfCube& region);

/// The cubes as a MEDIT .mesh, six tetrahedra each, of which the reference is the region and 1.
void write_tets(const std::string& path, std::array<std::int32_t, 3> cubes, const RegionOfCube& region);

/// The grid with each cube divided into n^3, and of n times the size.
RegionOfCube refined(RegionOfCube region, std::int32_t n);

/// The nearest of `count` places that depend on the seed: grains.
RegionOfCube grains(std::array<std::int32_t, 3> cubes, std::int32_t count, std::uint32_t seed);

struct TouchingBodies {
    const char* name;
    std::array<std::int32_t, 3> cubes;
    RegionOfCube region;
};
/// Ten ways in which bodies touch each other and themselves.
std::vector<TouchingBodies> touching_bodies();

inline Complex to_complex(const VoxelBody& body) { return {body.facets, body.sides, body.names}; }

}  // namespace kerf::test
