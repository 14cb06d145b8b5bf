// Quality as one sheet of pictures (SVG).
#pragma once

#include <string>

#include "files/quality/inside/measured_mesh.h"

namespace kerf {

/// Returns a sheet with a panel for each measure: the distribution and below it the accumulated distribution of all
/// cells, of those with a vertex on an interface and of the others. The bytes depend on the quality alone.
std::string quality_sheet(const MeshQuality& quality);

/// Returns a sheet that compares all cells of two meshes. Both must have been measured with one length scale, else
/// throws Error(internal).
std::string comparison_sheet(const MeshQuality& first, const MeshQuality& second);

}  // namespace kerf
