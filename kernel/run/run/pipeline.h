// The order of the stages, written once: the command line, the MPI ranks, the viewer and the tests call it.
#pragma once

#include <optional>

#include "base/parallel/communicator.h"
#include "run/report/listener.h"
#include "run/report/report.h"

namespace kerf {

/// Reads the input, decomposes it, meshes every subdomain in worker processes, verifies the mesh and writes the run
/// folder.
///
/// Collective. The part files depend on input, options and K alone. Parts that could not be meshed leave a reproducer
/// in DIR/failed and exit_code 4 in the report, 5 if all of them ran out of memory; a law that does not hold leaves
/// exit_code 8. An error that leaves no result, such as a full disk, is thrown as Error on every rank alike; the run
/// folder then does not exist, but finished parts wait beside it for the next run into it (files/io/run_folder.h),
/// which has only the other parts to do. With request.dry_run the run ends after on_parts() of the listener, and
/// nothing is written but the trace. `surface`: taken instead of a file, by the first rank.
RunReport run(const RunRequest& request, int cores_of_rank, Communicator& ranks, RunListener* listener = nullptr,
              std::optional<Input> surface = {});

}  // namespace kerf
