// The list of the files of a run folder, by which it is known as Kerf's own.
#pragma once

#include <functional>
#include <vector>

#include "base/parallel/communicator.h"
#include "files/io/run_folder.h"
#include "run/report/report.h"

namespace kerf {

/// Returns all files of the folder but those of the work under way and the report: the `written` ones, which are known,
/// and the others, of which each rank reads a share. Collective; the same on every rank. `progress` is told of each
/// file before it is read, with its number and how many there are, and may throw. Throws Error(io) on every rank alike,
/// also if a surface or a stored part of `parts` does not have the hash with which it was written.
std::vector<RunFile> list_run_files(Communicator& ranks, const RunFolder& folder, const std::vector<PartReport>& parts,
                                    std::vector<RunFile> written,
                                    const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kerf
