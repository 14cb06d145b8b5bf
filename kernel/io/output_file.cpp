#include "io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"
#include "io/checked_file.h"

namespace kerf {

namespace fs = std::filesystem;

namespace {

// Where the bytes go: the file behind all links, which may be still to be written. What is no file stays as it is
// named, since the links of /dev/stdout lead to no path.
std::string target_of(const std::string& path) {
    std::error_code error;
    if (fs::exists(path, error)) {
        if (!fs::is_regular_file(path, error)) return path;
        const fs::path target = fs::canonical(path, error);
        return error ? path : target.string();
    }
    constexpr int most_links = 40;
    fs::path target = path;
    for (int i = 0; i < most_links && fs::is_symlink(target, error); ++i) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) break;
        target = target.parent_path() / next;  // an absolute one replaces all
    }
    return target.string();
}

std::string folder_of(const std::string& path) {
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

void write_and_close(CheckedFile file, std::span<const char> bytes) {
    file.write(bytes.data(), bytes.size());
    file.close();
}

// A new file beside the target, which is nobody else's.
std::string unused_name(const std::string& target) {
    std::string name = target + ".XXXXXX";
    const int fd = ::mkostemp(name.data(), O_CLOEXEC);
    if (fd < 0)
        throw Error(ErrorCode::io, fmt::format("Cannot write {}: {}. Check the permissions and the free space of its "
                                               "folder, or choose another one.",
                                               target, std::generic_category().message(errno)));
    const mode_t mask = ::umask(0);
    ::umask(mask);
    struct stat older;
    ::fchmod(fd, ::stat(target.c_str(), &older) == 0 ? older.st_mode & 07777 : 0666 & ~mask);
    ::close(fd);
    return name;
}

}  // namespace

void refuse_to_overwrite(const std::string& input, const std::string& option, const std::string& output) {
    std::error_code error;
    if (input.empty() || output.empty() || !fs::equivalent(input, output, error) || error) return;
    throw Error(ErrorCode::io, fmt::format("{} is {}, which is the input {} and would be lost. Choose another file.",
                                           option, output, input));
}

void require_writable(const std::string& option, const std::string& path) {
    if (path.empty()) return;
    const std::string target = target_of(path);
    std::error_code error;
    const bool exists = fs::exists(target, error);
    if (exists && fs::is_directory(target, error)) error = std::make_error_code(std::errc::is_a_directory);
    const bool is_file = exists && fs::is_regular_file(target);
    // A regular file is replaced by one beside it; devices and pipes are opened.
    const std::string asked = exists && !is_file ? target : folder_of(target);
    if (!error && ::access(asked.c_str(), is_file || !exists ? W_OK | X_OK : W_OK) != 0)
        error = {errno, std::generic_category()};
    if (error)
        throw Error(ErrorCode::io, fmt::format("{} is {}, which cannot be written: {}. Choose another place.", option,
                                               path, error.message()));
}

void write_output_file(const std::string& path, std::span<const char> bytes) {
    const std::string target = target_of(path);
    std::error_code error;
    if (fs::exists(target, error) && !fs::is_regular_file(target, error)) {
        write_and_close(CheckedFile(target, "wb"), bytes);
        return;
    }
    const std::string beside = unused_name(target);
    try {
        write_and_close(CheckedFile(beside, "wb"), bytes);
        fs::rename(beside, target, error);
        if (error)
            throw Error(ErrorCode::io, fmt::format("Cannot rename {} to {}: {}.", beside, target, error.message()));
    } catch (...) {
        fs::remove(beside, error);
        throw;
    }
}

}  // namespace kerf
