// Two questions decide whether a folder may be replaced or removed, both without trust in its name. Is it a run? A
// report lies in it that is sealed: its last member is the hash of the text without that member, which is put back
// together and compared byte by byte. Is a file foreign? In a run a file is foreign unless the report lists it; only
// empty folders, and the files in `work` by which a failed run goes on, are known by their names, because no list has
// them. The names of a run are a grammar of fixed names, part_NUMBER with an ending, and folders 4000/ of large runs: a
// file that a run writes under a new name needs a line there. Removal goes file by file and follows no links; folders
// go only when they are empty.
#include "files/io/run_manifest.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/checked_file.h"
#include "files/io/file_bytes.h"
#include "files/io/folder_files.h"
#include "files/io/json.h"

namespace kerf {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view report_name = "report.json", end_of_report = "\n}\n";
constexpr std::string_view seal_begin = ",\n  \"report_hash\": \"", seal_end = "\"";

bool is_number(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

// Takes the prefix off the text and returns true if the text begins with it.
bool take_prefix(std::string_view& text, std::string_view prefix) {
    const bool is_there = text.starts_with(prefix);
    if (is_there) text.remove_prefix(prefix.size());
    return is_there;
}

// Returns the name without the folder that leaves of large runs have: "4000/".
std::string_view without_leaf_folder(std::string_view name) {
    const std::size_t slash = name.find('/');
    return slash != name.npos && is_number(name.substr(0, slash)) ? name.substr(slash + 1) : name;
}

// Tells whether the name is that of a part's file with one of these endings, or of a folder of a few hundred parts.
bool is_part_name(std::string_view name, std::initializer_list<std::string_view> endings) {
    name = without_leaf_folder(name);
    if (name.empty()) return true;
    return take_prefix(name, "part_") && std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) {
               return name.ends_with(ending) && is_number(name.substr(0, name.size() - ending.size()));
           });
}

bool is_work_name(std::string_view name) {
    for (const std::string_view file : {"lock", "ranks", "run.json", "run.json.new"})
        if (name == file) return true;
    if (take_prefix(name, "journal/")) {
        if (name.ends_with(".new")) name.remove_suffix(4);
    } else if (!take_prefix(name, "jobs/") && !take_prefix(name, "taken/")) {
        return false;
    }
    name = without_leaf_folder(name);
    return name.empty() || is_number(name);
}

// Returns the first name in the folder itself. Folders below are not looked into: this may be anybody's home.
std::string first_name_in(const std::string& folder) {
    std::string first;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (first.empty() || name < first) first = name;
    }
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
        throw Error(ErrorCode::io,
                    fmt::format("Cannot read the folder {}: {}. Check its permissions, or choose another "
                                "folder.",
                                folder, error.message()));
    return first;
}

// The list of files and the verdict of a run's report.
struct SealedReport {
    std::set<std::string> files;  // with the report itself
    bool is_valid = false;
};

// Returns nothing where there is no report that Kerf has sealed.
std::optional<SealedReport> read_report(const std::string& folder) {
    try {
        const std::string text = read_file((fs::path(folder) / report_name).string());
        if (!is_sealed(text)) return {};
        SealedReport report = {{std::string(report_name)}, false};
        const auto json = parse_json(text);
        for (const auto& file : json.at("files")) report.files.insert(file.at("path").get<std::string>());
        report.is_valid = json.at("exit_code") == 0;
        return report;
    } catch (const Error&) {  // no report that can be read
        return {};
    } catch (const nlohmann::json::exception&) {
        return {};
    }
}

}  // namespace

std::string hash_text(const FileHash& hash) { return fmt::format("{:016x}{:016x}", hash[0], hash[1]); }

void sort_files(std::vector<RunFile>& files) {
    std::stable_sort(files.begin(), files.end(), [](const RunFile& a, const RunFile& b) { return a.path < b.path; });
    const auto same = [](const RunFile& a, const RunFile& b) { return a.path == b.path; };
    files.erase(std::unique(files.begin(), files.end(), same), files.end());
}

RunFile describe_file(const std::string& folder, const std::string& path) {
    const std::string whole = (fs::path(folder) / path).string();
    std::error_code error;
    if (fs::exists(whole, error) && !fs::is_regular_file(whole, error))
        throw Error(ErrorCode::io, fmt::format("{} is no file. Move it away.", whole));
    CheckedFile file(whole, "rb");
    Hasher hasher;
    std::int64_t bytes = 0;
    std::string chunk(std::size_t{1} << 17, '\0');  // that the processor's own memory holds
    while (const std::size_t size = file.read_into(chunk.data(), chunk.size())) {
        hasher.add_bytes(chunk.data(), size);
        bytes += size;
    }
    return {path, bytes, hash_text(hasher.digest())};
}

