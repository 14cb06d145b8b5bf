// The whole in one piece, beside which its parts can be judged.
#pragma once

#include <functional>

#include "io/run_folder.h"
#include "report/report.h"

namespace kerf {

/// Fills the whole surface in a worker of its own, as a part is filled, but with all the memory that there is; what it
/// writes into the folder is gone when this returns. `while_waiting` is called now and then, and may throw. Throws
/// Error(io); that there is no mesh is said by the outcome.
PartOutcome mesh_in_one_piece(const RunFolder& folder, const Surface& surface, double length_scale,
                              const RunOptions& options, const std::function<void()>& while_waiting);

/// The quality of the report's parts beside that of the whole: both as a sheet of pictures in the folder, and as text.
Reference compare_with_whole(const RunFolder& folder, const RunReport& report, PartOutcome whole);

}  // namespace kerf
