// Texts for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

inline constexpr std::size_t help_columns = 80;

/// Returns `text` broken at spaces so that no line, with `indent` spaces before it, is longer than help_columns; a word
/// that is longer alone stays whole. Newlines stay, and lines that begin with a space are not broken. The first line
/// has no indent, the last one no newline.
std::string wrapped(std::string_view text, std::size_t indent);

}  // namespace kerf
