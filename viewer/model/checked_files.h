// Files of runs that are open, known to be what the runs have left.
#pragma once

#include <string>

namespace kerf::view {

/// FOLDER/path. Of a finished run it is compared with the hash of the report when it is first asked for, and again when
/// the report is another one; a folder without a report is that of a run under way, of which nothing is known yet. From
/// any thread. Throws Error(io) or Error(verification), naming the file and the way out.
std::string checked_file(const std::string& folder, const std::string& path);

}  // namespace kerf::view
