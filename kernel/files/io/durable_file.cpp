#include "files/io/durable_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/core/error.h"
#include "files/io/checked_file.h"

namespace kerf {

namespace {

// Opens the folder, calls sync(file descriptor), closes it.
template <class Sync>
void sync_by(const std::string& folder, Sync sync) {
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0 && errno == EACCES) return;  // a folder may be written by who cannot read it
    const bool good = fd >= 0 && sync(fd) == 0;
    const int reason = errno;
    if (fd >= 0) ::close(fd);
    if (!good)
        throw Error(ErrorCode::io, fmt::format("The disk cannot be made to keep {}: {}. Check its free space and "
                                               "health, or choose another output folder.",
                                               folder, std::generic_category().message(reason)));
}

}  // namespace

void write_durable_file(const std::string& path, std::span<const char> bytes) {
    const std::string beside = path + ".new";
    CheckedFile file(beside, "wb");
    file.write(bytes.data(), bytes.size());
    file.sync();
    file.close();
    std::error_code error;
    std::filesystem::rename(beside, path, error);
    if (error) throw Error(ErrorCode::io, fmt::format("Cannot rename {} to {}: {}.", beside, path, error.message()));
    sync_folder(std::filesystem::path(path).parent_path().string());
}

void sync_folder(const std::string& path) { sync_by(path, ::fsync); }

void sync_file_system(const std::string& folder) { sync_by(folder, ::syncfs); }

}  // namespace kerf
