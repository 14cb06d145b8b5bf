// The file of a part in the format msh. It has the entities of the whole of which the part has something ($Entities: a
// volume for each material and a surface for each patch), those of the part ($PartitionedEntities), and the cells of
// other parts that touch it ($GhostElements).
#pragma once

#include "files/export/inside/export_files.h"
#include "files/part/part.h"

namespace kerf::msh {

void write_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files);

}  // namespace kerf::msh
