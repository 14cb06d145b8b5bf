// Archives as the tests need them.
#pragma once

#include <zlib.h>
#include <zstd.h>

#include <string>

namespace kerf::test {

inline std::string gzip(std::string bytes) {
    constexpr int gzip_with_largest_window = 16 + 15, memory_level = 8;
    z_stream stream{};
    deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_with_largest_window, memory_level, Z_DEFAULT_STRATEGY);
    std::string archive(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(archive.data());
    stream.avail_out = static_cast<uInt>(archive.size());
    deflate(&stream, Z_FINISH);
    archive.resize(stream.total_out);
    deflateEnd(&stream);
    return archive;
}

inline std::string zstd(const std::string& bytes) {
    std::string archive(ZSTD_compressBound(bytes.size()), '\0');
    archive.resize(ZSTD_compress(archive.data(), archive.size(), bytes.data(), bytes.size(), 3));
    return archive;
}

}  // namespace kerf::test
