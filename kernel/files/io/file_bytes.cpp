// Surface files are read from front to back, into memory of our own: it outlives the file if another program truncates
// it meanwhile, where a mapping would end the process.
#include "files/io/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/core/error.h"

namespace kerf {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error(ErrorCode::io, path + ": the file cannot be read: " + reason + ".");
}

}  // namespace

FileReader::FileReader(const std::string& path) : path_(path) {
    if (path == "-")
        fail(path, "standard input is not supported because a surface is read more than once; give a file");
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail(path, "it is a folder; give a file");
    // A pipe may wait for ever, and a device may never end.
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        fail(path, "it is a pipe or a device; give a file");
    errno = 0;
    file_.open(path, std::ios::binary);
    if (!file_) fail(path, std::strerror(errno));
    size_ = std::filesystem::file_size(path, error);
    if (error) fail(path, error.message());
}

void FileReader::read(std::span<char> bytes) {
    if (!file_.read(bytes.data(), bytes.size())) fail(path_, "it ends before its size is reached");
}

std::string read_file(const std::string& path) {
    FileReader file(path);
    std::string bytes(file.size(), '\0');
    file.read(bytes);
    return bytes;
}

}  // namespace kerf
