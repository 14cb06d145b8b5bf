// Wavefront OBJ: a surface with all digits and with names.
#pragma once

#include <string>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Writes a group for each patch that has facets, in the order of the patches, under its name with _ for white space,
/// which OBJ cannot hold. `patch`: #F, in range of `patch_names`. Reading gives the coordinates bit for bit. Throws
/// Error(io).
void write_obj(const std::string& path, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
               const std::vector<std::int32_t>& patch, const std::vector<std::string>& patch_names);

}  // namespace kerf
