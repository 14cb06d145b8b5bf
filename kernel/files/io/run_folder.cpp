// A run is built in PATH.kerf-partial, under two locks: the creator holds one, the other ranks share the second. A lock
// belongs to the open file, so it ends with the process however that ends. A folder that was moved away under a waiting
// run is no longer the one of its name; so the lock counts only if the name still leads to it.
//
// A rename is atomic, but a directory that holds files is not replaced by one. So commit() moves the older run aside,
// moves the new one in, and only then removes the older; should another run move in between, it does the same again. A
// kill between the two renames leaves the older run aside, and the next run puts it back.
//
// Nothing is removed that is not known as a run of Kerf: a finished run by its sealed report (files/io/run_manifest.h),
// the remains of one under way by the names of their files. "Leaf" is the number of a part in the tree of cuts, by
// which its files are named.
#include "files/io/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/core/error.h"
#include "base/core/host_name.h"
#include "files/io/durable_file.h"
#include "files/io/folder_files.h"
#include "files/io/output_file.h"
#include "files/io/run_manifest.h"

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
    if (!error && !normal.has_filename()) normal = normal.parent_path();
    if (!error) normal = fs::weakly_canonical(behind_links(normal.string()), error);
    if (error) fail("use the output folder", "'" + path + "'", error);
    return normal.has_filename() ? normal.string() : normal.parent_path().string();
}

[[noreturn]] void refuse_foreign(const std::string& folder, const std::string& file) {
    throw Error(ErrorCode::io, fmt::format("The folder {} is not a run of Kerf alone: it holds {}, so it is not "
                                           "replaced. Choose another output folder, or move that away.",
                                           folder, file));
}

// Returns the content of a folder that holds a finished run to which nothing was added, or nothing at all; throws for
// all others.
FolderContent require_replaceable(const std::string& path) {
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_directory(path, error))
        throw Error(ErrorCode::io, fmt::format("The output folder {} is a file. Choose another name.", path));
    FolderContent content = inspect_run_folder(path);
    if (!content.foreign.empty()) refuse_foreign(path, content.foreign);
    return content;
}

// Throws unless the folder holds only files of a run that has not ended in order, and so has no list of its files.
void require_remains_of_run(const std::string& path) {
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_directory(path, error))
        throw Error(ErrorCode::io, fmt::format("{} is in the way of the run. Choose another output folder.", path));
    for (const std::string& file : list_files(path))
        if (!is_named_like_run_file(file)) refuse_foreign(path, file);
}

[[noreturn]] void refuse_finished_run(const std::string& path) {
    throw Error(ErrorCode::io, fmt::format("{} is a finished run, but a run may need that name. Rename it, or choose "
                                           "another output folder.",
                                           path));
}

// A folder that other file systems are mounted on cannot get another one's name.
void refuse_mount_point(const std::string& path) {
    struct stat folder, parent;
    if (::stat(path.c_str(), &folder) != 0 || ::stat(fs::path(path).parent_path().c_str(), &parent) != 0) return;
    if (folder.st_dev != parent.st_dev || folder.st_ino == parent.st_ino)
        throw Error(ErrorCode::io, fmt::format("A file system is mounted on the output folder {}, which therefore "
                                               "cannot be replaced as a whole. Choose a folder inside of it.",
                                               path));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

void create_folder(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) fail("create the folder", path, error);
}

bool is_same_file(int fd, const std::string& path) {
    struct stat open_file, named_file;
    return ::fstat(fd, &open_file) == 0 && ::stat(path.c_str(), &named_file) == 0 &&
           open_file.st_ino == named_file.st_ino && open_file.st_dev == named_file.st_dev;
}

constexpr const char* lock_file = "work/lock";    // held by the creator
constexpr const char* ranks_file = "work/ranks";  // shared by the others

constexpr std::string_view partial_suffix = ".kerf-partial";

std::string partial_path_of(const std::string& final_path) { return fmt::format("{}{}", final_path, partial_suffix); }
std::string failed_path_of(const std::string& final_path) { return final_path + ".failed"; }
std::string older_path_of(const std::string& partial) { return partial + "-older"; }
std::string removed_path_of(const std::string& partial) { return partial + "-removed"; }

// The leaves that have an entry in the journal of a run; a folder that is not there has none.
std::vector<NodeId> leaves_in_journal(const std::string& folder) {
    std::vector<NodeId> leaves;
    for (const std::string& entry : list_files((fs::path(folder) / "work/journal").string())) {
        const char* end = entry.data() + entry.size();
        const std::size_t slash = entry.rfind('/');
        std::int32_t leaf = 0;
        const auto [stop, error] =
            std::from_chars(entry.data() + (slash == std::string::npos ? 0 : slash + 1), end, leaf);
        if (error == std::errc() && stop == end) leaves.emplace_back(leaf);
    }
    return leaves;
}

