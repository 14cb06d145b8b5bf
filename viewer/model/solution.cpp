#include "viewer/model/solution.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/file_bytes.h"
#include "io/run_folder.h"
#include "part/vtu_reader.h"
#include "run/path_text.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

constexpr double share_of_body = 0.05;

// What the report of a folder says; null if there is none.
Json report_of(const fs::path& folder) {
    std::error_code ignored;
    const fs::path path = folder / "report.json";
    if (!fs::exists(path, ignored)) return nullptr;
    return Json::parse(read_file(path.string()), nullptr, false);
}

std::string path_beside(const fs::path& folder, const Json& name) {
    return (folder / path_of_text(name.get<std::string>())).lexically_normal().string();
}

Solution read_solution(const fs::path& folder, const Json& report) {
    Solution solution;
    const Json& solve = report.at("solve");
    solution.folder = folder.string();
    solution.mesh = path_beside(folder, solve.at("mesh"));
    for (const Json& of_case : solve.at("cases"))
        solution.cases.push_back({path_of_text(of_case.at("name").get<std::string>()),
                                  of_case.at("max_displacement").at("value").get<double>()});
    const Json mesh = report_of(solution.mesh);
    if (mesh.is_null())
        throw Error(ErrorCode::io, fmt::format("{} is the solution on the mesh {}, which is not there. Put it back, or "
                                               "solve again.",
                                               solution.folder, solution.mesh));
    for (const char* count : {"tets", "vertices"})
        if (mesh.at("totals").at(count) != report.at("totals").at(count))
            throw Error(ErrorCode::io, fmt::format("{} is the solution on another mesh than the one that is in {} now. "
                                                   "Solve again.",
                                                   solution.folder, solution.mesh));
    return solution;
}

}  // namespace

std::optional<Solution> find_solution(const std::string& path) {
    const fs::path folder(path);
    const Json report = report_of(folder);
    try {
        if (report.is_null()) {
            const Json beneath = report_of(folder / "solution");
            return beneath.is_object() && beneath.contains("solve")
                       ? std::optional(read_solution(folder / "solution", beneath))
                       : std::nullopt;
        }
        if (!report.is_object()) return std::nullopt;
        if (report.contains("solve")) return read_solution(folder, report);
        if (!report.contains("steps")) return std::nullopt;
        const fs::path last = path_beside(folder, report.at("steps").back().at("solution"));
        return read_solution(last, report_of(last));
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::io, fmt::format("{}/report.json is damaged: {}. Solve again.", path, error.what()));
    }
}

float PartSolution::value_at(ColorBy color, std::size_t vertex) const {
    if (color == ColorBy::displacement) return static_cast<float>(displacement[vertex].norm());
    if (color == ColorBy::von_mises) return von_mises[vertex];
    return stress[vertex][static_cast<std::size_t>(color) - static_cast<std::size_t>(ColorBy::stress_xx)];
}

PartSolution read_part_solution(const Solution& solution, std::size_t number, NodeId part) {
    const std::string path = solution.folder + "/parts/" + part_file_name(part);
    const std::string& name = solution.cases[number].name;
    const std::string suffix = solution.cases.size() > 1 ? " " + name : "";
    PartSolution values;
    const std::vector<double> displacement = read_point_values(path, "Displacement" + suffix, 3);
    for (std::size_t i = 0; i + 2 < displacement.size(); i += 3)
        values.displacement.emplace_back(displacement[i], displacement[i + 1], displacement[i + 2]);
    const std::vector<double> stress = read_point_values(path, "Stress" + suffix, 6);
    values.stress.resize(stress.size() / 6);
    for (std::size_t i = 0; i < stress.size(); ++i) values.stress[i / 6][i % 6] = static_cast<float>(stress[i]);
    const std::vector<double> von_mises = read_point_values(path, "VonMises" + suffix, 1);
    values.von_mises.assign(von_mises.begin(), von_mises.end());
    const PartCellCounts counts = read_cell_counts(path);
    values.error_of_tet = read_cell_values(path, "ErrorIndicator" + suffix, 0, counts.tets);
    values.error_at_facet = read_cell_values(path, "ErrorIndicator" + suffix, counts.tets, counts.facets);
    return values;
}

double good_deformation(double largest_displacement, double diagonal) {
    if (!(largest_displacement > 0) || !(diagonal > 0)) return 0;
    const double factor = share_of_body * diagonal / largest_displacement;
    const double power = std::pow(10, std::floor(std::log10(factor)));
    for (const double step : {5.0, 2.0})
        if (factor >= step * power) return step * power;
    return power;
}

}  // namespace kerf::view
