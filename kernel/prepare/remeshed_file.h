// A surface file remeshed into another one.
#pragma once

#include <optional>
#include <string>

#include "prepare/cells.h"
#include "prepare/input.h"
#include "prepare/stage_listener.h"
#include "request/options.h"

namespace kerf {

/// What remesh_file() has written.
struct RemeshedFile {
    std::int64_t facets = 0;
    InputRemeshing done;
    std::optional<FoundSize> found_size;  ///< for the number of tetrahedra that was asked for
};

/// Remeshes options.input within options.deviation to the wanted lengths (prepare/remeshing.h) and writes it to
/// `output`, an .obj with patches or an .stl; several regions as an .obj with a closed group for each. `listener` may
/// be null. Throws Error, before the work where the output cannot be written.
RemeshedFile remesh_file(RunOptions options, const std::string& output, StageListener* listener = nullptr);

}  // namespace kerf
