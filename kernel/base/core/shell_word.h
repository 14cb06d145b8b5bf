// The quoting of words in commands that a user may copy.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace kerf {

/// Returns the text in the form that a shell takes for one word.
inline std::string shell_word(const std::string& text) {
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) ||
               std::string_view("_-./+:=@%,").find(c) != std::string::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

}  // namespace kerf
