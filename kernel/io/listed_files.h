// The files of a finished run as its report lists them: whoever reads one knows first that it is what the run has left.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "io/run_manifest.h"

namespace kerf {

/// The text of FOLDER/report.json. Throws Error(io) where there is none, and Error(verification) where it is not as
/// sealed() has returned it; both say the way out.
std::string read_sealed_report(const std::string& folder);

/// The same as JSON. Throws Error(verification) for what is none, too: somebody may have computed the hash again.
nlohmann::json read_report_json(const std::string& folder);

/// Throws Error(verification): the folder's report is none that a run has left, for `what`; with the way out.
[[noreturn]] void fail_damaged_report(const std::string& folder, const std::string& what);

/// The files that a report names. Throws nlohmann::json::exception if it has no such list.
template <class Json>
std::vector<RunFile> files_of_report(const Json& report) {
    std::vector<RunFile> files;
    for (const auto& file : report.at("files"))
        files.push_back({file.at("path").template get<std::string>(), file.at("bytes").template get<std::int64_t>(),
                         file.at("hash").template get<std::string>()});
    return files;
}

/// Compares files with the hashes of the report, each once, when it is first asked for: reads it as a whole. From any
/// thread.
class ListedFiles {
 public:
    /// `files`: those of the run in the folder.
    ListedFiles(std::string folder, const std::vector<RunFile>& files);
    /// Those of its report. Throws Error(verification) if that has no such list.
    ListedFiles(std::string folder, const nlohmann::json& report);
    ListedFiles(ListedFiles&& other) noexcept;

    const std::string& folder() const { return folder_; }
    /// FOLDER/path, of the file that the run has written. Throws Error(io) if it is not there, and
    /// Error(verification), naming it, if it is another or was none of the run's. Cost: the file is read once.
    std::string verified(const std::string& path) const;

 private:
    std::string folder_;
    std::map<std::string, RunFile> listed_;  // by path
    mutable std::mutex mutex_;
    mutable std::set<std::string> verified_;
};

}  // namespace kerf
