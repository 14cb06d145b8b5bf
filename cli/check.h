// kerf check: what is wrong with a surface.
#pragma once

#include <string>

namespace kerf {

/// Prints a summary, or with `json` every defect, to standard output. Returns 0 for a surface that can be meshed,
/// else 3. Throws Error for a file that cannot be read or parsed.
int check_surface(const std::string& path, bool json);

}  // namespace kerf
