// The table of contents of a ZIP archive is at its end: a header for each file, with sizes and the name, then where the
// first header is and how many there are. Numbers that do not fit into 32 bits are all ones there: those of ZIP64 are
// behind the name, and the place of the table in a record of its own before the end.
#include "files/io/zip_archive.h"

#include <cstring>
#include <optional>

#include "base/core/error.h"
#include "files/io/compressed.h"

namespace kerf {

namespace {

namespace zip {

// Sizes and magic numbers of the formats of headers.
constexpr std::string_view file_magic("PK\3\4", 4), entry_magic("PK\1\2", 4), end_magic("PK\5\6", 4),
    end64_magic("PK\6\6", 4), locator_magic("PK\6\7", 4);
constexpr std::size_t file_size = 30, entry_size = 46, end_size = 22, end64_size = 56, locator_size = 20;
constexpr std::uint64_t in_zip64 = 0xffffffff;
constexpr std::uint64_t id_of_zip64 = 1;

// Little endian, as the machine.
template <class Number>
std::uint64_t number_at(std::string_view bytes, std::size_t offset) {
    Number number = 0;
    std::memcpy(&number, bytes.data() + offset, sizeof(number));
    return number;
}

// Returns the record with this magic and at least so many bytes; empty if there is none.
std::string_view record_at(std::string_view content, std::uint64_t offset, std::string_view magic, std::size_t size) {
    if (offset > content.size() || content.size() - offset < size) return {};
    const std::string_view record = content.substr(offset);
    return record.starts_with(magic) ? record : std::string_view();
}

// Returns the table and all bytes behind it; nothing if the archive ends before.
std::optional<std::string_view> find_table(std::string_view content) {
    const std::size_t end = content.rfind(end_magic);
    if (end == content.npos || content.size() - end < end_size) return std::nullopt;
    std::uint64_t table = number_at<std::uint32_t>(content, end + 16);
    if (table == in_zip64) {
        if (end < locator_size) return std::nullopt;
        const std::string_view locator = record_at(content, end - locator_size, locator_magic, locator_size);
        if (locator.empty()) return std::nullopt;
        const std::string_view end64 =
            record_at(content, number_at<std::uint64_t>(locator, 8), end64_magic, end64_size);
        if (end64.empty()) return std::nullopt;
        table = number_at<std::uint64_t>(end64, 48);
    }
    if (table > end) return std::nullopt;
    return content.substr(table, end - table);
}

// Takes the numbers that did not fit from the field of ZIP64 behind a name, in the order of the header.
void take_zip64(std::string_view fields, ZipEntry& entry) {
    while (fields.size() >= 4) {
        const std::uint64_t id = number_at<std::uint16_t>(fields, 0);
        std::string_view field = fields.substr(4, number_at<std::uint16_t>(fields, 2));
        fields.remove_prefix(4 + field.size());
        if (id != id_of_zip64) continue;
        for (std::uint64_t* number : {&entry.size, &entry.packed_size, &entry.offset}) {
            if (*number != in_zip64 || field.size() < 8) continue;
            *number = number_at<std::uint64_t>(field, 0);
            field.remove_prefix(8);
        }
    }
}

}  // namespace zip

}  // namespace

bool is_zip(std::string_view content) { return content.starts_with(zip::file_magic); }

std::vector<ZipEntry> zip_entries(std::string_view content, const std::string& path) {
    using namespace zip;
    const std::optional<std::string_view> table = find_table(content);
    if (!table) throw Error(ErrorCode::input, path + ": the archive is truncated. Save or copy the file again.");
    std::vector<ZipEntry> entries;
    std::string_view rest = *table;
    while (rest.size() >= entry_size && rest.starts_with(entry_magic)) {
        const std::size_t name = number_at<std::uint16_t>(rest, 28), fields = number_at<std::uint16_t>(rest, 30),
                          comment = number_at<std::uint16_t>(rest, 32);
        ZipEntry entry{std::string(rest.substr(entry_size, name)), number_at<std::uint32_t>(rest, 24),
                       number_at<std::uint32_t>(rest, 20), number_at<std::uint32_t>(rest, 42),
                       static_cast<int>(number_at<std::uint16_t>(rest, 10))};
        if (entry_size + name <= rest.size()) take_zip64(rest.substr(entry_size + name, fields), entry);
        entries.push_back(std::move(entry));
        rest.remove_prefix(std::min(entry_size + name + fields + comment, rest.size()));
    }
    return entries;
}

std::string content_of_entry(std::string_view content, const ZipEntry& entry, const std::string& path) {
    using namespace zip;
    const std::string_view header = record_at(content, entry.offset, file_magic, file_size);
    const std::size_t before =
        header.empty() ? 0 : file_size + number_at<std::uint16_t>(header, 26) + number_at<std::uint16_t>(header, 28);
    if (before == 0 || before > header.size() || entry.packed_size > header.size() - before)
        throw Error(ErrorCode::input,
                    path + ": the archive is damaged at '" + entry.name + "'. Save or copy the file again.");
    const std::string_view packed = header.substr(before, entry.packed_size);
    constexpr int stored = 0, deflated = 8;
    if (entry.method == stored) return std::string(packed);
    return entry.method == deflated ? inflate_raw_block(packed, entry.size, path) : std::string();
}

}  // namespace kerf
