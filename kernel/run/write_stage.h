// Parts to files of all formats, by the threads of all ranks.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "export/format.h"
#include "run/communicator.h"
#include "run/listener.h"

namespace kerf {

/// Where a run keeps the files of a format: its own folder, but for `vtu`, whose names are those of the run folder.
std::string folder_of_format(const Format& format, const std::string& run_folder);

/// Writes all parts in all formats below `folder`. Collective: every rank writes its share of the parts with so many
/// `threads`, each of which holds one part at a time; what belongs to no part, and formats that are read in one piece,
/// are the root rank's. Returns what was written, with paths relative to the folder, with sizes and hashes on the
/// root rank; the bytes depend on the parts alone. Throws Error on every rank alike.
std::vector<RunFile> write_parts(Communicator& ranks, const PartSource& parts, std::span<const Format* const> formats,
                                 const std::string& folder, int threads, RunListener* listener);

}  // namespace kerf
