// One mesh of OpenFOAM for each region, as its programs for several regions want them.
#pragma once

#include <string>
#include <vector>

#include "files/export/inside/openfoam_mesh.h"
#include "files/part/region_walls.h"

namespace kerf::openfoam {

/// The names of the meshes of regions and their patches, which are the same in all processors.
///
/// A mesh has the patches of the surface that its region has outer triangles of, and behind them one for each region
/// beside it, ascending: the patch A_to_B of A and B_to_A of B are mapped to each other, as splitMeshRegions writes
/// them.
class RegionMeshes {
 public:
    /// Takes the parts, which must outlive this. Throws Error(io).
    RegionMeshes(const PartSource& parts, std::span<const PatchType> types);

    std::int32_t count() const { return std::ssize(words_); }
    const std::string& word(RegionIndex region) const { return words_[region]; }
    const std::string& name(RegionIndex region) const { return outline_.region_names[region.value()]; }
    /// Returns the patches of a region's mesh, without faces.
    std::vector<Patch> patches(RegionIndex region) const;
    /// Returns the cells of a region in a part as a part of their own; there may be none. The mesh of the part must
    /// have neighbours, and so has that of the result. Vertices and cells keep their order; Part::patch is a place in
    /// patches(). O(#T + #V).
    Part part_of(const Part& part, RegionIndex region) const;

 private:
    std::int32_t wall_patch(RegionIndex region, RegionIndex other) const;

    const MeshOutline& outline_;
    const RegionWalls& walls_;
    std::vector<Patch> of_surface_;
    Array<RegionIndex, std::string> words_;
    Array<RegionIndex, std::vector<std::string>> wall_words_;  // in the order of RegionWalls::neighbours()
};

}  // namespace kerf::openfoam
