// Writes small files of text.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// Writes the file in the place of an older one. Throws Error(io) naming the file and the reason, a full disk included.
void write_text_file(const std::string& path, std::string_view text);

}  // namespace kerf
