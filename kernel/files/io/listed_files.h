// The files of a finished run as its report lists them: a file that is compared with the list is known to be as the run
// has left it.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "files/io/run_manifest.h"

namespace kerf {

/// Returns the text of FOLDER/report.json. Throws Error(io) where there is none, and Error(verification) where it is
/// not as sealed() has returned it; both say the way out.
std::string read_sealed_report(const std::string& folder);

/// Returns FOLDER/report.json as JSON. Throws as read_sealed_report(), and Error(verification) for a text that is no
/// JSON, too: somebody may have computed its hash again.
nlohmann::json read_report_json(const std::string& folder);

/// Throws Error(verification) with the way out: the folder's report is none that a run has left, for the reason `what`.
[[noreturn]] void fail_damaged_report(const std::string& folder, const std::string& what);

/// Returns the files that a report names. Throws nlohmann::json::exception if it has no list of files.
template <class Json>
std::vector<RunFile> files_of_report(const Json& report) {
    std::vector<RunFile> files;
    for (const auto& file : report.at("files"))
        files.push_back({file.at("path").template get<std::string>(), file.at("bytes").template get<std::int64_t>(),
                         file.at("hash").template get<std::string>()});
    return files;
}

/// Compares files with the hashes of a report. Each file is read as a whole when it is asked for first, and then never
/// again. May be called from any thread.
class ListedFiles {
 public:
    /// Takes the folder of a run and the list of its files.
    ListedFiles(std::string folder, const std::vector<RunFile>& files);
    /// Takes the folder of a run and its report. Throws Error(verification) if the report has no list of files.
    ListedFiles(std::string folder, const nlohmann::json& report);
    ListedFiles(ListedFiles&& other) noexcept;

    const std::string& folder() const { return folder_; }
    /// Returns FOLDER/path for a file that the run has written. Throws Error(io) if the file is not there, and
    /// Error(verification), naming it, if its content differs or the run has not listed it. Cost: the file is read
    /// once.
    std::string verified(const std::string& path) const;

 private:
    std::string folder_;
    std::map<std::string, RunFile> listed_;  // by path
    mutable std::mutex mutex_;
    mutable std::set<std::string> verified_;
};

}  // namespace kerf
