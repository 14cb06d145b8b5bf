// A loop over run() and solve_run(): the second and further meshes have the sizes that the estimated errors of the last
// solution ask for, read as a file of --size-field. The folder is checked and the case is read before the first mesh,
// which takes longer than both. A number of cells that was asked for holds for the first mesh alone; the size that
// followed from it stays as the largest one. The output folder must hold nothing but results of this kind; those of an
// earlier run go at the end, when all steps are done, so that a run that fails takes nothing away.
#include "solve/run/mesh_and_solve.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/core/version.h"
#include "files/io/file_bytes.h"
#include "files/io/json.h"
#include "files/io/output_file.h"
#include "files/io/path_text.h"
#include "files/io/run_manifest.h"
#include "files/io/text_file.h"
#include "run/run/pipeline.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;

class StepFolders {
 public:
    explicit StepFolders(const MeshAndSolveRequest& request)
        : output_(request.solve.output), is_adaptive_(request.steps > 0) {}

    std::string mesh(std::int32_t step) const { return base(step) + "/mesh"; }
    std::string solution(std::int32_t step) const { return base(step) + "/solution"; }
    std::string report() const { return output_ + "/report.json"; }

    /// Throws Error(io) if there is anything that no run of this kind makes, Error(usage) for the name of a file.
    void check() const {
        refuse_file_name("--output", output_);
        std::error_code ignored;
        for (const fs::directory_entry& entry : fs::directory_iterator(output_, ignored)) {
            if (entry.path().filename().string().rfind("step_", 0) == 0) {
                for (const fs::directory_entry& of_step : fs::directory_iterator(entry.path(), ignored))
                    require_own(of_step.path());
            } else if (!is_report(entry.path())) {
                require_own(entry.path());
            }
        }
    }
    /// Removes the results of an earlier run into the folder that this one, with so many steps, has not replaced. Files
    /// of anybody else among them stay.
    void remove_others(std::int32_t steps) const {
        std::error_code ignored;
        if (is_adaptive_)
            remove_runs(output_);
        else
            fs::remove(report(), ignored);
        for (std::int32_t step = is_adaptive_ ? steps : 0; fs::exists(step_folder(step), ignored); ++step) {
            remove_runs(step_folder(step));
            fs::remove(step_folder(step), ignored);  // only if it is empty
        }
    }

 private:
    std::string step_folder(std::int32_t step) const { return fmt::format("{}/step_{}", output_, step + 1); }
    std::string base(std::int32_t step) const { return is_adaptive_ ? step_folder(step) : output_; }
    static void require_own(const fs::path& path) {
        const std::string stem = path.filename().stem().string(), ending = path.extension().string();
        std::error_code ignored;
        const bool is_own = (stem == "mesh" || stem == "solution") && fs::is_directory(path, ignored) &&
                            (ending.empty() || ending == ".failed" || ending == ".kerf-partial");
        if (!is_own)
            throw Error(ErrorCode::io, fmt::format("{} is in the way of a mesh and its solution. Move it away, or "
                                                   "choose another --output.",
                                                   path.string()));
    }
    static void remove_runs(const std::string& folder) {
        for (const char* name : {"/mesh", "/solution"})
            for (const char* ending : {"", ".failed", ".kerf-partial"}) remove_run_folder(folder + name + ending);
    }
    static bool is_report(const fs::path& path) {
        if (path.filename() != "report.json") return false;
        const std::string text = read_file(path.string());
        return is_sealed(text) && parse_json(text).contains("steps");
    }

    std::string output_;
    bool is_adaptive_;
};

