#include "files/part/solution_parts.h"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/listed_files.h"
#include "files/io/path_text.h"
#include "files/io/run_folder.h"
#include "files/part/run_parts.h"

namespace kerf {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

// Returns the report, null if there is none. Throws Error(verification) for a report that is not as it was written.
Json report_of(const fs::path& folder) {
    std::error_code ignored;
    if (!fs::exists(folder / "report.json", ignored)) return nullptr;
    return read_report_json(folder.string());
}

std::string path_beside(const fs::path& folder, const Json& name) {
    return (folder / path_of_text(name.get<std::string>())).lexically_normal().string();
}

[[noreturn]] void fail_damaged(const std::string& folder, const char* what) {
    throw Error(ErrorCode::io, fmt::format("{}/report.json is damaged: {}. Solve again.", folder, what));
}

}  // namespace

std::optional<std::string> find_solution_folder(const std::string& path) {
    const fs::path folder(path);
    const Json report = report_of(folder);
    if (report.is_null()) {
        const Json beneath = report_of(folder / "solution");
        return beneath.is_object() && beneath.contains("solve") ? std::optional((folder / "solution").string())
                                                                : std::nullopt;
    }
    if (!is_of_solution(report)) return std::nullopt;
    if (report.contains("solve")) return path;
    try {
        const Json& steps = report.at("steps");
        return path_beside(folder, steps.at(steps.empty() ? 0 : steps.size() - 1).at("solution"));
    } catch (const Json::exception& error) {
        fail_damaged(path, error.what());
    }
}

std::string mesh_of_solution(const std::string& solution) {
    const Json report = report_of(solution);
    try {
        std::string folder = path_beside(solution, report.at("solve").at("mesh"));
        const Json mesh = report_of(folder);
        if (mesh.is_null())
            throw Error(ErrorCode::io,
                        fmt::format("{} is the solution on the mesh {}, which is not there. Put it back, "
                                    "or solve again.",
                                    solution, folder));
        for (const char* count : {"tets", "vertices"})
            if (mesh.at("totals").at(count) != report.at("totals").at(count))
                throw Error(ErrorCode::io, fmt::format("{} is the solution on another mesh than the one that is in {} "
                                                       "now. Solve again.",
                                                       solution, folder));
        return folder;
    } catch (const Json::exception& error) {
        fail_damaged(solution, error.what());
    }
}

std::string mesh_in(const std::string& folder) {
    const std::optional<std::string> solution = find_solution_folder(folder);
    return solution ? mesh_of_solution(*solution) : folder;
}

std::unique_ptr<PartSource> open_parts(const std::string& folder) {
    if (const std::optional<std::string> solution = find_solution_folder(folder))
        return std::make_unique<RunParts>(mesh_of_solution(*solution), *solution);
    return std::make_unique<RunParts>(folder);
}

}  // namespace kerf
