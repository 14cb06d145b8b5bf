// A folder that appears under its name only when it is complete, and can be continued until then.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The locks on the partial folder of a run: one that its creator holds, one that its other ranks share.
class RunFolderLocks {
 public:
    explicit RunFolderLocks(std::string partial) : partial_(std::move(partial)) {}
    RunFolderLocks(RunFolderLocks&& other) noexcept;
    RunFolderLocks& operator=(RunFolderLocks&&) = delete;
    ~RunFolderLocks() { release(); }

    /// Takes the lock of the creator: until this returns nothing in the folder is this run's. `final_path` serves
    /// messages. Throws Error(io) if another run is writing there, or ranks of one still live.
    void take(const std::string& final_path);
    /// Takes the lock that all other ranks share. Throws Error(io) if another run is taking the folder over.
    void share();
    void release();

 private:
    bool try_lock(const std::string& name, int& fd, int operation) const;

    std::string partial_;
    int creator_ = -1, ranks_ = -1;  // descriptors of the open lock files, -1: none
};

/// Builds a result under PATH.kerf-partial and renames it at the end.
///
/// The sub-folder `work` holds the run while it is under way: a lock, the run's options, the jobs that wait, the names
/// of those that are taken, and the journal of finished parts. A run that was interrupted leaves the partial folder
/// with its parts and journal; the next one into PATH finds them there, and nothing else of it. A run with failed parts
/// leaves the journal in its result, which the next run into PATH takes over in the same way.
///
/// An older run under the final name is replaced as a whole, never mixed; but a valid one is not replaced by one with
/// failed parts, which gets the name PATH.failed. Only runs of Kerf are ever replaced or removed
/// (files/io/run_manifest.h): with a file of anybody else in the way, under any of these names, the run is refused, so
/// that nobody's files are lost. With several ranks the first creates and commits, the others open the same partial
/// folder.
class RunFolder {
 public:
    /// Checks `path`, makes its partial folder or takes over that of an interrupted run, and makes the folders above
    /// where they are missing. An older run that a kill has left aside gets its name back, or is removed if another one
    /// has it. If no run was interrupted, but an older one has failed parts and `continues` says of its
    /// saved_run_file() that this run is the same, its finished parts are taken over. Links are followed, also those
    /// that lead to nothing yet. Throws Error(io) if the folder cannot be written or holds foreign files, naming the
    /// first, or if another run is writing it or ranks of an interrupted one still live, naming the folder and the
    /// reason. A file system without locks keeps nobody out.
    static RunFolder create(const std::string& path,
                            const std::function<bool(const std::string& saved_run)>& continues = {});
    /// Makes a folder for a run that leaves none: `path` itself, new, without locks and without anything by which a run
    /// is continued. The caller has made the folder above and removes it. Throws Error(io).
    static RunFolder create_transient(const std::string& path);
    /// Opens the partial folder that another rank has created. Throws Error(io) if this host does not see it.
    static RunFolder join(const std::string& partial_path);
    /// Returns saved_run_file() of the run into `path` that was interrupted or has failed parts, or its place if there
    /// is no such run. Throws Error(io) if that cannot be a path.
    static std::string saved_run_file(const std::string& path);

    /// Returns the path of the result for a partial folder, and any other path as it is.
    static std::string result_of(const std::string& path);

    /// Returns the folders that a run into `path` may write, replace or remove: its result, that of a run with failed
    /// parts, and the partial one. Throws Error(io) if they cannot be paths.
    static std::vector<std::string> folders_of(const std::string& path);

    RunFolder(RunFolder&& other) noexcept;
    RunFolder& operator=(RunFolder&&) = delete;
    /// Removes the partial folder unless it was committed or is to be kept.
    ~RunFolder();

    const std::string& partial_path() const { return partial_; }
    const std::string& final_path() const { return final_; }  ///< empty if another rank has created the folder
    std::string stored_part_file(NodeId leaf) const;          ///< .../parts/part_0008.part
    std::string part_file(NodeId leaf) const;                 ///< .../parts/part_0008.vtu
    std::string part_surface_file(NodeId leaf) const;         ///< .../parts/part_0008.surface.vtu
    std::string part_stl_file(NodeId leaf) const;             ///< .../parts/part_0008.stl
    std::string file(const std::string& name) const;

    std::string saved_run_file() const;           ///< the options, for a run that continues this one
    std::string job_file(NodeId leaf) const;      ///< the part's job, for a worker
    std::string journal_file(NodeId leaf) const;  ///< exists when the part is finished
    std::string begun_file(NodeId leaf) const;    ///< exists once a worker has begun the part, for watchers of the run

    /// Returns the number of journal entries.
    std::size_t finished_parts() const;

    /// Removes parts and journal entries of other leaves, and all surfaces, that an interrupted run has left; also the
    /// files part_file() of leaves that have a stored_part_file(). Makes room for all of these leaves then. Only for
    /// the creator. Throws Error(io).
    void keep_only(const std::vector<NodeId>& leaves) const;
    /// Makes the folders that files of these leaves lie in. Throws Error(io).
    void make_room(const std::vector<NodeId>& leaves) const;

    /// From now on the destructor leaves the folder for the next run (keep()), or removes it again (discard()).
    void keep() { keep_ = true; }
    void discard() { keep_ = false; }

    /// Waits for the disk and renames the folder to its final name. Removes the older run there, the one with failed
    /// parts whose finished parts a valid run has taken over, and `work`; of `work` a run that is not `valid` keeps the
    /// files by which the next one continues it. Returns the final name, which ends with ".failed" if the run is not
    /// valid and a valid one has the name. Only for the creator. Throws Error(io) if there are foreign files under the
    /// final name.
    std::string commit(bool valid);

 private:
    RunFolder(std::string final_path, std::string partial, bool owner);

    std::string final_, partial_;
    std::string taken_over_;  // the folder of a run with failed parts whose finished parts are here now; or empty
    bool owner_ = false, keep_ = false;
    RunFolderLocks locks_;
};

/// File names of a part, part_0008.part, part_0008.vtu, part_0008.surface.vtu and part_0008.stl, relative to the folder
/// `parts`. Leaves from 2048 on, of runs with more than 1,024 parts, have folders of their own there, one for 200
/// leaves: 4000/part_4123.vtu. No folder of a run with thousands of parts holds more than 1,000 names.
std::string stored_part_file_name(NodeId leaf);
std::string part_file_name(NodeId leaf);
std::string part_surface_file_name(NodeId leaf);
std::string part_stl_file_name(NodeId leaf);
/// The name part_0008.txt, relative to the folder `failed`, which is divided in the same way as `parts`.
std::string failed_part_file_name(NodeId leaf);
/// The names work/jobs/8, work/journal/8 and work/taken/8, relative to the partial folder; work/jobs/4000/4123 of a
/// leaf from 2048 on.
std::string job_file_name(NodeId leaf);
std::string journal_file_name(NodeId leaf);
std::string begun_file_name(NodeId leaf);

}  // namespace kerf
