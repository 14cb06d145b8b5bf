// A surface remeshed for its own sake, in memory or from one file into another.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/prepare/cells.h"
#include "run/prepare/input.h"
#include "run/prepare/stage_listener.h"
#include "run/request/run_request.h"

namespace kerf {

/// Remeshes a surface within options.deviation to the wanted lengths (run/prepare/remeshing.h), or to lengths that give
/// the wanted number of tetrahedra (run/prepare/cells.h). `listener` may be null. Throws Error.
SizedInput remesh_always(Input input, RunRequest options, StageListener* listener = nullptr);

/// Report on a file that remesh_file() has written.
struct RemeshedFile {
    std::int64_t facets = 0;
    std::optional<InputRemeshing> done;   ///< none: few facets are bad, and only those were to be changed
    std::optional<FoundSize> found_size;  ///< for the number of tetrahedra that was asked for
    std::optional<WrapReport> wrapped = {};
    std::vector<std::string> notes = {};  ///< Input::notes
};

/// Applies remesh_always() to options.input, or remeshes it as `how` says in place of options.remeshing, and writes the
/// surface to `output` as write_surface() does. Throws Error, before the work where the output cannot be written.
RemeshedFile remesh_file(RunRequest options, const std::string& output, StageListener* listener = nullptr,
                         Remeshing how = Remeshing::always);

}  // namespace kerf