// Returns the name of a file of a leaf in a folder that holds one file of each. A few hundred leaves have a folder of
// their own, named by the first of them: disks that many hosts share are slow where one folder holds thousands. No leaf
// before has that name for its file.
std::string with_folder_of(NodeId leaf, std::string name) {
    constexpr int leaves_without_folder = 2048, leaves_of_folder = 200;
    const std::int32_t number = leaf.value();
    if (number < leaves_without_folder) return name;
    return fmt::format("{}/{}", std::max(leaves_without_folder, number - number % leaves_of_folder), name);
}

// Tells whether a file is needed to continue a run with failed parts.
bool is_kept_for_next_run(const std::string& file) {
    return file.starts_with("work/journal/") || file == "work/run.json";
}

void clear_all_but_parts(const RunFolder& folder) {
    remove_run_files(folder.partial_path(), [](const std::string& name) {
        return !name.starts_with("parts/") && !name.starts_with("work/journal/") && name != "work/run.json" &&
               name != lock_file && name != ranks_file;
    });
    remove_empty_run_folders(folder.partial_path(), "failed");
}

// Moves the finished parts of a run with failed parts here. Those that cannot be moved are meshed again.
void take_over_finished_parts(const std::string& failed, const RunFolder& folder) {
    std::error_code ignored;
    const std::vector<NodeId> leaves = leaves_in_journal(failed);
    folder.make_room(leaves);
    for (const NodeId leaf : leaves)
        for (const std::string& name : {"parts/" + stored_part_file_name(leaf), journal_file_name(leaf)})
            fs::rename(fs::path(failed) / name, folder.file(name), ignored);
}

// A run that was stopped between two renames has left its older one aside.
void put_back(const std::string& older, const std::string& final_path) {
    std::error_code error;
    if (!fs::exists(final_path, error) && inspect_run_folder(older).is_run) fs::rename(older, final_path, error);
}

}  // namespace

