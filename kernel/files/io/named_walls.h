// The regions on the two sides of each patch of a surface, read from a JSON beside it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "surface/regions/region_finder.h"

namespace kerf {

/// Reads an object with two names of regions for each patch, null for the outside, in any order:
///
///     {"wall": ["bone", "cement"], "outer": ["bone", null]}
///
/// Returns the walls in the order of `patch_names`, the patches of the surface. Throws Error(input), naming `path` and
/// the patch, for bytes that are no such object, a patch that is there twice, one that the surface does not have, one
/// that is missing, and one that does not separate two regions, or a region from the outside.
std::vector<NamedWall> read_named_walls(std::string_view bytes, const std::string& path,
                                        const std::vector<std::string>& patch_names);

}  // namespace kerf
