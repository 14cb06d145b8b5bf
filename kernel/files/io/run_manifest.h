// Knows a run folder as Kerf's own: the report lists every file with its hash, and carries a hash of itself.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/core/hash.h"

namespace kerf {

/// Returns a hash as 32 hexadecimal digits.
std::string hash_text(const FileHash& hash);

/// A file of a run folder as it was when the run was finished.
struct RunFile {
    std::string path;  ///< relative to the folder
    std::int64_t bytes = 0;
    std::string hash;  ///< hash of the bytes, as hash_text() writes it

    template <class Archive>
    void archive(Archive& a) {
        a(path, bytes, hash);
    }
};

/// Sorts files ascending by path and keeps the first of each path.
void sort_files(std::vector<RunFile>& files);

/// Reads FOLDER/path as a whole, in pieces, and describes it. Throws Error(io), also for a folder, device or pipe.
RunFile describe_file(const std::string& folder, const std::string& path);

/// Returns the text of a report, an object of JSON that ends with "\n}\n", with its own hash as its last member
/// "report_hash".
std::string sealed(const std::string& report);
/// Tells whether the text is as sealed() returned it.
bool is_sealed(const std::string& report);

/// Tells whether a path below a run folder is named like a file that Kerf writes there, finished or not:
/// "parts/part_0008.vtu", "parts/4000/part_4123.vtu", "export/su2/mesh.su2", "report.json", "work/journal/8"; or like
/// one of the folders, which end with '/'.
bool is_named_like_run_file(const std::string& path);

/// The name of the file of a run of order 2 with the nodes that stored parts do not tell
/// (files/part/curved_nodes_file.h).
inline constexpr const char* curved_nodes_name = "parts/curved_nodes.bin";

/// Tells whether a path is named like parts/part_0008.part, a part that waits for the writers of formats.
bool is_stored_part(const std::string& path);

/// The content of a folder that may be a run.
struct FolderContent {
    bool exists = false;    ///< there is such a folder
    bool is_run = false;    ///< a report that Kerf has sealed lies in it
    bool is_valid = false;  ///< the sealed report says exit code 0
    /// The first file that is no part of a run of Kerf: in a run a file that is not on its list, else any file at all.
    /// Empty if there is none.
    std::string foreign;
};

/// Reads the report and, if that is sealed, looks for files that are not on its list. Throws Error(io) if the folder
/// cannot be read.
FolderContent inspect_run_folder(const std::string& folder);

/// Removes those files below the folder that are named like a run's and `unwanted`; all others stay. Throws Error(io),
/// naming the file, if one cannot be removed.
void remove_run_files(const std::string& folder, const std::function<bool(const std::string& path)>& unwanted);

/// Removes all files that are named like a run's or are on the list of its sealed report, and the folders that are
/// empty then, as far as that can be done.
void remove_run_folder(const std::string& folder);

/// Removes the empty folders of a run below its folder `below`, "parts" or "work/jobs", and that itself if it is empty,
/// as far as that can be done. An empty name stands for the whole folder of the run, which stays itself.
void remove_empty_run_folders(const std::string& folder, const std::string& below);

}  // namespace kerf
