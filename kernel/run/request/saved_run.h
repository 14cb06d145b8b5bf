// The request of an interrupted run, kept so that its folder's name alone is enough to continue it.
#pragma once

#include <string>

#include "run/request/run_request.h"

namespace kerf {

/// Writes input, options and K of a run; `input_hash`: of the bytes of the input. Durable. Throws Error(io).
void save_run(const std::string& path, const RunRequest& options, const std::string& input_hash);

/// Whether the run into `folder` has ended well, so that nothing of it waits.
bool is_complete_run(const std::string& folder);

/// Returns the options of the run that was interrupted while it wrote to `folder`, or whose partial folder that is. All
/// paths are absolute; that of the output follows from the given one, in case it was moved. Throws Error(io) if there
/// is no such run or its file is damaged, naming the way out.
RunRequest load_interrupted_run(const std::string& folder);

/// Throws Error(io) if the options are those of an interrupted run and its input had another hash.
void refuse_changed_input(const RunRequest& options, const std::string& input_hash);

/// Whether a run with these options would have the same part files as the one that has written the file.
bool is_same_run(const std::string& saved_run_file, const RunRequest& options, const std::string& input_hash);

/// Returns what a run with these options has else than the one that has written the file: "size, parts", "the input";
/// empty if that is the same run, or cannot be read.
std::string differences_of_runs(const std::string& saved_run_file, const RunRequest& options,
                                const std::string& input_hash);

/// Returns the K of the run of this input that was interrupted, or failed in part, while it wrote to the folder
/// `output`; 0 if there is none that can be read.
std::int32_t interrupted_part_count(const std::string& output, const std::string& input_hash);

}  // namespace kerf
