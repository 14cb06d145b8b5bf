// An output is written in full to a new file beside its place, synced, and renamed over the older one, so that neither
// a full disk nor a power cut leaves half a file. The new file gets the permissions of the older one. Three kinds of
// place cannot be replaced by a rename and are written to directly: descriptors of the process (fd:N, /dev/stdout),
// devices and pipes, and files in folders that allow no new name. Two paths are one file if the system says so or if
// they are equal once links are resolved: the file need not exist yet. All refusals (`refuse_...`, `require_writable`)
// are made before the work of a run, so that no result is lost for a name.
#include "files/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/checked_file.h"
#include "files/io/durable_file.h"

namespace kerf {

namespace fs = std::filesystem;

namespace {

// The number of a descriptor that a path names; -1 for a path of a file.
int descriptor_of(const std::string& path) {
    if (path == "/dev/stdout") return STDOUT_FILENO;
    if (path == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view prefix : {"fd:", "/dev/fd/", "/proc/self/fd/"}) {
        if (!path.starts_with(prefix)) continue;
        int number = -1;
        const char* end = path.data() + path.size();
        const auto [stop, error] = std::from_chars(path.data() + prefix.size(), end, number);
        return error == std::errc() && stop == end ? number : -1;
    }
    return -1;
}

std::string folder_of(const std::string& path) {
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

// Returns the path without links, as far as it exists, and without a slash at its end.
fs::path behind_all_links(const std::string& path) {
    std::error_code ignored;  // a path that cannot be used is refused where it is used
    const auto clean = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
    return clean.has_filename() ? clean : clean.parent_path();
}

// Tells whether an output under this path takes the place of older content: true for files, false for devices and
// pipes.
bool is_file_or_nothing(const std::string& path) {
    std::error_code error;
    return descriptor_of(path) < 0 && (!fs::exists(path, error) || fs::is_regular_file(path, error));
}

bool are_one_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error) && !error) return true;
    return behind_all_links(behind_links(a)) == behind_all_links(behind_links(b));
}

bool is_of_kind(const std::string& file, const OutputKind& kind) {
    constexpr std::size_t beginning = 1024;
    const std::string text = CheckedFile(file, "rb").read(beginning);
    return text.empty() || kind.is(text);
}

void write_in_place(const std::string& path, std::span<const char> bytes) {
    CheckedFile file(open_output(path), path);
    file.write(bytes.data(), bytes.size());
    file.close();
}

bool is_pipe(const std::string& path) {
    std::error_code error;
    return fs::is_fifo(path, error);
}

// Opens a pipe, without waiting for ever for a reader.
std::FILE* open_pipe(const std::string& path) {
    constexpr int most_tries = 20;
    constexpr std::chrono::milliseconds pause(100);
    int fd = -1;
    for (int i = 0; fd < 0 && i < most_tries; ++i) {
        if (i > 0) std::this_thread::sleep_for(pause);
        fd = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        if (fd < 0 && errno != ENXIO) return nullptr;
    }
    if (fd < 0)
        throw Error(ErrorCode::io,
                    fmt::format("{} is a pipe that nobody reads. Start what reads it first, or name a file.", path));
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK);
    return ::fdopen(fd, "wb");
}

// Opens a new file beside the target under a name that nobody else has, and returns it by `name`; -1 with errno if none
// can be made.
int open_beside(const std::string& target, std::string& name) {
    int fd = -1;
    for (int n = 0; fd < 0; ++n) {
        name = fmt::format("{}.{}-{}", target, ::getpid(), n);
        fd = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST) return fd;
    }
    struct stat older;
    if (::stat(target.c_str(), &older) == 0) ::fchmod(fd, older.st_mode & 07777);
    return fd;
}

}  // namespace

std::string behind_links(const std::string& path) {
    constexpr int most_links = 40;
    std::error_code error;
    fs::path target = path;
    for (int i = 0; i < most_links && fs::is_symlink(target, error); ++i) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) break;
        target = target.parent_path() / next;  // an absolute one replaces all
    }
    return target.string();
}

void refuse_to_overwrite(const std::string& input, const std::string& option, const std::string& output) {
    std::error_code error;
    if (input.empty() || output.empty() || !fs::equivalent(input, output, error) || error) return;
    throw Error(ErrorCode::io, fmt::format("{} is {}, which is the input {} and would be lost. Choose another file.",
                                           option, output, input));
}

