// The folder of a run, from the first stage to the place of the result.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "files/io/run_folder.h"
#include "run/report/report.h"
#include "run/run/inside/run_context.h"

namespace kerf {

/// Returns the folder of the run, or a temporary one where the run is transient. Finished parts of an interrupted run
/// with the same options and input stay in it. Collective; throws Error on every rank alike.
RunFolder open_folder(const RunContext& run, const Input& input);

/// Makes the run one that can be continued by the name of its folder from the beginning on, however it ends.
/// Collective; throws Error on every rank alike.
void keep_folder(const RunContext& run, const Input& input, RunFolder& folder);

/// Keeps only the files of the folder that a run with these parts can use, and returns how many parts an interrupted
/// one had finished; 0 on other ranks than the root. Collective; throws Error on every rank alike.
std::size_t clear_folder(const RunContext& run, const Input& input, RunFolder& folder,
                         const std::vector<PartReport>& parts);

/// Moves the folder to its place, with the report of the run in it, and returns the report with its last fields:
/// memory, files, seconds and place. The folder of a transient run has no report, and goes. Collective; throws Error on
/// every rank alike.
RunReport finish_run(const RunContext& run, std::optional<RunFolder>& folder, RunReport report);

/// Returns the error with words on how to go on: always where the user has stopped the run, else if a part is finished.
/// A folder without a finished part is discarded where the run has failed. `folder`: none if the run has ended before
/// it was opened.
Error with_way_to_go_on(const RunRequest& request, std::optional<RunFolder>& folder, const Error& error);

}  // namespace kerf
