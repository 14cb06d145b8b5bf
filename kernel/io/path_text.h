// Paths in JSON, which knows only UTF-8, where a path may be any bytes.
#pragma once

#include <string>

namespace kerf {

/// The path itself if it is UTF-8; else "bytes:" and the path with every byte beyond ASCII as %XX.
std::string path_text(const std::string& path);
/// What path_text() was given.
std::string path_of_text(const std::string& text);

/// The path as seen from a folder: `../mesh`, which stays true where both are moved together.
std::string path_from(const std::string& folder, const std::string& path);

}  // namespace kerf
