// From what a user asks to what a run does.
#pragma once

#include <optional>
#include <string>

#include "parallel/communicator.h"
#include "prepare/cells.h"
#include "prepare/input.h"
#include "prepare/stage_listener.h"
#include "prepare/surface_nodes.h"
#include "request/options.h"

namespace kerf {

/// All choices of a run; none of them changes while its stages go on.
struct RunPlan {
    RunOptions options;  ///< resolved: K, lengths in units of the input, sizes over the surface that is cut
    std::optional<FoundSize> found_size;  ///< for the number of tetrahedra that was asked for
    std::string worker_hash;  ///< of the program that meshes the parts; empty if it has nothing to do, or to continue
    SurfaceNodes surface_nodes = {};  ///< of cells of order 2; else none
};

/// Reads the surface into `input`, unless it is there already (Input::is_ready), remeshes it where that is asked for,
/// puts it on the faces of a CAD file where cells of order 2 are to have curved edges (prepare/surface_nodes.h), and
/// resolves the request. Throws Error on every rank alike, for what cannot end well (check_budget()) before the surface
/// is remeshed or cut.
///
/// Collective; the same plan on every rank. The first rank does it, with the processors of all ranks of its host, which
/// sleep meanwhile. `input` of the others gets numbers and names, for several regions the surface, too, for one region
/// none: what was repaired and remeshed is known to the first rank alone.
RunPlan plan_run(const RunOptions& request, int cores_of_rank, Communicator& ranks, Input& input,
                 StageListener* listener);

}  // namespace kerf
