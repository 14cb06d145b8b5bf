// A file whose every step is checked for errors.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/core/error.h"
#include "base/core/hash.h"

namespace kerf {

/// The error of a pipe that nobody reads any more.
class ReaderLeft : public Error {
    using Error::Error;
};

/// A file that is open until close() or the destructor. Each function throws Error(io) with the file, the step and the
/// system's reason, a full disk included; ReaderLeft for a pipe whose reader has gone.
class CheckedFile {
 public:
    CheckedFile(const std::string& path, const char* mode) : path_(path), file_(std::fopen(path.c_str(), mode)) {
        check(file_ != nullptr, "open");
    }

    /// Takes over a file that is open, or null with errno for one that could not be opened; `name` is for messages.
    CheckedFile(std::FILE* file, const std::string& name) : path_(name), file_(file) {
        check(file_ != nullptr, "open");
    }

    void write(const void* data, std::size_t size) {
        // Without data the pointer may be null, which fwrite must not get.
        check(size == 0 || std::fwrite(data, 1, size, file_.get()) == size, "write");
        if (hasher_) hasher_->add_bytes(data, size);
    }
    void write(std::string_view text) { write(text.data(), text.size()); }

    /// Reads up to `size` bytes, less at the end of the file.
    std::string read(std::size_t size) {
        std::string data(size, '\0');
        data.resize(read_into(data.data(), size));
        return data;
    }
    /// Reads at most `size` bytes; returns how many there were.
    std::size_t read_into(void* data, std::size_t size) {
        // Without room the pointer may be null, which fread must not get.
        const std::size_t got = size == 0 ? 0 : std::fread(data, 1, size, file_.get());
        check(!std::ferror(file_.get()), "read");
        if (hasher_ && got > 0) hasher_->add_bytes(data, got);
        return got;
    }
    /// Returns the number of bytes of the whole file.
    std::uint64_t size() const {
        struct stat told {};
        check(::fstat(::fileno(file_.get()), &told) == 0, "read");
        return told.st_size;
    }
    void seek(std::int64_t position) { check(::fseeko(file_.get(), position, SEEK_SET) == 0, "read"); }

    /// From now on all bytes that are written or read are added to `hasher`, too.
    void hash_into(Hasher& hasher) { hasher_ = &hasher; }

    void flush() { check(std::fflush(file_.get()) == 0, "write"); }

    /// Returns when all written bytes would outlive a power cut.
    void sync() { check(std::fflush(file_.get()) == 0 && ::fsync(::fileno(file_.get())) == 0, "write"); }

    /// Writes the bytes that are buffered, and may meet a full disk only here.
    void close() { check(std::fclose(file_.release()) == 0, "write"); }

 private:
    void check(bool ok, const char* action) const {
        if (ok) return;
        const int error = errno;
        const std::string text = fmt::format(
            "Cannot {} {}: {}. Check the free space and the permissions of its "
            "folder, or choose another one.",
            action, path_, std::generic_category().message(error));
        if (error == EPIPE) throw ReaderLeft(ErrorCode::io, text);
        throw Error(ErrorCode::io, text);
    }

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
    Hasher* hasher_ = nullptr;
};

}  // namespace kerf