std::string to_json(const MeshAndSolveRequest& request, const MeshAndSolveReport& report) {
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (const MeshAndSolveStep& step : report.steps)
        steps.push_back({{"mesh", path_text(path_from(request.solve.output, step.mesh))},
                         {"solution", path_text(path_from(request.solve.output, step.solution))},
                         {"tets", step.tets},
                         {"nodes", step.nodes},
                         {"relative_error", step.relative_error},
                         {"max_von_mises", step.von_mises},
                         {"mesh_seconds", step.mesh_seconds},
                         {"solve_seconds", step.solve_seconds}});
    const nlohmann::ordered_json json = {{"kerf", version},
                                         {"schema", 1},
                                         {"target_error", request.solve.target_error.value_or(0)},
                                         {"reached", report.reached},
                                         {"steps", steps}};
    return sealed(json_text(json, 2) + "\n");
}

MeshAndSolveStep summary_of(const RunReport& mesh, const SolveReport& solution) {
    MeshAndSolveStep step;
    step.mesh = solution.request.folder;
    step.solution = solution.request.output;
    step.tets = solution.tets;
    step.nodes = solution.nodes;
    step.relative_error = solution.relative_error();
    for (const CaseReport& of_case : solution.cases) step.von_mises = std::max(step.von_mises, of_case.von_mises.value);
    step.mesh_seconds = mesh.seconds.wall;
    step.solve_seconds = solution.seconds.wall;
    return step;
}

}  // namespace

MeshAndSolveReport mesh_and_solve(const MeshAndSolveRequest& request, int cores_of_rank, MpiRanks& ranks,
                                  SolveListener* listener, const StepDone& step_done) {
    const StepFolders folders(request);
    const int order_of_case = in_agreement(ranks, [&] {
        folders.check();
        const ElasticCase wanted = read_case(request.solve.case_file);  // before the mesh, which takes longer
        if (request.solve.modes == 0) require_effect(wanted, request.solve.case_file);
        return wanted.solver.order;
    });
    MeshAndSolveReport report;
    RunRequest options = request.mesh;
    if (!request.solve.order && order_of_case > 0) options.order = order_of_case;
    options.least_parts = ranks.size();
    for (std::int32_t step = 0; step <= request.steps; ++step) {
        options.output = folders.mesh(step);
        report.mesh = run(options, cores_of_rank, ranks, listener);
        report.solution.reset();
        report.exit_code = report.mesh.exit_code;
        if (report.exit_code != 0) return report;
        SolveRequest solve = request.solve;
        solve.folder = options.output;
        solve.output = folders.solution(step);
        if (request.steps > 0 && !solve.target_error) solve.target_error = 0;
        report.solution = solve_run(solve, ranks, listener);
        report.steps.push_back(summary_of(report.mesh, *report.solution));
        if (step_done) step_done(report.steps.size(), report.steps.back());
        report.reached = solve.target_error && report.solution->relative_error() <= *solve.target_error;
        in_agreement(ranks, [&] {
            if (request.steps > 0 && ranks.rank() == 0) write_text_file(folders.report(), to_json(request, report));
        });
        if (report.reached) break;
        if (options.sizes.cells > 0) {  // holds for the first mesh: others are finer where the error asks for it
            options.sizes.cells = 0;
            options.sizes.size = report.mesh.request.sizes.size;
        }
        options.sizes.field_file = folders.solution(step) + "/" + size_field_file;
    }
    in_agreement(ranks, [&] {
        if (ranks.rank() == 0) folders.remove_others(count_of(report.steps));
    });
    return report;
}

std::string to_text(std::size_t number, const MeshAndSolveStep& step) {
    std::string text;
    if (number == 1)
        text = fmt::format("{:>4} {:>12} {:>11} {:>8} {:>13} {:>8} {:>8}  {}\n", "step", "tetrahedra", "nodes",
                           "error %", "max von Mises", "mesh s", "solve s", "solution");
    return text + fmt::format("{:>4} {:>12} {:>11} {:>8.2f} {:>13.6g} {:>8.2f} {:>8.2f}  {}\n", number,
                              grouped(step.tets), grouped(step.nodes), 100 * step.relative_error, step.von_mises,
                              step.mesh_seconds, step.solve_seconds, step.solution);
}

}  // namespace kerf
