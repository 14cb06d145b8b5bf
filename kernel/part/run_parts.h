// The parts of a finished run.
#pragma once

#include <string>

#include "part/part.h"
#include "part/shared_vertices.h"

namespace kerf {

/// The parts in a run folder. Memory: the vertices on interfaces, and the parts that are loaded.
class RunParts : public PartSource {
 public:
    /// Reads report.json and the surfaces of the parts. Throws Error(io) for what is no finished run, or one with parts
    /// that were not meshed, naming it and the way out.
    explicit RunParts(std::string folder);

    const MeshOutline& outline() const override { return outline_; }
    Part load(std::int32_t rank) const override;

 private:
    std::string folder_;
    MeshOutline outline_;
    SharedVertices shared_;
};

/// load() of RunParts, by the number of the leaf.
Part load_part(const RunParts& run, NodeId id);

}  // namespace kerf
