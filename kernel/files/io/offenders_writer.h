// Writes the defects of a surface as a file to look at.
#pragma once

#include <string>

#include "surface/diagnosis/diagnosis.h"

namespace kerf {

/// Writes a VTU (ASCII) with nothing but the offenders: the facets of every defect, the edges of open loops, short and
/// non-manifold edges as lines, and a point at each defect. Cell arrays are Kind and Severity (numbers of the
/// enumerations, names of the kinds in the field data KindNames), Defect (number in the diagnosis) and Facet (number in
/// the file, -1 for lines and points). Facets and lines with a coordinate that is not finite are left out. Throws
/// Error(io).
void write_offenders(const std::string& path, const Soup& soup, const Diagnosis& diagnosis);

}  // namespace kerf
