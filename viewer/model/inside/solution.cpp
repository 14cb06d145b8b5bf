// The report of a solution tells its order, its cases and its modes. The values are arrays of its part files, found by
// name: "Displacement", "Stress", "VonMises" and "ErrorIndicator", followed by a space and the name of the case where
// there are several, and "Mode 1" and so on for displacements of modes. An array of cells has the values of the
// tetrahedra first and those of the facets behind them. Where the report does not tell how large a mode is, the files
// of all parts are read for it, once (measure_modes()).
#include "viewer/model/inside/solution.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/json.h"
#include "files/io/listed_files.h"
#include "files/io/path_text.h"
#include "files/io/run_folder.h"
#include "files/part/solution_parts.h"
#include "files/part/vtu_reader.h"
#include "viewer/model/inside/checked_files.h"

namespace kerf::view {

namespace {

using Json = nlohmann::json;

constexpr double share_of_body = 0.05;

}  // namespace

std::string Solution::Case::title() const { return is_mode() ? fmt::format("{}, {:.4g} Hz", name, frequency) : name; }

float PartSolution::value_at(ColorBy color, std::size_t vertex) const {
    if (color == ColorBy::displacement) return static_cast<float>(displacement[vertex].norm());
    if (stress.empty()) return std::nanf("");
    if (color == ColorBy::von_mises) return von_mises[vertex];
    return stress[vertex][static_cast<std::size_t>(color) - static_cast<std::size_t>(ColorBy::stress_xx)];
}

namespace {

// Arrays of points in the file of a part, by name.
class PointArrays {
 public:
    explicit PointArrays(const std::string& path) : path_(path), all_(read_values(path)) {}

    const PartValues& find(const std::string& name, int components) const {
        const auto found = std::find_if(all_.begin(), all_.end(), [&](const PartValues& values) {
            return values.name == name && values.of == PartValues::Of::points && values.components == components;
        });
        if (found == all_.end()) fail_damaged_vtu(path_, "it has no array " + name);
        return *found;
    }
    std::vector<Vec3> vectors(const std::string& name) const {
        const PartValues& values = find(name, 3);
        std::vector<Vec3> vectors;
        const std::size_t count = std::visit([](const auto& n) { return n.size(); }, values.numbers) / 3;
        for (std::size_t v = 0; v < count; ++v)
            vectors.emplace_back(values.number(3 * v), values.number(3 * v + 1), values.number(3 * v + 2));
        return vectors;
    }

 private:
    std::string path_;
    std::vector<PartValues> all_;
};

}  // namespace

PartSolution read_part_solution(const Solution& solution, std::size_t number, NodeId part) {
    const std::string path = checked_file(solution.folder, "parts/" + part_file_name(part));
    const Solution::Case& one = solution.cases[number];
    const PointArrays arrays(path);
    const PartCellCounts counts = read_cell_counts(path);
    PartSolution values;
    if (one.is_mode()) {
        values.displacement = arrays.vectors(one.name);
        values.error_of_tet.assign(counts.tets, std::nanf(""));
        values.error_at_facet.assign(counts.facets, std::nanf(""));
        return values;
    }
    const auto loads = std::count_if(solution.cases.begin(), solution.cases.end(),
                                     [](const Solution::Case& other) { return !other.is_mode(); });
    const std::string suffix = loads > 1 ? " " + one.name : "";
    values.displacement = arrays.vectors("Displacement" + suffix);
    const PartValues& stress = arrays.find("Stress" + suffix, 6);
    const PartValues& von_mises = arrays.find("VonMises" + suffix, 1);
    for (std::size_t v = 0; v < values.displacement.size(); ++v) {
        std::array<float, 6>& row = values.stress.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<float>(stress.number(6 * v + i));
        values.von_mises.push_back(static_cast<float>(von_mises.number(v)));
    }
    values.error_of_tet = read_cell_values(path, "ErrorIndicator" + suffix, 0, counts.tets);
    values.error_at_facet = read_cell_values(path, "ErrorIndicator" + suffix, counts.tets, counts.facets);
    return values;
}

namespace {

void add_modes(const Json& modes, Solution& solution) {
    for (const Json& of_mode : modes) {
        Solution::Case& mode = solution.cases.emplace_back();
        const Json largest = of_mode.value("max_displacement", Json::object());
        mode.name = fmt::format("Mode {}", 1 + &of_mode - &modes.front());
        mode.frequency = std::max(0.0, of_mode.at("frequency").get<double>());
        mode.largest_displacement = largest.value("value", -1.0);
    }
}

// Measures the modes of which the report does not say how large they are.
void measure_modes(Solution& solution) {
    std::vector<Solution::Case*> unknown;
    for (Solution::Case& one : solution.cases)
        if (one.is_mode() && one.largest_displacement < 0) unknown.push_back(&one);
    if (unknown.empty()) return;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(solution.folder + "/parts")) {
        if (entry.path().extension() != ".vtu") continue;
        const PointArrays arrays(
            checked_file(solution.folder, entry.path().lexically_relative(solution.folder).generic_string()));
        for (Solution::Case* mode : unknown)
            for (const Vec3& v : arrays.vectors(mode->name))
                mode->largest_displacement = std::max(mode->largest_displacement, v.norm());
    }
}

}  // namespace

std::optional<Solution> find_solution(const std::string& path) {
    const std::optional<std::string> folder = find_solution_folder(path);
    if (!folder) return std::nullopt;
    Solution solution;
    solution.folder = *folder;
    solution.mesh = mesh_of_solution(*folder);
    try {
        const Json report = parse_json(read_sealed_report(*folder));
        const Json& solve = report.at("solve");
        solution.order = solve.value("order", 1);
        for (const Json& of_case : solve.value("cases", Json::array()))
            solution.cases.push_back({path_of_text(of_case.at("name").get<std::string>()),
                                      of_case.at("max_displacement").at("value").get<double>()});
        add_modes(solve.value("modes", Json::array()), solution);
        if (solution.cases.empty()) throw Error(ErrorCode::io, *folder + "/report.json has neither cases nor modes.");
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::io, fmt::format("{}/report.json is damaged: {}. Solve again.", *folder, error.what()));
    }
    measure_modes(solution);
    return solution;
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
