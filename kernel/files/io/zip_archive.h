// The files of a ZIP archive.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// A file as the table of contents lists it; the header before the file itself may leave its sizes open.
struct ZipEntry {
    std::string name;
    std::uint64_t size = 0;         ///< bytes of the content, as it claims
    std::uint64_t packed_size = 0;  ///< bytes in the archive
    std::uint64_t offset = 0;       ///< place of its header in the archive
    int method = 0;                 ///< 0: as it is, 8: deflated
};

bool is_zip(std::string_view content);

/// Returns the table of contents, also that of a ZIP64 archive. Throws Error(input) naming the file for an archive
/// without one, which is truncated. O(entries).
std::vector<ZipEntry> zip_entries(std::string_view content, const std::string& path);

/// Returns the content of a file; empty where it is packed by a method that is not known here. Throws Error(input)
/// naming the archive for an entry that does not hold the bytes that it claims.
std::string content_of_entry(std::string_view content, const ZipEntry& entry, const std::string& path);

}  // namespace kerf
