// Text inside of XML.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// Returns the text with all characters escaped that have a meaning in XML, also in attributes; control characters,
/// which XML does not allow, become blanks.
inline std::string xml_text(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&')
            escaped += "&amp;";
        else if (c == '<')
            escaped += "&lt;";
        else if (c == '>')
            escaped += "&gt;";
        else if (c == '"')
            escaped += "&quot;";
        else
            escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return escaped;
}

}  // namespace kerf
