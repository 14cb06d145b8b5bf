// What a solution has found, in Gmsh's files.
#pragma once

#include "export/msh_writer.h"

namespace kerf::msh {

/// Throws Error(usage) for values of a mesh whose tags have more than the 32 bits that $NodeData and $ElementData take.
void require_tags_fit(const MeshOutline& outline);

void write_part_values(const MeshOutline& outline, PartIndex index, const Part& part, Writer& writer);
void write_merged_values(const PartSource& parts, Writer& writer);

}  // namespace kerf::msh
