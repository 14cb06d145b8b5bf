// The size field of a run, from its options and the file that they name.
#pragma once

#include <string>
#include <vector>

#include "run/request/options.h"
#include "surface/size/size_options.h"

namespace kerf {

/// Makes the field as make_size_field(), with the background mesh that the options name or hold. Throws Error(io) or
/// Error(input) for a file that cannot be read or has no positive scalar at each of its nodes, Error(usage) as
/// make_size_field() does.
SizeField read_size_field(const SizeOptions& options, const SurfaceArrays& surface,
                          const std::vector<std::string>& patch_names);

/// Returns options by which cuts, forecasts and the mesher obey the sizes that are asked for over this surface;
/// unchanged where sizes do not depend on the place. Throws as read_size_field() does.
RunOptions with_sizes_on(RunOptions options, const SurfaceArrays& surface, const std::vector<std::string>& patch_names);

}  // namespace kerf
