// What lies in a folder.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// The files below a folder as paths relative to it, ascending, with '/' between names; folders that hold nothing end
/// with '/'. Links are listed, not followed. Empty for a folder that does not exist. Throws Error(io) for one that
/// cannot be read.
std::vector<std::string> list_files(const std::string& folder);

}  // namespace kerf
