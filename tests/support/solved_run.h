// A solution as kerf solve leaves it, with values that are known, made without a solver.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "files/io/json.h"
#include "files/io/run_folder.h"
#include "files/io/text_file.h"
#include "files/part/run_parts.h"
#include "files/part/vtu_writer.h"
#include "support/sealed_run.h"

namespace kerf::test {

/// Displacement (x, 0, 0) times `factor` of the case, von Mises stress x, stress XX to XZ x times 1 to 6, and an error
/// of 1 in all cells. Mode i is (0, x i, 0). `mesh`: as the report names it; `frequencies`: of the modes.
inline void write_solution(const std::string& run, const std::string& folder, const std::string& mesh,
                           const std::vector<std::string>& cases, const std::vector<double>& frequencies = {}) {
    std::filesystem::create_directories(folder + "/parts");
    const RunParts parts(run);
    double largest = 0;
    for (std::size_t p = 0; p < parts.outline().parts.size(); ++p) {
        const Part part = parts.load(PartIndex(p));
        std::vector<PartValues> values;
        for (std::size_t c = 0; c < cases.size(); ++c) {
            const std::string suffix = cases.size() > 1 ? " " + cases[c] : "";
            std::vector<double> displacement;
            std::vector<float> stress, von_mises;
            for (const Vec3& v : part.mesh.vertices) {
                const auto x = static_cast<float>(v.x());
                displacement.insert(displacement.end(), {v.x() * static_cast<double>(c + 1), 0, 0});
                for (int i = 1; i <= 6; ++i) stress.push_back(x * static_cast<float>(i));
                von_mises.push_back(x);
                largest = std::max(largest, v.x());
            }
            values.push_back({"Displacement" + suffix, PartValues::Of::points, 3, displacement});
            values.push_back({"Stress" + suffix, PartValues::Of::points, 6, stress});
            values.push_back({"VonMises" + suffix, PartValues::Of::points, 1, von_mises});
            values.push_back(
                {"ErrorIndicator" + suffix, PartValues::Of::tets, 1, std::vector<float>(part.mesh.tets.size(), 1)});
        }
        for (std::size_t i = 1; i <= frequencies.size(); ++i) {
            std::vector<double> mode;
            for (const Vec3& v : part.mesh.vertices) mode.insert(mode.end(), {0, v.x() * static_cast<double>(i), 0});
            values.push_back({"Mode " + std::to_string(i), PartValues::Of::points, 3, mode});
        }
        write_part(folder + "/parts/" + part_file_name(part.id), part, {}, values);
    }
    nlohmann::json of_cases = nlohmann::json::array();
    for (std::size_t c = 0; c < cases.size(); ++c)
        of_cases.push_back(
            {{"name", cases[c]}, {"max_displacement", {{"value", largest * static_cast<double>(c + 1)}}}});
    nlohmann::json solve = {{"mesh", mesh}, {"cases", of_cases}};
    for (const double frequency : frequencies) solve["modes"].push_back({{"frequency", frequency}});
    const nlohmann::json report = {
        {"solve", solve},
        {"exit_code", 0},
        {"totals", {{"tets", parts.outline().tets()}, {"vertices", parts.outline().vertices}}}};
    write_text_file(folder + "/report.json", json_text(report));
    seal_run(folder);
}

}  // namespace kerf::test
