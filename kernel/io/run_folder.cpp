// A rename is atomic, but a directory that holds files is not replaced by one. So commit() moves the older run aside,
// moves the new one in, and only then removes the older; should another run move in between, it does the same again.
#include "io/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace kerf {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& action, const std::string& path, const std::error_code& reason) {
    throw Error(ErrorCode::io,
                fmt::format("Cannot {} {}: {}. Check the permissions and the free space there, or choose "
                            "another output folder.",
                            action, path, reason.message()));
}

// Absolute, without links or a slash at the end, so that a sibling's name is the path and a suffix.
std::string normal_path(const std::string& path) {
    std::error_code error;
    fs::path normal = fs::absolute(path, error);
    if (!error) normal = fs::weakly_canonical(normal, error);
    if (error) fail("use the output folder", "'" + path + "'", error);
    return normal.has_filename() ? normal.string() : normal.parent_path().string();
}

// Only an empty folder or an older run may be replaced.
void refuse_foreign(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return;
    if (status.type() == fs::file_type::none) fail("read the output folder", path, error);
    if (!fs::is_directory(status))
        throw Error(ErrorCode::io, fmt::format("The output folder {} is a file. Choose another name.", path));
    const bool is_run = fs::exists(fs::path(path) / "report.json", error);
    const bool is_empty = !error && fs::is_empty(path, error);
    if (error) fail("read the output folder", path, error);
    if (!is_run && !is_empty)
        throw Error(ErrorCode::io, fmt::format("The folder {} holds files but no report.json, so it is not a run of "
                                               "Kerf and is not replaced. Choose another output folder or empty it.",
                                               path));
}

// The process number keeps runs on one host apart, the counter those on hosts that share the disk: creating a directory
// succeeds for one of them only.
std::string create_sibling(const std::string& path) {
    const std::string stem = fmt::format("{}.kerf-tmp-{}", path, ::getpid());
    std::string name = stem;
    for (int i = 2;; ++i) {
        std::error_code error;
        if (fs::create_directory(name, error)) return name;
        if (error) fail("create the folder", name, error);
        name = fmt::format("{}-{}", stem, i);
    }
}

}  // namespace

RunFolder::RunFolder(std::string final_path, std::string temporary, bool owner)
    : final_(std::move(final_path)), temporary_(std::move(temporary)), owner_(owner) {}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : final_(std::move(other.final_)),
      temporary_(std::move(other.temporary_)),
      owner_(std::exchange(other.owner_, false)) {}

RunFolder::~RunFolder() {
    std::error_code ignored;
    if (owner_) fs::remove_all(temporary_, ignored);
}

RunFolder RunFolder::create(const std::string& path) {
    const std::string final_path = normal_path(path);
    refuse_foreign(final_path);
    std::error_code error;
    const fs::path parent = fs::path(final_path).parent_path();
    fs::create_directories(parent, error);
    if (error) fail("create the folder", parent.string(), error);
    RunFolder folder(final_path, create_sibling(final_path), true);
    const std::string parts = folder.file("parts");
    fs::create_directory(parts, error);
    if (error) fail("create the folder", parts, error);
    return folder;
}

RunFolder RunFolder::join(const std::string& temporary_path) {
    std::error_code error;
    if (!fs::is_directory(fs::path(temporary_path) / "parts", error))
        throw Error(ErrorCode::io, fmt::format("The output folder {} is not visible here. All hosts of a run need the "
                                               "output folder on a shared disk under the same path.",
                                               temporary_path));
    return {"", temporary_path, false};
}

std::string RunFolder::file(const std::string& name) const { return (fs::path(temporary_) / name).string(); }
std::string RunFolder::part_file(int leaf) const { return file("parts/" + part_file_name(leaf)); }
std::string RunFolder::part_surface_file(int leaf) const { return file("parts/" + part_surface_file_name(leaf)); }
std::string RunFolder::part_stl_file(int leaf) const { return file("parts/" + part_stl_file_name(leaf)); }

void RunFolder::commit() {
    if (!owner_) throw Error(ErrorCode::internal, "A run folder is committed once, and by its creator.");
    const std::string older = temporary_ + "-older";
    std::error_code error;
    while (fs::rename(temporary_, final_, error), error) {
        if (error != std::errc::directory_not_empty && error != std::errc::file_exists) break;
        refuse_foreign(final_);
        fs::remove_all(older, error);
        fs::rename(final_, older, error);
        if (error && error != std::errc::no_such_file_or_directory) break;
    }
    if (error) {
        std::error_code ignored;
        fs::rename(older, final_, ignored);  // nothing was gained, so nothing shall be lost
        fail("write the output folder", final_, error);
    }
    owner_ = false;
    fs::remove_all(older, error);
    if (error) fail("remove the older run", older, error);
}

std::string part_file_name(int leaf) { return fmt::format("part_{:04}.vtu", leaf); }
std::string part_surface_file_name(int leaf) { return fmt::format("part_{:04}.surface.vtu", leaf); }
std::string part_stl_file_name(int leaf) { return fmt::format("part_{:04}.stl", leaf); }

}  // namespace kerf
