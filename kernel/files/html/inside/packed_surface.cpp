#include "files/html/inside/packed_surface.h"

#include <algorithm>

namespace kerf {

namespace {

void append_number(std::int64_t number, std::string& bytes) {
    auto rest = static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
    for (; rest > 0x7f; rest >>= 7) bytes.push_back(static_cast<char>(rest | 0x80));
    bytes.push_back(static_cast<char>(rest));
}

}  // namespace

std::string packed_surface(const PageSurface& surface) {
    std::string bytes;
    for (const PagePart& part : surface.parts()) {
        PageSurface::GridPoint before{0, 0, 0};
        for (const std::uint64_t cell : part.cells) {
            const PageSurface::GridPoint place = surface.place_of(cell);
            for (int i = 0; i < 3; ++i) append_number(place[i] - before[i], bytes);
            before = place;
        }
        std::int32_t first = 0;
        for (const PageTriangle& t : part.triangles) {
            const auto& [a, b, c] = t.corners;
            append_number(a - first, bytes);
            append_number(b - a, bytes);
            append_number(c - a, bytes);
            first = a;
        }
    }
    return bytes;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text.push_back(k <= count ? digits[bits >> (18 - 6 * k) & 63] : '=');
    }
    return text;
}

}  // namespace kerf
