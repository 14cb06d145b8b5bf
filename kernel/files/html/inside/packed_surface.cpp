#include "files/html/inside/packed_surface.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

void append_number(std::int64_t number, std::string& bytes) {
    auto rest = static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
    for (; rest > 0x7f; rest >>= 7) bytes.push_back(static_cast<char>(rest | 0x80));
    bytes.push_back(static_cast<char>(rest));
}

std::int64_t in_steps(double value, const ValueRange& range) {
    if (!(range.most > range.least)) return 0;
    return std::llround((value - range.least) / (range.most - range.least) * value_steps);
}

}  // namespace

std::vector<ValueRange> ranges_of(const PageSurface& surface) {
    std::vector<ValueRange> ranges;
    for (const PagePart& part : surface.parts()) {
        ranges.resize(std::max(ranges.size(), part.value_sums.size()));
        for (std::size_t field = 0; field < part.value_sums.size(); ++field)
            for (std::size_t cell = 0; cell < part.cells.size(); ++cell) {
                ValueRange& range = ranges[field];
                range.least = std::min(range.least, part.value(field, cell));
                range.most = std::max(range.most, part.value(field, cell));
            }
    }
    return ranges;
}

std::string packed_surface(const PageSurface& surface, const std::vector<ValueRange>& ranges) {
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
        for (std::size_t field = 0; field < ranges.size(); ++field)
            for (std::size_t cell = 0; cell < part.cells.size(); ++cell)
                append_number(in_steps(part.value(field, cell), ranges[field]), bytes);
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
