// A surface remeshed for its own sake, and a file of one into another file.
#pragma once

#include <optional>
#include <string>

#include "prepare/cells.h"
#include "prepare/input.h"
#include "prepare/stage_listener.h"
#include "request/options.h"

namespace kerf {

/// Remeshes a surface within options.deviation to the wanted lengths (prepare/remeshing.h), or those that give the
/// wanted number of tetrahedra (prepare/cells.h). `listener` may be null. Throws Error.
SizedInput remesh_always(Input input, RunOptions options, StageListener* listener = nullptr);

/// What remesh_file() has written.
struct RemeshedFile {
    std::int64_t facets = 0;
    InputRemeshing done;
    std::optional<FoundSize> found_size;  ///< for the number of tetrahedra that was asked for
    std::optional<WrapReport> wrapped = {};
};

/// remesh_always() of options.input, written to `output` as write_surface() does. Throws Error, before the work where
/// the output cannot be written.
RemeshedFile remesh_file(RunOptions options, const std::string& output, StageListener* listener = nullptr);

}  // namespace kerf
