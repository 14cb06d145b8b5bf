// Archives of one file: gzip and zstd.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// The largest ratio of a surface to its archive, in bytes: no two facets of a surface are the same, so that each takes
/// some bytes. The most that was seen is 84, of a plane grid of whole numbers as ASCII STL by zstd -19; 44 by gzip -9.
inline constexpr std::size_t surface_growth = 128;
/// Returns the most bytes that so many bytes of an archive may unpack to: 250 MB and `surface_growth` times their
/// number.
std::size_t most_content(std::size_t archive_bytes);

/// Tells whether these are the first bytes of a gzip or zstd archive.
bool is_archive(std::string_view bytes);

/// Returns the content of a gzip or zstd archive, told by its first bytes; all other bytes are given back as they are.
/// Archives that were joined give their contents one behind the other. `path` serves messages.
///
/// Throws Error(input) naming the file for an archive that is truncated or damaged or has something else behind it, and
/// for one that has more in it than most_content() of the bytes of it that are read by then: memory is bounded by the
/// content of the archive, whatever its header claims, and by this limit.
std::string decompress(std::string bytes, const std::string& path);

/// Returns the content of one block of zlib's format, which must be `size` bytes. Throws Error(input) naming the file,
/// also for a size that no such block can have, before memory is taken for it.
std::string inflate_block(std::string_view block, std::size_t size, const std::string& path);

/// Returns the content of a deflated block without the header and the sum of zlib's format, as ZIP archives have them;
/// otherwise as inflate_block().
std::string inflate_raw_block(std::string_view block, std::size_t size, const std::string& path);

/// Returns the content as one block of zlib's format, at its best compression; inflate_block() is the way back.
std::string deflate_block(std::string_view content);

/// Returns the name of the file in an archive: "part.poly" for "part.poly.gz" or "part.poly.zst"; other names as they
/// are.
std::string name_in_archive(const std::string& path);

}  // namespace kerf
