// Formats write millions of single numbers, so a file has a buffer of 1 MB of its own, into which they are formatted in
// place; only larger blocks go around it. The bytes are hashed on their way to the file, since the report of a run
// lists each file with its hash. Threads share an ExportFiles but not an ExportFile: the list of files alone is under a
// lock, and is sorted when it is asked for, so that it does not depend on who finished first.
#include "files/export/inside/export_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/export/inside/ghosts.h"

namespace kerf {

namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;
constexpr std::size_t longest_number = 32;

}  // namespace

ExportFile::ExportFile(ExportFiles& files, std::string name, const std::string& path)
    : files_(&files),
      name_(std::move(name)),
      file_(std::make_unique<CheckedFile>(path, "wb")),
      hasher_(std::make_unique<Hasher>()),
      buffer_(buffer_size) {
    file_->hash_into(*hasher_);
}

void ExportFile::flush() {
    file_->write(buffer_.data(), used_);
    written_ += used_;
    used_ = 0;
}

// Returns room for `size` bytes behind those in the buffer.
char* ExportFile::room(std::size_t size) {
    if (buffer_.size() - used_ < size) flush();
    return buffer_.data() + used_;
}

void ExportFile::write(const void* data, std::size_t size) {
    if (size >= buffer_.size()) {
        flush();
        file_->write(data, size);
        written_ += size;
        return;
    }
    if (size == 0) return;  // no data may be a null pointer
    std::memcpy(room(size), data, size);
    used_ += size;
}

void ExportFile::number(std::int64_t number) {
    char* begin = room(longest_number);
    used_ += std::to_chars(begin, begin + longest_number, number).ptr - begin;
}

void ExportFile::number(double number) {
    char* begin = room(longest_number);
    used_ += std::to_chars(begin, begin + longest_number, number).ptr - begin;
}

void ExportFile::point(const Vec3& p) {
    number(p.x());
    write(" ");
    number(p.y());
    write(" ");
    number(p.z());
}

void ExportFile::close() {
    flush();
    file_->close();
    files_->add({name_, written_, hash_text(hasher_->digest())});
}

std::string ExportFiles::path_of(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(folder_) / name;
    std::error_code error;
    if (!path.parent_path().empty()) std::filesystem::create_directories(path.parent_path(), error);
    if (error)
        throw Error(ErrorCode::io, fmt::format("Cannot create the folder {}: {}. Check the permissions and the free "
                                               "space there, or choose another one.",
                                               path.parent_path().string(), error.message()));
    return path.string();
}

ExportFile ExportFiles::create(const std::string& name) { return {*this, name, path_of(name)}; }

bool ExportFiles::is_of_others(const std::string& name) const {
    std::error_code ignored;
    const auto below = own_.lower_bound(name + "/");
    const bool is_own = own_.contains(name) || (below != own_.end() && below->starts_with(name + "/"));
    return !is_own && std::filesystem::exists(std::filesystem::path(place_) / name, ignored);
}

void ExportFiles::add(const std::string& name) { add(RunFile{name, -1, ""}); }

void ExportFiles::add(RunFile file) {
    const std::lock_guard lock(mutex_);
    files_.push_back(std::move(file));
}

std::vector<RunFile> ExportFiles::list() const {
    const std::lock_guard lock(mutex_);
    std::vector<RunFile> files = files_;
    sort_files(files);
    return files;
}

GhostFinder& ExportFiles::ghosts() {
    const std::lock_guard lock(mutex_);
    if (!ghosts_) ghosts_ = std::make_shared<GhostFinder>();
    return *ghosts_;
}

}  // namespace kerf
