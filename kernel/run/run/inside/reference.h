// A mesh of the whole in one piece, beside which the mesh in parts can be judged.
#pragma once

#include <functional>

#include "files/io/run_folder.h"
#include "run/report/report.h"

namespace kerf {

/// Fills the whole surface in a worker of its own, as a part is filled, but with all the memory that there is. The
/// files that it writes into the folder are gone when this returns. `while_waiting` is called now and then, and may
/// throw. Throws Error(io); that there is no mesh is said by the outcome.
PartOutcome mesh_in_one_piece(const RunFolder& folder, const Surface& surface, double length_scale,
                              const RunOptions& options, const std::function<void()>& while_waiting);

/// Returns the quality of the report's parts beside that of the whole as text, and writes both into the folder as a
/// sheet of pictures.
Reference compare_with_whole(const RunFolder& folder, const RunReport& report, PartOutcome whole);

}  // namespace kerf