// Opens the file and locks it without waiting: false if others hold a lock that excludes this one. A file system that
// knows no locks excludes nobody.
bool RunFolderLocks::try_lock(const std::string& name, int& fd, int operation) const {
    fd = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) fail("write the output folder", partial_, last_error());
    return ::flock(fd, operation | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

void RunFolderLocks::take(const std::string& final_path) {
    const std::string name = (fs::path(partial_) / lock_file).string();
    while (true) {
        if (!try_lock(name, creator_, LOCK_EX)) {
            std::string who;
            std::ifstream in(name);
            std::getline(in, who);
            throw Error(ErrorCode::io, fmt::format("Another run{} is writing {}. Wait for it, stop it, or choose "
                                                   "another output folder.",
                                                   who.empty() ? "" : " (" + who + ")", final_path));
        }
        if (is_same_file(creator_, name)) break;
        release();
        create_folder((fs::path(partial_) / "work").string());
    }
    if (!try_lock((fs::path(partial_) / ranks_file).string(), ranks_, LOCK_EX))
        throw Error(ErrorCode::io, fmt::format("Ranks of an interrupted run into {} have not ended yet. Try again in a "
                                               "moment, or stop them.",
                                               final_path));
    ::close(std::exchange(ranks_, -1));  // now those of this run may hold it
    const std::string who = fmt::format("process {} on {}\n", ::getpid(), host_name());
    if (::ftruncate(creator_, 0) != 0 || ::pwrite(creator_, who.data(), who.size(), 0) != std::ssize(who))
        fail("write the output folder", partial_, last_error());
}

void RunFolderLocks::share() {
    if (!try_lock((fs::path(partial_) / ranks_file).string(), ranks_, LOCK_SH))
        throw Error(ErrorCode::io, fmt::format("Another run is taking {} over.", partial_));
}

void RunFolderLocks::release() {
    for (int* fd : {&creator_, &ranks_})
        if (*fd >= 0) ::close(std::exchange(*fd, -1));
}

RunFolderLocks::RunFolderLocks(RunFolderLocks&& other) noexcept
    : partial_(std::move(other.partial_)),
      creator_(std::exchange(other.creator_, -1)),
      ranks_(std::exchange(other.ranks_, -1)) {}

RunFolder::RunFolder(std::string final_path, std::string partial, bool owner)
    : final_(std::move(final_path)), partial_(std::move(partial)), owner_(owner), locks_(partial_) {}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : final_(std::move(other.final_)),
      partial_(std::move(other.partial_)),
      taken_over_(std::move(other.taken_over_)),
      owner_(std::exchange(other.owner_, false)),
      keep_(other.keep_),
      locks_(std::move(other.locks_)) {}

// Files that are open leave traces on network disks when they are removed, so locks go first; what they protected is
// moved out of the way of other runs before.
RunFolder::~RunFolder() {
    try {
        std::error_code ignored;
        const std::string removed = removed_path_of(partial_);
        const bool removes = owner_ && !keep_;
        if (removes) fs::rename(partial_, removed, ignored);
        locks_.release();
        if (removes) remove_run_folder(removed);
    } catch (...) {  // no memory is left; the next run removes it
    }
}

std::vector<std::string> RunFolder::folders_of(const std::string& path) {
    const std::string final_path = normal_path(path), partial = partial_path_of(final_path);
    return {final_path, failed_path_of(final_path), partial, older_path_of(partial), removed_path_of(partial)};
}

std::string RunFolder::result_of(const std::string& path) {
    const std::size_t end = path.find_last_not_of('/');
    const std::string_view name = std::string_view(path).substr(0, end + 1);
    if (!name.ends_with(partial_suffix) || name.size() == partial_suffix.size()) return path;
    return std::string(name.substr(0, name.size() - partial_suffix.size()));
}

std::string RunFolder::saved_run_file(const std::string& path) {
    const std::string final_path = normal_path(path), partial = partial_path_of(final_path);
    std::error_code ignored;
    for (const std::string& folder : {partial, final_path, failed_path_of(final_path)}) {
        const std::string file = RunFolder("", folder, false).saved_run_file();
        if (fs::exists(file, ignored) && !inspect_run_folder(folder).is_valid) return file;
    }
    return RunFolder("", partial, false).saved_run_file();
}

RunFolder RunFolder::create(const std::string& path,
                            const std::function<bool(const std::string& saved_run)>& continues) {
    const std::string final_path = normal_path(path), partial = partial_path_of(final_path);
    const std::string failed = failed_path_of(final_path), older = older_path_of(partial);
    put_back(older, final_path);
    if (require_replaceable(final_path).exists) refuse_mount_point(final_path);
    if (require_replaceable(failed).is_valid) refuse_finished_run(failed);
    for (const std::string& remains : {partial, older, removed_path_of(partial)}) require_remains_of_run(remains);
    RunFolder folder(final_path, partial, false);
    std::error_code ignored;
    if (inspect_run_folder(partial).is_run && !fs::exists(folder.file(lock_file), ignored))
        refuse_finished_run(partial);
    remove_run_folder(removed_path_of(partial));
    create_folder(folder.file("work"));
    folder.locks_.take(final_path);
    folder.owner_ = true;
    if (inspect_run_folder(final_path).is_run) remove_run_folder(older);  // which that one has replaced
    clear_all_but_parts(folder);
    for (const char* name : {"parts", "work/journal", "work/jobs", "work/taken"}) create_folder(folder.file(name));
    for (const std::string& candidate : {failed, final_path}) {
        const std::string saved = RunFolder("", candidate, false).saved_run_file();
        if (folder.finished_parts() > 0 || !continues || !fs::exists(saved, ignored)) continue;
        const FolderContent content = inspect_run_folder(candidate);  // a kill may have left the work of a valid run
        if (!content.is_run || content.is_valid || !continues(saved)) continue;
        folder.taken_over_ = candidate;
        take_over_finished_parts(candidate, folder);
    }
    folder.keep_ = folder.finished_parts() > 0;  // what an interrupted run left is lost only to its heir
    for (const std::string& parent :
         {fs::path(final_path).parent_path().string(), folder.partial_, folder.file("work")})
        sync_folder(parent);
    return folder;
}

RunFolder RunFolder::create_transient(const std::string& path) {
    RunFolder folder(path, path, false);
    for (const char* name : {"parts", "work/jobs"}) create_folder(folder.file(name));
    return folder;
}

void RunFolder::keep_only(const std::vector<NodeId>& leaves) const {
    std::set<std::string> kept;
    for (const NodeId leaf : leaves) {
        kept.insert(journal_file_name(leaf));
        std::error_code ignored;
        const bool is_stored = fs::exists(stored_part_file(leaf), ignored);
        kept.insert("parts/" + (is_stored ? stored_part_file_name(leaf) : part_file_name(leaf)));
    }
    remove_run_files(partial_, [&](const std::string& name) {
        return (name.starts_with("parts/") || name.starts_with("work/journal/")) && !kept.contains(name);
    });
    for (const char* name : {"parts", "work/journal"}) remove_empty_run_folders(partial_, name);
    make_room(leaves);
}

void RunFolder::make_room(const std::vector<NodeId>& leaves) const {
    std::set<fs::path> folders = {file("parts")};
    for (const NodeId leaf : leaves)
        for (const std::string& name : {part_file(leaf), job_file(leaf), journal_file(leaf), begun_file(leaf)})
            folders.insert(fs::path(name).parent_path());
    for (const fs::path& folder : folders) create_folder(folder.string());
}

RunFolder RunFolder::join(const std::string& partial_path) {
    std::error_code error;
    if (!fs::is_directory(fs::path(partial_path) / "parts", error))
        throw Error(ErrorCode::io, fmt::format("The output folder {} is not visible here. All hosts of a run need the "
                                               "output folder on a shared disk under the same path.",
                                               partial_path));
    RunFolder folder("", partial_path, false);
    folder.locks_.share();
    return folder;
}

std::string RunFolder::file(const std::string& name) const { return (fs::path(partial_) / name).string(); }
std::string RunFolder::stored_part_file(NodeId leaf) const { return file("parts/" + stored_part_file_name(leaf)); }
std::string RunFolder::part_file(NodeId leaf) const { return file("parts/" + part_file_name(leaf)); }
std::string RunFolder::part_surface_file(NodeId leaf) const { return file("parts/" + part_surface_file_name(leaf)); }
std::string RunFolder::part_stl_file(NodeId leaf) const { return file("parts/" + part_stl_file_name(leaf)); }
std::string RunFolder::saved_run_file() const { return file("work/run.json"); }
std::string RunFolder::job_file(NodeId leaf) const { return file(job_file_name(leaf)); }
std::string RunFolder::journal_file(NodeId leaf) const { return file(journal_file_name(leaf)); }
std::string RunFolder::begun_file(NodeId leaf) const { return file(begun_file_name(leaf)); }

std::size_t RunFolder::finished_parts() const { return leaves_in_journal(partial_).size(); }

std::string RunFolder::commit(bool valid) {
    if (!owner_) throw Error(ErrorCode::internal, "A run folder is committed once, and by its creator.");
    const std::string place = !valid && require_replaceable(final_).is_valid ? failed_path_of(final_) : final_;
    sync_file_system(partial_);
    const std::string older = older_path_of(partial_);
    std::error_code error;
    while (fs::rename(partial_, place, error), error) {
        if (error != std::errc::directory_not_empty && error != std::errc::file_exists) break;
        if (require_replaceable(place).is_valid && !valid) refuse_finished_run(place);
        remove_run_folder(older);
        fs::rename(place, older, error);
        if (error && error != std::errc::no_such_file_or_directory) break;
    }
    if (error) {
        std::error_code ignored;
        fs::rename(older, place, ignored);  // nothing was gained, so nothing shall be lost
        fail("write the output folder", place, error);
    }
    owner_ = false;
    locks_.release();
    sync_folder(fs::path(place).parent_path().string());
    // The result is complete with and without what follows.
    try {
        remove_run_files(place, [&](const std::string& file) {
            return file.starts_with("work/") && (valid || !is_kept_for_next_run(file));
        });
    } catch (const Error&) {
    }
    remove_empty_run_folders(place, "work");
    remove_run_folder(older);
    if (valid && !taken_over_.empty() && taken_over_ != place) remove_run_folder(taken_over_);
    return place;
}

std::string stored_part_file_name(NodeId leaf) {
    return with_folder_of(leaf, fmt::format("part_{:04}.part", leaf.value()));
}
std::string part_file_name(NodeId leaf) { return with_folder_of(leaf, fmt::format("part_{:04}.vtu", leaf.value())); }
std::string part_surface_file_name(NodeId leaf) {
    return with_folder_of(leaf, fmt::format("part_{:04}.surface.vtu", leaf.value()));
}
std::string part_stl_file_name(NodeId leaf) {
    return with_folder_of(leaf, fmt::format("part_{:04}.stl", leaf.value()));
}
std::string failed_part_file_name(NodeId leaf) {
    return with_folder_of(leaf, fmt::format("part_{:04}.txt", leaf.value()));
}

std::string job_file_name(NodeId leaf) { return "work/jobs/" + with_folder_of(leaf, std::to_string(leaf.value())); }
std::string journal_file_name(NodeId leaf) {
    return "work/journal/" + with_folder_of(leaf, std::to_string(leaf.value()));
}
std::string begun_file_name(NodeId leaf) { return "work/taken/" + with_folder_of(leaf, std::to_string(leaf.value())); }

}  // namespace kerf
