// The table of contents of a ZIP archive is at its end: a header for each file, with sizes and the name, then where the
// first header is and how many there are.
#include "io/threemf_file.h"

#include <cstdint>
#include <cstring>

#include "core/error.h"
#include "io/compressed.h"

namespace kerf {

namespace {

// Of the formats of headers.
constexpr std::string_view entry_magic("PK\1\2", 4), end_magic("PK\5\6", 4);
constexpr std::size_t entry_size = 46, end_size = 22;

// Little endian, as the machine.
template <class Number>
std::size_t number_at(std::string_view bytes, std::size_t offset) {
    Number number = 0;
    std::memcpy(&number, bytes.data() + offset, sizeof(number));
    return number;
}

// The bytes that the entries claim to hold; stops at what is no entry.
std::size_t claimed_size(std::string_view entries) {
    std::size_t sum = 0;
    while (entries.size() >= entry_size && entries.starts_with(entry_magic)) {
        sum += number_at<std::uint32_t>(entries, 24);
        const std::size_t length = entry_size + number_at<std::uint16_t>(entries, 28) +
                                   number_at<std::uint16_t>(entries, 30) + number_at<std::uint16_t>(entries, 32);
        entries.remove_prefix(std::min(length, entries.size()));
    }
    return sum;
}

}  // namespace

bool is_zip(std::string_view content) { return content.starts_with("PK\3\4"); }

bool is_threemf(std::string_view content) {
    return is_zip(content) && content.find("_rels/.rels") != content.npos && content.find(".model") != content.npos;
}

void check_growth_of_zip(std::string_view content, const std::string& path) {
    const std::size_t end = content.rfind(end_magic);
    if (end == content.npos || content.size() - end < end_size || number_at<std::uint32_t>(content, end + 16) > end)
        throw Error(ErrorCode::input, path + ": the archive is truncated. Save or copy the file again.");
    if (claimed_size(content.substr(number_at<std::uint32_t>(content, end + 16))) > most_content(content.size()))
        throw Error(ErrorCode::input, path + ": the archive grows to more than " + std::to_string(surface_growth) +
                                          " times its size, as no surface does. If it is one all the same, export it "
                                          "as STL, OBJ or PLY.");
}

}  // namespace kerf
