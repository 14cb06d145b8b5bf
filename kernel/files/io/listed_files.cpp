#include "files/io/listed_files.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/file_bytes.h"
#include "files/io/json.h"

namespace kerf {

namespace {

std::vector<RunFile> files_or_fail(const std::string& folder, const nlohmann::json& report) {
    try {
        return files_of_report(report);
    } catch (const nlohmann::json::exception& error) {
        fail_damaged_report(folder, error.what());
    }
}

}  // namespace

std::string read_sealed_report(const std::string& folder) {
    const std::string path = folder + "/report.json";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw Error(ErrorCode::io,
                    fmt::format("{} is not a finished run: it holds no report.json. Name the folder that kerf mesh -o "
                                "was given; a run that has not ended goes on by kerf mesh --resume {}.",
                                folder, folder));
    std::string text = read_file(path);
    if (!is_sealed(text))
        throw Error(ErrorCode::verification,
                    fmt::format("{} is not as Kerf has written it, so that nobody knows what of it is true. Copy the "
                                "run again, or run kerf mesh again.",
                                path));
    return text;
}

nlohmann::json read_report_json(const std::string& folder) {
    try {
        return parse_json(read_sealed_report(folder));
    } catch (const nlohmann::json::exception& error) {
        fail_damaged_report(folder, error.what());
    }
}

void fail_damaged_report(const std::string& folder, const std::string& what) {
    throw Error(ErrorCode::verification,
                fmt::format("{}/report.json is damaged: {}. Copy the folder again, or make it again by kerf mesh or "
                            "kerf solve.",
                            folder, what));
}

ListedFiles::ListedFiles(std::string folder, const nlohmann::json& report)
    : ListedFiles(folder, files_or_fail(folder, report)) {}

ListedFiles::ListedFiles(std::string folder, const std::vector<RunFile>& files) : folder_(std::move(folder)) {
    for (const RunFile& file : files) listed_[file.path] = file;
}

ListedFiles::ListedFiles(ListedFiles&& other) noexcept
    : folder_(std::move(other.folder_)), listed_(std::move(other.listed_)), verified_(std::move(other.verified_)) {}

std::string ListedFiles::verified(const std::string& path) const {
    {
        const std::lock_guard lock(mutex_);
        if (verified_.contains(path)) return folder_ + "/" + path;
    }
    const auto fail = [&](const char* what) {
        throw Error(ErrorCode::verification,
                    fmt::format("{}/{} {}. Copy the run again, or run kerf mesh again; kerf verify {} tells all that "
                                "differs.",
                                folder_, path, what, folder_));
    };
    const RunFile found = describe_file(folder_, path);
    const auto listed = listed_.find(path);
    if (listed == listed_.end()) fail("is no file of the run");
    if (found.bytes != listed->second.bytes || found.hash != listed->second.hash)
        fail("is not as the run has written it");
    const std::lock_guard lock(mutex_);
    verified_.insert(path);
    return folder_ + "/" + path;
}

}  // namespace kerf
