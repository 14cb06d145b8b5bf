// Paths as text of JSON, which holds only UTF-8, where a path may be any bytes.
#pragma once

#include <string>

namespace kerf {

/// Returns the path itself if it is UTF-8; else "bytes:" and the path with every byte beyond ASCII as %XX.
std::string path_text(const std::string& path);
/// Returns the path of which path_text() made the text.
std::string path_of_text(const std::string& text);

/// Returns the path as seen from a folder: `../mesh`, which stays true where both are moved together.
std::string path_from(const std::string& folder, const std::string& path);

}  // namespace kerf
