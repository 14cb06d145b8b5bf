// The files of a ZIP archive.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// A file as the table of contents has it: what is written before the file itself may leave its sizes open.
struct ZipEntry {
    std::string name;
    std::uint64_t size = 0;         ///< bytes that it claims to hold
    std::uint64_t packed_size = 0;  ///< bytes that it takes in the archive
    std::uint64_t offset = 0;       ///< of its header in the archive
    int method = 0;                 ///< 0: as it is, 8: deflated
};

bool is_zip(std::string_view content);

/// The table of contents, also that of a ZIP64 archive. Throws Error(input) naming the file for an archive without one,
/// which is truncated. O(entries).
std::vector<ZipEntry> zip_entries(std::string_view content, const std::string& path);

/// What a file holds; empty where it is packed by a method that is not known here. Throws Error(input) naming the
/// archive for an entry that does not hold what it claims.
std::string content_of_entry(std::string_view content, const ZipEntry& entry, const std::string& path);

}  // namespace kerf