void refuse_same_outputs(const std::vector<NamedPath>& outputs) {
    const auto is_lost = [](const std::string& path) { return !path.empty() && is_file_or_nothing(path); };
    for (auto one = outputs.begin(); one != outputs.end(); ++one)
        for (auto other = outputs.begin(); other != one; ++other)
            if (is_lost(one->path) && is_lost(other->path) && are_one_file(one->path, other->path))
                throw Error(ErrorCode::usage,
                            fmt::format("{} and {} are both {}, so that one of them would be lost. Give each a file of "
                                        "its own.",
                                        other->option, one->option, one->path));
}

bool lies_inside(const std::string& file, const std::string& folder) {
    const fs::path inner = behind_all_links(file), outer = folder.empty() ? fs::path() : behind_all_links(folder);
    return !outer.empty() && std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

void require_writable(const std::string& option, const std::string& path, const OutputKind& kind) {
    if (path.empty() || descriptor_of(path) >= 0) return;
    const std::string target = behind_links(path);
    std::error_code error;
    const bool exists = fs::exists(target, error);
    if (exists && fs::is_directory(target, error)) error = std::make_error_code(std::errc::is_a_directory);
    const bool is_allowed =
        exists ? ::access(target.c_str(), W_OK) == 0 : ::access(folder_of(target).c_str(), W_OK | X_OK) == 0;
    if (!error && !is_allowed) error = {errno, std::generic_category()};
    if (error)
        throw Error(ErrorCode::io, fmt::format("{} is {}, which cannot be written: {}. Choose another place.", option,
                                               path, error.message()));
    if (exists && fs::is_regular_file(target, error) && !is_of_kind(target, kind))
        throw Error(ErrorCode::io, fmt::format("{} is {}, where a file lies that is no {} of Kerf and would be lost. "
                                               "Move it away, or choose another place.",
                                               option, path, kind.name));
}

void refuse_file_name(const std::string& option, const std::string& folder, const std::string& hint) {
    const std::string ending = fs::path(folder).extension().string();
    const bool is_of_file =
        ending.size() > 1 && std::isalpha(static_cast<unsigned char>(ending[1])) != 0 &&
        std::all_of(ending.begin() + 1, ending.end(), [](unsigned char c) { return std::isalnum(c); });
    std::error_code error;
    if (!is_of_file || fs::exists(folder, error)) return;
    throw Error(ErrorCode::usage, fmt::format("{} is {}, the name of a file, but a folder is made there.{} If you want "
                                              "a folder of that name, end it with a slash: {}/.",
                                              option, folder, hint, folder));
}

std::FILE* open_output(const std::string& path) {
    const int descriptor = descriptor_of(path);
    if (descriptor < 0 && !path.starts_with("fd:"))
        return is_pipe(path) ? open_pipe(path) : std::fopen(path.c_str(), "wb");
    const int copy = ::dup(descriptor);  // sets errno where there is no such file
    return copy < 0 ? nullptr : ::fdopen(copy, "w");
}

void write_output_file(const std::string& path, std::span<const char> bytes) {
    std::error_code error;
    const std::string target = behind_links(path);
    const bool is_replaced = is_file_or_nothing(path);
    std::string beside;
    const int fd = is_replaced ? open_beside(target, beside) : -1;
    const int reason = errno;
    if (!is_replaced || (fd < 0 && (reason == EACCES || reason == EPERM || reason == ENAMETOOLONG))) {
        write_in_place(path, bytes);
        return;
    }
    errno = reason;
    CheckedFile file(fd < 0 ? nullptr : ::fdopen(fd, "wb"), beside);
    try {
        file.write(bytes.data(), bytes.size());
        file.sync();  // before the name is that of the older one: a power cut must not leave neither
        file.close();
        fs::rename(beside, target, error);
        if (error)
            throw Error(ErrorCode::io, fmt::format("Cannot rename {} to {}: {}.", beside, target, error.message()));
        sync_folder(folder_of(target));
    } catch (...) {
        fs::remove(beside, error);
        throw;
    }
}

}  // namespace kerf
