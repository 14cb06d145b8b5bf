#include "help/inside/wrapped_text.h"

#include <algorithm>

namespace kerf {

namespace {

std::string wrapped_line(std::string_view line, std::size_t indent) {
    const std::string next_line = "\n" + std::string(indent, ' ');
    std::string text;
    std::size_t used = 0;
    while (!line.empty()) {
        const std::string_view word = line.substr(0, line.find(' '));
        line.remove_prefix(std::min(line.size(), word.size() + 1));
        if (used > 0 && indent + used + 1 + word.size() > help_columns) {
            text += next_line;
            used = 0;
        }
        if (used > 0) text += ' ';
        text += word;
        used += word.size() + (used > 0 ? 1 : 0);
    }
    return text;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t indent) {
    std::string result;
    for (bool first = true; first || !text.empty(); first = false) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (!first) result += "\n" + std::string(line.empty() ? 0 : indent, ' ');
        result += line.starts_with(' ') ? std::string(line) : wrapped_line(line, indent);
    }
    return result;
}

}  // namespace kerf