std::string sealed(const std::string& report) {
    if (!report.ends_with(end_of_report)) throw Error(ErrorCode::internal, "A report does not end as JSON does.");
    return fmt::format("{}{}{}{}{}", report.substr(0, report.size() - end_of_report.size()), seal_begin,
                       hash_text(digest_of(report)), seal_end, end_of_report);
}

bool is_sealed(const std::string& report) {
    const std::size_t seal = report.rfind(seal_begin);
    return seal != report.npos && report == sealed(report.substr(0, seal) + std::string(end_of_report));
}

bool is_named_like_run_file(const std::string& path) {
    std::string_view name = path;
    for (const std::string_view whole :
         {"report.json", "mesh.pvtu", "surfaces.pvtu", "surfaces.vtu", "comparison.svg", "size_field.vtu",
          "results.csv", "reactions.csv", "modes.csv", "parts/", curved_nodes_name, "failed/", "work/", "work/journal/",
          "work/jobs/", "work/taken/"})
        if (name == whole) return true;
    if (take_prefix(name, "parts/")) return is_part_name(name, {".part", ".vtu", ".surface.vtu", ".stl"});
    if (take_prefix(name, "export/")) return true;
    if (take_prefix(name, "failed/")) return is_part_name(name, {".smesh", ".txt"});
    return take_prefix(name, "work/") && is_work_name(name);
}

bool is_stored_part(const std::string& path) {
    std::string_view name = path;
    return take_prefix(name, "parts/") && !name.ends_with('/') && is_part_name(name, {".part"});
}

FolderContent inspect_run_folder(const std::string& folder) {
    FolderContent content;
    std::error_code error;
    content.exists = fs::is_directory(folder, error);
    const std::optional<SealedReport> report = read_report(folder);
    content.is_run = report.has_value();
    content.is_valid = report && report->is_valid;
    if (!content.is_run) {
        content.foreign = first_name_in(folder);
        return content;
    }
    // An empty folder of a run's is not on the list, nor is what lets a failed run go on.
    const std::vector<std::string> files = list_files(folder);
    const auto foreign = std::find_if_not(files.begin(), files.end(), [&](const std::string& file) {
        return report->files.contains(file) ||
               ((file.ends_with('/') || file.starts_with("work/")) && is_named_like_run_file(file));
    });
    if (foreign != files.end()) content.foreign = *foreign;
    return content;
}

void remove_run_files(const std::string& folder, const std::function<bool(const std::string&)>& unwanted) {
    for (const std::string& file : list_files(folder)) {
        if (file.ends_with('/') || !is_named_like_run_file(file) || !unwanted(file)) continue;
        std::error_code error;
        fs::remove(fs::path(folder) / file, error);
        if (error)
            throw Error(ErrorCode::io, fmt::format("Cannot remove {}/{}, which an older run has left: {}. Check the "
                                                   "permissions there.",
                                                   folder, file, error.message()));
    }
}

void remove_run_folder(const std::string& folder) {
    std::error_code ignored;
    try {
        const std::optional<SealedReport> report = read_report(folder);  // another version may have other names
        for (const std::string& file : list_files(folder))
            if (is_named_like_run_file(file) || (report && report->files.contains(file)))
                fs::remove(fs::path(folder) / file, ignored);
    } catch (const Error&) {  // it cannot be read, so it stays
    }
    remove_empty_run_folders(folder, "");
    fs::remove(folder, ignored);  // only if it is empty
}

void remove_empty_run_folders(const std::string& folder, const std::string& below) {
    std::error_code ignored;
    const fs::path top = below.empty() ? fs::path(folder) : fs::path(folder) / below;
    const std::string prefix = below.empty() ? "" : below + "/";
    try {
        // Those that are empty now are listed, and those above them next time.
        for (bool any = true; any;) {
            any = false;
            for (const std::string& file : list_files(top.string()))
                any |= file.ends_with('/') && is_named_like_run_file(prefix + file) && fs::remove(top / file, ignored);
        }
    } catch (const Error&) {  // it cannot be read, so it stays
    }
    if (!below.empty()) fs::remove(top, ignored);  // only if it is empty
}

}  // namespace kerf
