// One read into one buffer: surface files are read once from front to back, and a string outlives the file if another
// program truncates it meanwhile, where a mapping would end the process.
#include "io/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace kerf {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error(ErrorCode::io, path + ": the file cannot be read: " + reason + ".");
}

}  // namespace

std::string read_file(const std::string& path) {
    if (path == "-")
        fail(path, "standard input is not supported because a surface is read more than once; give a file");
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail(path, "it is a folder; give a file");
    // A pipe may wait for ever, and a device may never end.
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        fail(path, "it is a pipe or a device; give a file");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, std::strerror(errno));
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) fail(path, error.message());
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) fail(path, "it ends before its size is reached");
    return bytes;
}

}  // namespace kerf
