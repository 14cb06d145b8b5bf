// A folder that appears under its name only when it is complete.
#pragma once

#include <string>

namespace kerf {

/// Builds a result under a temporary name beside the final one and renames it at the end.
///
/// An older run under the final name is replaced as a whole, never mixed. A folder that exists but holds no report.json
/// and is not empty is not a run of Kerf: it is refused, so that nobody's files are lost. The destructor removes what
/// was not committed. With several ranks the first creates and commits, the others open the same temporary folder.
class RunFolder {
 public:
    /// Checks `path` and creates its temporary sibling PATH.kerf-tmp-PID with the sub-folder `parts`, and the folders
    /// above where they are missing. Throws Error(io) if it cannot be written, naming the folder and the reason.
    static RunFolder create(const std::string& path);
    /// Opens the temporary folder that another rank has created. Throws Error(io) if this host does not see it.
    static RunFolder join(const std::string& temporary_path);

    RunFolder(RunFolder&& other) noexcept;
    RunFolder& operator=(RunFolder&&) = delete;
    ~RunFolder();

    const std::string& temporary_path() const { return temporary_; }
    std::string part_file(int leaf) const;          ///< .../parts/part_0008.vtu
    std::string part_surface_file(int leaf) const;  ///< .../parts/part_0008.surface.vtu
    std::string part_stl_file(int leaf) const;      ///< .../parts/part_0008.stl
    std::string file(const std::string& name) const;

    /// Renames the folder to its final name; an older run there is removed afterwards. Of several runs into one folder
    /// the last commit wins. Only for the creator. Throws Error(io) if what lies under the final name is not a run.
    void commit();

 private:
    RunFolder(std::string final_path, std::string temporary, bool owner);
    std::string final_, temporary_;
    bool owner_ = false;
};

/// part_0008.vtu, part_0008.surface.vtu, part_0008.stl: names relative to the folder `parts`.
std::string part_file_name(int leaf);
std::string part_surface_file_name(int leaf);
std::string part_stl_file_name(int leaf);

}  // namespace kerf
