// Archives of one file: gzip and zstd.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// How many times as large as an archive a surface can be: no two of its facets are the same, so that each takes some
/// bytes. The most that was seen is 84, of a plane grid of whole numbers as ASCII STL by zstd -19; 44 by gzip -9.
inline constexpr std::size_t surface_growth = 128;
/// The bytes that may come out of so many bytes of an archive: 250 MB, and `surface_growth` times its own.
std::size_t most_content(std::size_t archive_bytes);

/// Whether these are the first bytes of a gzip or zstd archive.
bool is_archive(std::string_view bytes);

/// The content of a gzip or zstd archive, told by its first bytes; all other bytes are given back as they are. Archives
/// that were joined give their contents one behind the other. `path` serves messages.
///
/// Throws Error(input) naming the file for an archive that is truncated or damaged or has something else behind it, and
/// for one that has more in it than most_content() when so many bytes of it are read: memory is bounded by what the
/// archive holds, whatever its header claims, and by this limit.
std::string decompress(std::string bytes, const std::string& path);

/// The content of one block of zlib's format, which must be `size` bytes. Throws Error(input) naming the file, also for
/// a size that no such block can have, before memory is taken for it.
std::string inflate_block(std::string_view block, std::size_t size, const std::string& path);

/// The same of a deflated block without the header and the sum of zlib's format, as ZIP archives have them.
std::string inflate_raw_block(std::string_view block, std::size_t size, const std::string& path);

/// One block of zlib's format, as small as it makes it; what inflate_block() takes.
std::string deflate_block(std::string_view content);

/// The name of what is in an archive: "part.poly" for "part.poly.gz" or "part.poly.zst"; other names as they are.
std::string name_in_archive(const std::string& path);

}  // namespace kerf
