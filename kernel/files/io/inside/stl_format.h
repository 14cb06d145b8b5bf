// Tells binary and ASCII STL apart.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace kerf {

inline constexpr std::size_t stl_header_size = 84;  // 80 bytes of text, then the number of facets
inline constexpr std::size_t stl_facet_size = 50;   // normal, three corners (float), attribute (uint16)

/// Returns the number of facets that a binary STL claims; 0 if the file ends before it.
inline std::uint32_t claimed_stl_facets(std::string_view bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= stl_header_size)
        std::memcpy(&count, bytes.data() + stl_header_size - sizeof count, sizeof count);
    return count;
}

/// Tells whether the size is that of a binary STL; many exporters begin theirs with the word "solid".
inline bool is_binary_stl(std::string_view header, std::size_t size) {
    return header.size() >= stl_header_size && size == stl_header_size + stl_facet_size * claimed_stl_facets(header);
}
inline bool is_binary_stl(std::string_view bytes) { return is_binary_stl(bytes, bytes.size()); }

inline bool holds_nul(std::string_view bytes) { return bytes.find('\0') != std::string_view::npos; }

/// Returns the text without the bytes that some programs append to texts: NUL and the end-of-file character of DOS.
inline std::string_view without_padding(std::string_view text) {
    while (!text.empty() && (text.back() == '\0' || text.back() == '\x1a')) text.remove_suffix(1);
    return text;
}

/// Tells whether a text begins with "solid" in any case; padding may follow.
inline bool is_ascii_stl(std::string_view bytes) {
    const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return false;
    const std::string_view word = bytes.substr(begin, 5);
    for (std::size_t i = 0; i < 5; ++i)
        if (i >= word.size() || (word[i] | 0x20) != "solid"[i]) return false;
    return !holds_nul(without_padding(bytes));
}

}  // namespace kerf
