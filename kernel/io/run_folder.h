// A folder that appears under its name only when it is complete, and can be continued until then.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace kerf {

/// The locks on the partial folder of a run: one that its creator holds, one that its other ranks share.
class RunFolderLocks {
 public:
    explicit RunFolderLocks(std::string partial) : partial_(std::move(partial)) {}
    RunFolderLocks(RunFolderLocks&& other) noexcept;
    RunFolderLocks& operator=(RunFolderLocks&&) = delete;
    ~RunFolderLocks() { release(); }

    /// Until this returns nothing in the folder is this run's. `final_path` serves messages. Throws Error(io) if
    /// another run is writing there, or ranks of one still live.
    void take(const std::string& final_path);
    /// Throws Error(io) if another run is taking the folder over.
    void share();
    void release();

 private:
    bool try_lock(const std::string& name, int& fd, int operation) const;

    std::string partial_;
    int creator_ = -1, ranks_ = -1;  // open files
};

/// Builds a result under PATH.kerf-partial and renames it at the end.
///
/// What is under way lies in its sub-folder `work`: a lock, the run's options, the jobs that wait, which of them are
/// taken, and the journal of finished parts. A run that was interrupted leaves the partial folder with its parts and
/// journal; the next one into PATH finds them there, and nothing else of it. A run with failed parts leaves the journal
/// in its result, which the next run into PATH takes over in the same way.
///
/// An older run under the final name is replaced as a whole, never mixed; but a valid one is not replaced by one with
/// failed parts, which gets the name PATH.failed. Only runs of Kerf are ever replaced or removed
/// (io/run_manifest.h): with a file of anybody else in the way, under any of these names, the run is refused, so that
/// nobody's files are lost. With several ranks the first creates and commits, the others open the same partial folder.
class RunFolder {
 public:
    /// Checks `path`, makes its partial folder or takes over that of an interrupted run, and makes the folders above
    /// where they are missing. An older run that a kill has left aside gets its name back, or is removed if another one
    /// has it. If none was interrupted, but one has failed parts and `continues` says of its
    /// saved_run_file() that this run is the same, its finished parts are taken over. Links are followed, also those
    /// that lead to nothing yet. Throws Error(io) if it cannot be written or holds foreign files, naming the first, or
    /// if another run is writing it or ranks of an interrupted one still live, naming the folder and the reason. A file
    /// system without locks keeps nobody out.
    static RunFolder create(const std::string& path,
                            const std::function<bool(const std::string& saved_run)>& continues = {});
    /// A folder for a run that leaves none: `path` itself, new, without locks and whatever continues a run. Who has
    /// made the folder above removes it. Throws Error(io).
    static RunFolder create_transient(const std::string& path);
    /// Opens the partial folder that another rank has created. Throws Error(io) if this host does not see it.
    static RunFolder join(const std::string& partial_path);
    /// saved_run_file() of a run into `path` that was interrupted or has failed parts; where it would lie if there is
    /// none. Throws Error(io) if that cannot be a path.
    static std::string saved_run_file(const std::string& path);

    /// The result of the run whose partial folder `path` is, or else `path` as it is.
    static std::string result_of(const std::string& path);

    /// The folders that a run into `path` may write, replace or remove: its result, that of a run with failed parts,
    /// and what is under way. Throws Error(io) if it cannot be a path.
    static std::vector<std::string> folders_of(const std::string& path);

    RunFolder(RunFolder&& other) noexcept;
    RunFolder& operator=(RunFolder&&) = delete;
    /// Removes what was neither committed nor is to be kept.
    ~RunFolder();

    const std::string& partial_path() const { return partial_; }
    const std::string& final_path() const { return final_; }  ///< empty if another rank has created the folder
    std::string stored_part_file(int leaf) const;             ///< .../parts/part_0008.part
    std::string part_file(int leaf) const;                    ///< .../parts/part_0008.vtu
    std::string part_surface_file(int leaf) const;            ///< .../parts/part_0008.surface.vtu
    std::string part_stl_file(int leaf) const;                ///< .../parts/part_0008.stl
    std::string file(const std::string& name) const;

    std::string saved_run_file() const;        ///< the options, for who continues the run
    std::string job_file(int leaf) const;      ///< what a worker needs to know of a part
    std::string journal_file(int leaf) const;  ///< exists when the part is finished
    std::string begun_file(int leaf) const;    ///< exists since a worker has begun the part, for who watches the run

    /// Number of journal entries.
    std::size_t finished_parts() const;

    /// Removes parts and journal entries of other leaves, and all surfaces, that an interrupted run has left; also the
    /// files part_file() of leaves that have a stored_part_file(). Then there is room for all of these leaves. Only for
    /// the creator. Throws Error(io).
    void keep_only(const std::vector<int>& leaves) const;
    /// Makes the folders that files of these leaves lie in. Throws Error(io).
    void make_room(const std::vector<int>& leaves) const;

    /// From now on the destructor leaves the folder for the next run, or again does not.
    void keep() { keep_ = true; }
    void discard() { keep_ = false; }

    /// Waits for the disk, renames the folder to its final name, and removes an older run there, the one with failed
    /// parts that a valid one has taken over, and `work`, of which a run that is not `valid` keeps what the next one
    /// needs. Returns the final name: that of a run that is not valid ends with ".failed" if a valid one has the name.
    /// Only for the creator. Throws Error(io) if there are foreign files under the final name.
    std::string commit(bool valid);

 private:
    RunFolder(std::string final_path, std::string partial, bool owner);

    std::string final_, partial_;
    std::string taken_over_;  // the folder of a run with failed parts whose finished ones are here now; or empty
    bool owner_ = false, keep_ = false;
    RunFolderLocks locks_;
};

/// part_0008.part, part_0008.vtu, part_0008.surface.vtu, part_0008.stl: names relative to the folder `parts`, in which
/// leaves from 2048 on, of runs with more than 1,024 parts, have folders of their own for 200 each:
/// 4000/part_4123.vtu. No folder of a run with thousands of parts holds more than 1,000 names.
std::string stored_part_file_name(int leaf);
std::string part_file_name(int leaf);
std::string part_surface_file_name(int leaf);
std::string part_stl_file_name(int leaf);
/// part_0008.txt, relative to the folder `failed`, which is divided in the same way.
std::string failed_part_file_name(int leaf);
/// work/jobs/8, work/journal/8, work/taken/8, relative to the partial folder; work/jobs/4000/4123.
std::string job_file_name(int leaf);
std::string journal_file_name(int leaf);
std::string begun_file_name(int leaf);

}  // namespace kerf
