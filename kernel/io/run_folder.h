// A folder that appears under its name only when it is complete, and can be continued until then.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// Builds a result under PATH.kerf-partial and renames it at the end.
///
/// What is under way lies in its sub-folder `work`: a lock, the run's options, the jobs that wait, which of them are
/// taken, and the journal of finished parts. A run that was interrupted leaves the partial folder with its parts and
/// journal; the next one into PATH finds them there, and nothing else of it.
///
/// An older run under the final name is replaced as a whole, never mixed. A folder that exists but holds no report.json
/// and is not empty is not a run of Kerf: it is refused, so that nobody's files are lost. With several ranks the first
/// creates and commits, the others open the same partial folder.
class RunFolder {
 public:
    /// Checks `path`, makes its partial folder or takes over that of an interrupted run, and makes the folders above
    /// where they are missing. Throws Error(io) if it cannot be written, or if another run is writing it or ranks of an
    /// interrupted one still live, naming the folder and the reason. A file system without locks keeps nobody out.
    static RunFolder create(const std::string& path);
    /// Opens the partial folder that another rank has created. Throws Error(io) if this host does not see it.
    static RunFolder join(const std::string& partial_path);
    /// saved_run_file() of a run into `path` that may have been interrupted. Throws Error(io) if that cannot be a path.
    static std::string saved_run_file(const std::string& path);

    RunFolder(RunFolder&& other) noexcept;
    RunFolder& operator=(RunFolder&&) = delete;
    /// Removes what was neither committed nor is to be kept.
    ~RunFolder();

    const std::string& partial_path() const { return partial_; }
    std::string part_file(int leaf) const;          ///< .../parts/part_0008.vtu
    std::string part_surface_file(int leaf) const;  ///< .../parts/part_0008.surface.vtu
    std::string part_stl_file(int leaf) const;      ///< .../parts/part_0008.stl
    std::string file(const std::string& name) const;

    std::string saved_run_file() const;        ///< the options, for who continues the run
    std::string job_file(int leaf) const;      ///< what a worker needs to know of a part
    std::string journal_file(int leaf) const;  ///< exists when the part is finished

    /// True for one caller only, among all ranks, in this run.
    bool take(int leaf) const;

    /// Number of journal entries.
    std::size_t finished_parts() const;

    /// Removes parts and journal entries of other leaves, and all surfaces, that an interrupted run has left. Only for
    /// the creator.
    void keep_only(const std::vector<int>& leaves) const;

    /// From now on the destructor leaves the folder for the next run.
    void keep() { keep_ = true; }

    /// Waits for the disk, renames the folder to its final name, and removes `work` and an older run there, as far as
    /// they can be removed. Only for the creator. Throws Error(io) if what lies under the final name is not a run.
    void commit();

 private:
    RunFolder(std::string final_path, std::string partial, bool owner);
    bool try_lock(const std::string& name, int& fd, int operation) const;
    void lock();
    void release_locks();
    void clear_all_but_parts() const;

    std::string final_, partial_;
    bool owner_ = false, keep_ = false;
    int lock_ = -1, ranks_lock_ = -1;  // open files
};

/// part_0008.vtu, part_0008.surface.vtu, part_0008.stl: names relative to the folder `parts`.
std::string part_file_name(int leaf);
std::string part_surface_file_name(int leaf);
std::string part_stl_file_name(int leaf);

}  // namespace kerf
