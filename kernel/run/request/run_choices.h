// All choices of a run that follow from its request alone.
#pragma once

#include <vector>

#include "files/export/format.h"
#include "files/export/patch_types.h"
#include "files/part/cell_fields.h"
#include "run/request/run_request.h"

namespace kerf {

/// A request that is checked, with the meaning of its texts. Lengths may still be percentages, and K may be open: both
/// need the surface.
struct RunChoices {
    RunRequest request;                  ///< with the values that were left open; paths are absolute
    InputChoices input;                  ///< the meaning of RunRequest::input_options
    std::vector<const Format*> formats;  ///< of the result, at least one
    CellFieldSet fields;                 ///< qualities of cells in vtu files
    std::vector<PatchType> patch_types;  ///< OpenFOAM's types of patches

    bool has_format(const char* name) const;
    /// Returns the options of all cuts for these sizes, weighed as the mesher works.
    DecomposeOptions decompose_options(const SizeField& size, const RegionSizes& region_sizes = {}) const;
};

/// Checks all that can be known before any file is read, and makes the choices. Workers that were left open are those
/// of `cores_of_rank`. Throws Error(usage) naming option, value and range, Error(io) for a file that could not be
/// written or would be lost.
RunChoices choices_of(RunRequest request, int cores_of_rank = 1);

}  // namespace kerf
