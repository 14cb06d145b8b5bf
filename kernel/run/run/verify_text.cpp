// The findings of kerf verify as text, for people and for programs.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/json.h"
#include "files/io/path_text.h"
#include "run/run/verify_folder.h"

namespace kerf {

int FolderVerification::exit_code() const {
    if (!laws.passed || !solution_differences.empty()) return static_cast<int>(ErrorCode::verification);
    return not_compared.empty() ? 0 : static_cast<int>(ErrorCode::io);
}

std::string to_text(const FolderVerification& found, const std::string& folder, const VerifyOptions& options) {
    const RunVerification& laws = found.laws;
    const std::string nodes = found.nodes > found.vertices ? fmt::format("{} nodes of order 2, {} of them curved, ",
                                                                         found.nodes, found.curved_nodes)
                                                           : std::string();
    std::string text = fmt::format("{}: {}{} parts, {} tetrahedra, {} vertices, {}volume error {:.1e}\n", folder,
                                   found.mesh.empty() ? "" : "a solution on " + found.mesh + ", ", found.parts,
                                   found.tets, found.vertices, nodes, laws.volume_rel_error);
    if (!(laws.volume_rel_error <= laws.volume_rel_bound))
        text += fmt::format("  volume error above {:.1e}, which rounding explains\n", laws.volume_rel_bound);
    for (const RunLaw& law : run_laws)
        if (const std::int64_t count = laws.*law.count) text += fmt::format("  {} {}\n", count, law.broken);
    for (const std::string& difference : found.differences) text += fmt::format("  {}\n", difference);
    for (const std::string& difference : found.solution_differences)
        text += fmt::format("  {}: {}\n", folder, difference);
    if (!found.solution_differences.empty()) text += "The solution is NOT valid. Run kerf solve again.\n";
    if (!laws.passed)
        text += "The mesh is NOT valid. Run kerf mesh again.\n";
    else if (options.without_input)
        text += "The laws of the mesh hold. It was not compared with the input.\n";
    else if (found.not_compared.empty())
        text += "Every law holds.\n";
    else
        text += fmt::format(
            "The laws of the mesh hold, but it was not compared with the input: {}\n"
            "If it lies elsewhere now, name it: --input FILE. --without-input does without.\n",
            found.not_compared);
    return text;
}

std::string to_json(const FolderVerification& found, const std::string& folder, const VerifyOptions& options) {
    const RunVerification& laws = found.laws;
    nlohmann::ordered_json json = {{"path", path_text(folder)},
                                   {"passed", laws.passed && found.solution_differences.empty()},
                                   {"compared_with_input", !options.without_input && found.not_compared.empty()},
                                   {"parts", found.parts},
                                   {"tets", found.tets},
                                   {"vertices", found.vertices},
                                   {"nodes", found.nodes},
                                   {"curved_nodes", found.curved_nodes},
                                   {"volume_rel_error", laws.volume_rel_error},
                                   {"volume_rel_bound", laws.volume_rel_bound}};
    for (const RunLaw& law : run_laws) json[law.name] = laws.*law.count;
    json["differences"] = found.differences;
    if (!found.mesh.empty()) {
        json["mesh"] = path_text(found.mesh);
        json["solution_differences"] = found.solution_differences;
    }
    json["not_compared"] = found.not_compared;
    return json_text(json, 2) + "\n";
}

}  // namespace kerf
