// The list of the files of a folder.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// Returns the files below a folder as paths relative to it, ascending, with '/' between names; empty folders are
/// listed with a '/' at their end. Links are listed, not followed. The list is empty for a folder that does not exist.
/// Throws Error(io) for a folder that cannot be read.
std::vector<std::string> list_files(const std::string& folder);

}  // namespace kerf
