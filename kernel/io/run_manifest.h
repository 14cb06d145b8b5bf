// How a run folder is known as Kerf's own: the report lists every file with its hash, and carries a hash of itself.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/hash.h"

namespace kerf {

/// 32 hexadecimal digits.
std::string hash_text(const FileHash& hash);

/// A file of a run folder as it was when the run was finished.
struct RunFile {
    std::string path;  ///< relative to the folder
    std::int64_t bytes = 0;
    std::string hash;  ///< of its bytes, see hash_text()

    template <class Archive>
    void archive(Archive& a) {
        a(path, bytes, hash);
    }
};

/// Ascending by path, each path once.
void sort_files(std::vector<RunFile>& files);

/// Reads FOLDER/path as a whole, in pieces. Throws Error(io), also for what is no file.
RunFile describe_file(const std::string& folder, const std::string& path);

/// The text of a report, which is an object of JSON that ends with "\n}\n", with its own hash as its last member
/// "report_hash".
std::string sealed(const std::string& report);
/// Whether the text is as sealed() returned it.
bool is_sealed(const std::string& report);

/// Whether a path below a run folder is named like a file that Kerf writes there, finished or not:
/// "parts/part_0008.vtu", "parts/4000/part_4123.vtu", "export/su2/mesh.su2", "report.json", "work/journal/8"; folders,
/// which end with '/', too.
bool is_named_like_run_file(const std::string& path);

/// The file of a run of order 2 with the nodes that stored parts do not tell (part/curved_nodes_file.h).
inline constexpr const char* curved_nodes_name = "parts/curved_nodes.bin";

/// Whether it is named like parts/part_0008.part, in which a part waits for the writers of formats.
bool is_stored_part(const std::string& path);

/// What a folder holds that may be a run.
struct FolderContent {
    bool exists = false;    ///< as a folder
    bool is_run = false;    ///< a report that Kerf has sealed lies in it
    bool is_valid = false;  ///< that report says exit code 0
    /// The first file that is no part of a run of Kerf: of a run, not on its list of files; else any at all.
    std::string foreign;
};

/// Reads the report, and of a run what else lies in the folder. Throws Error(io) if it cannot be read.
FolderContent inspect_run_folder(const std::string& folder);

/// Removes the `unwanted` of the files below the folder that are named like a run's: whatever else lies there stays.
/// Throws Error(io), naming the file, if one cannot be removed.
void remove_run_files(const std::string& folder, const std::function<bool(const std::string& path)>& unwanted);

/// Removes all files that are named like a run's, and the folders that are empty then, as far as that can be done.
void remove_run_folder(const std::string& folder);

/// Removes what is empty of the folder `below` of a run, "parts" or "work/jobs", itself and folders named like a run's
/// in it, as far as that can be done. Of an empty name: all in the run's folder.
void remove_empty_run_folders(const std::string& folder, const std::string& below);

}  // namespace kerf
