// The file of a part in the format msh. It says of which whole it is a part ($Entities: a volume for each material and
// a surface for each patch that the part has something of), which entities the part has ($PartitionedEntities), and
// which cells of other parts touch it ($GhostElements).
#pragma once

#include "export/export_files.h"
#include "part/part.h"

namespace kerf::msh {

void write_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files);

}  // namespace kerf::msh
