// Binary STL, for programs that read nothing else.
#pragma once

#include <string>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Writes the facets in their order, with unit normals (zero for a facet without area) and no attributes.
///
/// STL holds 32-bit floats: coordinates are rounded to 7 digits, so vertices that are closer than that coincide, and
/// far from the origin that may close a narrow gap. The VTU has all digits. Requires fewer than 2^32 facets, with
/// vertex numbers in range. An older file is replaced as a whole (files/io/output_file.h). Throws Error(io).
void write_stl(const std::string& path, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

}  // namespace kerf
