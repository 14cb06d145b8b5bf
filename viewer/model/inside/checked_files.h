// Access to the files of open runs, which are checked to be as the runs have left them.
#pragma once

#include <string>

namespace kerf::view {

/// Returns FOLDER/path. A file of a finished run is compared with its hash in the report when it is first asked for,
/// and again when the report is another one. A folder without a report belongs to a run under way, whose files are not
/// compared. May be called from any thread. Throws Error(io) or Error(verification), naming the file and the way out.
std::string checked_file(const std::string& folder, const std::string& path);

}  // namespace kerf::view
