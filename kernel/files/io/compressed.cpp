// Unpacks gzip by zlib and zstd by its own library, block by block: both libraries are fed the whole archive and asked
// for one block of its content after the other, so that the limit is checked before there is memory for more than a
// block beyond it. The limit, most_content(), grows with the bytes of the archive that have been read so far: a bomb is
// known by its first bytes, however long it is. Blocks whose size is known before, those of VTU files and ZIP archives,
// are inflated at once, after a check that deflate can have made so much of them.
#include "files/io/compressed.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include "base/core/error.h"

namespace kerf {

namespace {

constexpr std::string_view gzip_magic = "\x1f\x8b";
constexpr std::string_view zstd_magic = "\x28\xb5\x2f\xfd";

// The unpacked bytes of an archive, taken block by block within the limit.
class Content {
 public:
    explicit Content(const std::string& path) : path_(path), block_(block_size, '\0') {}

    std::string& block() { return block_; }
    /// The first `size` bytes of the block, for which `archive_bytes` have been read altogether.
    void take(std::size_t size, std::size_t archive_bytes) {
        if (bytes_.size() + size > most_content(archive_bytes))
            fail("grows to more than " + std::to_string(surface_growth) +
                 " times its size, as no surface does. If it is one all the same, decompress it and give what comes "
                 "out.");
        bytes_.append(block_, 0, size);
    }
    std::string release() { return std::move(bytes_); }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::input, path_ + ": the archive " + what);
    }
    [[noreturn]] void fail_truncated() const { fail("is truncated. Compress or copy it again."); }
    [[noreturn]] void fail_damaged(const char* reason) const {
        fail("is damaged (" + std::string(reason ? reason : "no reason given") + "). Compress or copy it again.");
    }

 private:
    static constexpr std::size_t block_size = std::size_t{1} << 18;
    const std::string& path_;
    std::string block_, bytes_;
};

// Inflates a block that is in memory. `window` is that of zlib, negative for a block without its header.
std::string inflate_whole(std::string_view block, std::size_t size, int window, const std::string& path) {
    constexpr std::size_t most_growth = 1032, smallest_block = 16;  // of the method
    const auto fail = [&]() {
        throw Error(ErrorCode::input, path + ": a compressed block is damaged. Save or copy the file again.");
    };
    if (size > (block.size() + smallest_block) * most_growth) fail();
    std::string content(size, '\0');
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(block.data()));
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    if (inflateInit2(&stream, window) != Z_OK) throw std::bad_alloc();
    std::size_t unread = block.size(), unwritten = size;
    const auto give = [](std::size_t& left, uInt& available) {  // zlib counts with 32 bits
        if (available > 0) return;
        available = std::min<std::size_t>(left, std::numeric_limits<uInt>::max());
        left -= available;
    };
    int status = Z_OK;
    while (status == Z_OK) {
        give(unread, stream.avail_in);
        give(unwritten, stream.avail_out);
        status = inflate(&stream, Z_NO_FLUSH);
    }
    const bool is_whole = status == Z_STREAM_END && unwritten == 0 && stream.avail_out == 0;
    inflateEnd(&stream);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (!is_whole) fail();
    return content;
}

class GzipStream {
 public:
    GzipStream() {
        constexpr int gzip_with_largest_window = 16 + 15;
        if (inflateInit2(&stream_, gzip_with_largest_window) != Z_OK) throw std::bad_alloc();
    }
    ~GzipStream() { inflateEnd(&stream_); }
    GzipStream(const GzipStream&) = delete;
    GzipStream& operator=(const GzipStream&) = delete;

    void restart() { inflateReset(&stream_); }
    /// Reads from the front of `archive` into `block`; returns the number of bytes written. is_done() tells whether
    /// that was the last of an archive.
    std::size_t next(std::string_view& archive, Content& content) {
        constexpr std::size_t most = std::numeric_limits<uInt>::max();
        const uInt offered = std::min(archive.size(), most);
        std::string& block = content.block();
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(archive.data()));
        stream_.avail_in = offered;
        stream_.next_out = reinterpret_cast<Bytef*>(block.data());
        stream_.avail_out = block.size();
        status_ = inflate(&stream_, Z_NO_FLUSH);
        if (status_ == Z_MEM_ERROR) throw std::bad_alloc();
        if (status_ == Z_BUF_ERROR) content.fail_truncated();
        if (status_ != Z_OK && status_ != Z_STREAM_END) content.fail_damaged(stream_.msg);
        archive.remove_prefix(offered - stream_.avail_in);
        return block.size() - stream_.avail_out;
    }
    bool is_done() const { return status_ == Z_STREAM_END; }

 private:
    z_stream stream_{};
    int status_ = Z_OK;
};

std::string decompress_gzip(std::string_view archive, const std::string& path) {
    Content content(path);
    GzipStream stream;
    const std::size_t size = archive.size();
    while (!archive.empty() || !stream.is_done()) {
        if (stream.is_done()) {
            if (!archive.starts_with(gzip_magic)) content.fail_damaged("something else follows it");
            stream.restart();
        }
        const std::size_t written = stream.next(archive, content);
        content.take(written, size - archive.size());
    }
    return content.release();
}

std::string decompress_zstd(std::string_view archive, const std::string& path) {
    Content content(path);
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
    if (!stream) throw std::bad_alloc();
    ZSTD_inBuffer input{archive.data(), archive.size(), 0};
    bool is_done = false;
    while (input.pos < input.size || !is_done) {
        const std::size_t begin = input.pos;
        ZSTD_outBuffer output{content.block().data(), content.block().size(), 0};
        const std::size_t status = ZSTD_decompressStream(stream.get(), &output, &input);
        if (ZSTD_isError(status)) content.fail_damaged(ZSTD_getErrorName(status));
        is_done = status == 0;
        if (!is_done && input.pos == begin && output.pos == 0) content.fail_truncated();
        content.take(output.pos, input.pos);
    }
    return content.release();
}

}  // namespace

std::size_t most_content(std::size_t archive_bytes) {
    constexpr std::size_t any_archive = 250'000'000;
    return any_archive + surface_growth * archive_bytes;
}

bool is_archive(std::string_view bytes) { return bytes.starts_with(gzip_magic) || bytes.starts_with(zstd_magic); }

std::string decompress(std::string bytes, const std::string& path) {
    if (bytes.starts_with(gzip_magic)) return decompress_gzip(bytes, path);
    if (bytes.starts_with(zstd_magic)) return decompress_zstd(bytes, path);
    return bytes;
}

std::string inflate_block(std::string_view block, std::size_t size, const std::string& path) {
    return inflate_whole(block, size, MAX_WBITS, path);
}

std::string inflate_raw_block(std::string_view block, std::size_t size, const std::string& path) {
    return inflate_whole(block, size, -MAX_WBITS, path);
}

std::string deflate_block(std::string_view content) {
    uLong written = compressBound(content.size());
    std::string block(written, '\0');
    if (compress2(reinterpret_cast<Bytef*>(block.data()), &written, reinterpret_cast<const Bytef*>(content.data()),
                  content.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::bad_alloc();  // the only reason that is left
    block.resize(written);
    return block;
}

std::string name_in_archive(const std::string& path) {
    const std::filesystem::path file(path);
    const bool is_archive = file.extension() == ".gz" || file.extension() == ".zst";
    return is_archive ? (file.parent_path() / file.stem()).string() : path;
}

}  // namespace kerf
