#include "viewer/model/solution.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/file_bytes.h"
#include "io/path_text.h"
#include "io/run_folder.h"
#include "part/solution_parts.h"
#include "part/vtu_reader.h"

namespace kerf::view {

namespace {

using Json = nlohmann::json;

constexpr double share_of_body = 0.05;

}  // namespace

std::optional<Solution> find_solution(const std::string& path) {
    const std::optional<std::string> folder = find_solution_folder(path);
    if (!folder) return std::nullopt;
    Solution solution;
    solution.folder = *folder;
    solution.mesh = mesh_of_solution(*folder);
    try {
        const Json report = Json::parse(read_file(*folder + "/report.json"));
        for (const Json& of_case : report.at("solve").at("cases"))
            solution.cases.push_back({path_of_text(of_case.at("name").get<std::string>()),
                                      of_case.at("max_displacement").at("value").get<double>()});
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::io, fmt::format("{}/report.json is damaged: {}. Solve again.", *folder, error.what()));
    }
    return solution;
}

float PartSolution::value_at(ColorBy color, std::size_t vertex) const {
    if (color == ColorBy::displacement) return static_cast<float>(displacement[vertex].norm());
    if (color == ColorBy::von_mises) return von_mises[vertex];
    return stress[vertex][static_cast<std::size_t>(color) - static_cast<std::size_t>(ColorBy::stress_xx)];
}

PartSolution read_part_solution(const Solution& solution, std::size_t number, NodeId part) {
    const std::string path = solution.folder + "/parts/" + part_file_name(part);
    const std::string suffix = solution.cases.size() > 1 ? " " + solution.cases[number].name : "";
    const std::vector<PartValues> all = read_values(path);
    const auto find = [&](const char* name, PartValues::Of of, int components) -> const PartValues& {
        const auto found = std::find_if(all.begin(), all.end(), [&](const PartValues& values) {
            return values.name == name + suffix && values.of == of && values.components == components;
        });
        if (found == all.end()) fail_damaged_vtu(path, fmt::format("it has no array {}{}", name, suffix));
        return *found;
    };
    PartSolution values;
    const PartValues& displacement = find("Displacement", PartValues::Of::points, 3);
    const PartValues& stress = find("Stress", PartValues::Of::points, 6);
    const PartValues& von_mises = find("VonMises", PartValues::Of::points, 1);
    const std::size_t vertices = std::visit([](const auto& n) { return n.size(); }, von_mises.numbers);
    for (std::size_t v = 0; v < vertices; ++v) {
        values.displacement.emplace_back(displacement.number(3 * v), displacement.number(3 * v + 1),
                                         displacement.number(3 * v + 2));
        std::array<float, 6>& row = values.stress.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<float>(stress.number(6 * v + i));
        values.von_mises.push_back(static_cast<float>(von_mises.number(v)));
    }
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
