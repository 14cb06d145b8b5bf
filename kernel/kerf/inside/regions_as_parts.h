// A mesh in memory as parts that can be written.
#pragma once

#include <vector>

#include "files/part/part.h"
#include "files/part/shared_vertices.h"
#include "kerf/kerf.h"

namespace kerf {

/// The regions of a mesh of arrays, a part each, with walls between them. Facets of the input are triangles of the
/// mesh, by their rows. Parts know which vertices they share with others, but not which edges. Memory: the vertices on
/// walls, and the parts that are loaded. The mesh must outlive it.
class RegionsAsParts : public PartSource {
 public:
    explicit RegionsAsParts(const MeshArrays& mesh);

    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override;

 private:
    std::vector<std::int64_t> boundary_vertices_of(RegionIndex region) const;

    const MeshArrays& mesh_;
    MeshOutline outline_;
    Array<PartIndex, RegionIndex> regions_;      // the region of each part
    Array<RegionIndex, NodeId> part_of_region_;  // -1: none
    SharedVertices shared_;
};

}  // namespace kerf
