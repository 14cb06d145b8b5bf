#pragma once

namespace kerf {

/// major.minor.patch, defined by CMakeLists.txt.
inline constexpr const char* version = KERF_VERSION;

}  // namespace kerf
