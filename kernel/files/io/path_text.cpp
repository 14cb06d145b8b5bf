#include "files/io/path_text.h"

#include <charconv>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kerf {

namespace {

constexpr std::string_view bytes_prefix = "bytes:";

bool is_utf8(const std::string& text) {
    try {
        (void)nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

}  // namespace

std::string path_text(const std::string& path) {
    if (is_utf8(path) && !path.starts_with(bytes_prefix)) return path;
    std::string text(bytes_prefix);
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && c != '%')
            text += c;
        else
            text += fmt::format("%{:02X}", byte);
    }
    return text;
}

std::string path_of_text(const std::string& text) {
    if (!text.starts_with(bytes_prefix)) return text;
    std::string path;
    for (std::size_t i = bytes_prefix.size(); i < text.size(); ++i) {
        unsigned int byte = 0;
        const bool is_escaped = text[i] == '%' && i + 3 <= text.size() &&
                                std::from_chars(text.data() + i + 1, text.data() + i + 3, byte, 16).ec == std::errc();
        path += is_escaped ? static_cast<char>(byte) : text[i];
        if (is_escaped) i += 2;
    }
    return path;
}

std::string path_from(const std::string& folder, const std::string& path) {
    return std::filesystem::proximate(path, folder).string();
}

}  // namespace kerf
