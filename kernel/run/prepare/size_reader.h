// The size field of a run, from its options and the file that they name.
#pragma once

#include <string>
#include <vector>

#include "run/prepare/input.h"
#include "surface/size/size_options.h"

namespace kerf {

/// Returns the field as make_size_field() makes it, with the background mesh that the options name or hold. It is the
/// one way from options to sizes: cuts, forecasts, the remesher and meshers are handed what it returns. Throws
/// Error(io) or Error(input) for a file that cannot be read or has no positive scalar at each of its nodes,
/// Error(usage) as make_size_field() does.
SizeField read_size_field(const SizeOptions& options, const SurfaceArrays& surface,
                          const std::vector<std::string>& patch_names);

/// Returns the same over the surface of an input, which is looked at only where sizes depend on the place. Air around
/// bodies has the size of its wake, too.
SizeField read_size_field(const SizeOptions& options, const Input& input);

/// Returns the sizes of cells: those of the options or, where these give none for all of the air around bodies, cells
/// that grow from the edges of the surface to the size of the box's faces.
SizeOptions sizes_of_cells(const SizeOptions& options, const Input& input);

}  // namespace kerf
