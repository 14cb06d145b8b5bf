// The bytes of a file.
#pragma once

#include <string>

namespace kerf {

/// The whole content. Throws Error(io) naming the file and the system's reason if it cannot be opened or read, and
/// refuses `-`, folders and everything else that has no size.
std::string read_file(const std::string& path);

}  // namespace kerf
