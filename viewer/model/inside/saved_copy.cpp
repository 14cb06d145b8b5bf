#include "viewer/model/inside/saved_copy.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/folder_files.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "viewer/model/file_kind.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

void copy_to(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (!error) fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    if (error)
        throw Error(ErrorCode::io, fmt::format("Cannot write {}: {}. Check the permissions and the free space there, "
                                               "or choose another folder.",
                                               to.string(), error.message()));
}

void require_replaceable_trace(const std::string& path) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(path, error))) return;
    if (!fs::is_regular_file(path, error) || tell_kind(path).kind != OpenedPath::Kind::trace)
        throw Error(ErrorCode::io, fmt::format("{} is not a trace of Kerf, so it is not replaced. Choose another "
                                               "folder, or move it away.",
                                               path));
}

}  // namespace

std::string copy_run(const std::string& folder, const std::string& trace, const std::string& path) {
    if (path.empty()) throw Error(ErrorCode::io, "Say where the run shall be saved: a folder that does not exist yet.");
    const std::string full = absolute_path(path);
    std::error_code ignored;
    const bool has_trace = fs::exists(trace, ignored);
    if (has_trace)
        for (const char* end : {".trace", ".failed.trace"}) require_replaceable_trace(full + end);
    RunFolder copy = RunFolder::create(full);
    if (copy.finished_parts() > 0)
        throw Error(ErrorCode::io, fmt::format("An interrupted run into {} would be lost. Choose another folder, or "
                                               "remove {}.",
                                               full, copy.partial_path()));
    copy.keep_only({});
    for (const std::string& file : list_files(folder))
        if (!file.ends_with('/')) copy_to(fs::path(folder) / file, copy.file(file));
    const std::string place = copy.commit(inspect_run_folder(folder).is_valid);
    if (has_trace) copy_to(trace, place + ".trace");
    return place;
}

}  // namespace kerf::view
