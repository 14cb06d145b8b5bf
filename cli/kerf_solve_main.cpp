// kerf-solve: linear elasticity on a surface, which is meshed first, or on the parts of a run. It is a program of its
// own, because only it links PETSc, and `kerf solve` starts it, also under mpirun. Alone it starts as many ranks of
// itself as are of use (run_as_ranks()) and only hands their exit code on. An input that is a folder is a run, all else
// a surface; options that shape a mesh are refused for a run. Errors are of two kinds: an Error meets all ranks alike
// and each ends by itself with its code; any other, and a failure of PETSc, may meet one rank in the middle of a
// collective operation, which then ends all of them, as the others would wait for ever.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "base/core/out_of_memory.h"
#include "base/core/version.h"
#include "base/parallel/processors.h"
#include "cli/answer.h"
#include "cli/failed_parts.h"
#include "cli/option_flags.h"
#include "cli/other_programs.h"
#include "cli/own_ranks.h"
#include "cli/progress.h"
#include "cli/ranks.h"
#include "files/io/output_file.h"
#include "files/io/standard_streams.h"
#include "help/number_option.h"
#include "help/program_help.h"
#include "solve/run/mesh_and_solve.h"
#include "solve/run/useful_ranks.h"

namespace kerf {

namespace {

struct SolveLine {
    std::string input;  // a run's folder or a surface file
    bool meshes = false;
    MeshAndSolveRequest request;
    bool list_patches = false, quiet = false;
    int ranks = 0;  // number of processes; 0: as many as are of use
};

// Checks the options of the mesh against the input. With --adapt a surface is remeshed unless --surface is given,
// because facets that stay keep the cells beside them coarse.
void check_mesh_options(const CLI::App& solve, SolveLine& line) {
    RunRequest& mesh = line.request.mesh;
    if (solve.get_option("--order")->count() > 0) line.request.solve.order = mesh.order;
    if (line.meshes) {
        if (line.list_patches)
            throw CLI::ValidationError(
                fmt::format("--list-patches is for the folder of a finished run. kerf check "
                            "--list-patches {} lists those of a surface.",
                            line.input));
        for (const NamedPath& output : mesh.outputs.files())
            refuse_to_overwrite(line.request.solve.case_file, output.option, output.path);
        if (line.request.steps > 0 && solve.get_option("--surface")->count() == 0) mesh.remeshing = Remeshing::always;
        return;
    }
    std::vector<std::string> names = {"adapt"};
    for (const OptionField& field : option_fields(mesh))
        if (field.name != std::string_view("order") && field.name != std::string_view("workers") &&
            field.name != std::string_view("events"))
            names.push_back(field.name);
    for (const std::string& name : names)
        if (solve.get_option("--" + name)->count() > 0)
            throw CLI::ValidationError(
                fmt::format("--{} is for meshing, but {} is the folder of a finished run. Give "
                            "the surface instead.",
                            name, line.input));
}

void add_options(CLI::App& command, SolveLine& line) {
    SolveRequest& request = line.request.solve;
    command.option_defaults()->group("Solution");
    command
        .add_option("input", line.input, "Folder of a finished run, or a surface or CAD file, which is meshed first.")
        ->required()
        ->type_name("DIR|INPUT");
    CLI::Option* case_file =
        command.add_option("--case", request.case_file, "Materials, supports and loads, as TOML.")->type_name("FILE");
    CLI::Option* output = command
                              .add_option("-o,--output", request.output,
                                          "Folder for the solution. Of a surface, for its mesh, too: OUT/mesh, "
                                          "OUT/solution.")
                              ->type_name("OUT");
    add_number(command, "--adapt", line.request.steps, {"a whole number of steps, 0 to 50", 0, 50},
               "Mesh and solve again, finer where the estimated error is large, up to N times: OUT/step_1, ...")
        ->type_name("N");
    add_number(command, "--target-error", request.target_error, {"a share from 1e-6 to 1, such as 0.05", 1e-6, 1},
               "Estimated error in the energy norm beside that of the solution, as 0.05, that is good enough. Above it "
               "the solution has size_field.vtu for the next mesh.")
        ->type_name("E");
    add_number(command, "--modes", request.modes, {"a whole number of modes, 1 to 200", 1, 200},
               "Natural frequencies and modes, the lowest N, in place of what the loads of the case do.")
        ->type_name("N");
    command
        .add_flag("--list-patches", line.list_patches, "Print name, area, centroid and normal of each patch, and end.")
        ->excludes(case_file)
        ->excludes(output);
    add_number(
        command, "--ranks", line.ranks, {"a whole number, 1 to 4096", 1, 4096},
        "Processes that solve, each on parts of its own, where mpirun has started none. Default: as many as "
        "--workers, or as there are processors, as far as parts and cells are enough for them; 1: this one alone.")
        ->type_name("P");
    command.add_flag("-q,--quiet", line.quiet, "Print errors alone.");
    add_run_options(command, line.request.mesh);
    put_help_last(command, option_group::running,
                  {"case", "output", "order", "adapt", "target-error", "modes", "list-patches", "ranks", "parts",
                   "size", "surface", "feature-angle", "workers", "quiet"});
}

// Fills the line, or returns an answer that takes the place of a run.
std::optional<Answer> parse_solve_line(int argc, const char* const* argv, SolveLine& line) {
    CLI::App app(
        "Kerf: linear elasticity on a surface or on the parts of a finished run.\n"
        "mpirun -n P kerf solve ... shares the parts out among P ranks.",
        "kerf");
    use_help_text(app);
    CLI::App* solve =
        app.add_subcommand("solve", "Displacements and stresses of a body under loads (docs/solvers.md).");
    app.require_subcommand(1);
    add_options(*solve, line);
    if (const auto answer = answer_before_parsing(app, argc, argv, version)) return answer;
    SolveRequest& request = line.request.solve;
    try {
        app.parse(argc, argv);
        if (!line.list_patches && (request.case_file.empty() || request.output.empty()))
            throw CLI::RequiredError("--case FILE and --output OUT, or --list-patches");
        line.meshes = !std::filesystem::is_directory(line.input);
        (line.meshes ? line.request.mesh.input : request.folder) = line.input;
        check_mesh_options(*solve, line);
    } catch (const CLI::ParseError& e) {
        return answer_to(app, e, argc, argv);
    }
    return std::nullopt;
}

// The number of ranks to start: that of the workers or processors, as far as these are of use; 1 for a list of patches,
// which is no work.
int wanted_ranks(const SolveLine& line) {
    if (line.ranks > 0 || line.list_patches) return std::max(1, line.ranks);
    const int useful =
        line.meshes ? useful_ranks_of_surface(line.input, line.request.mesh.parts) : useful_ranks_of_run(line.input);
    const int workers = line.request.mesh.workers.count;
    const int most = workers > 0 ? workers : static_cast<int>(allowed_processors().size());
    return std::clamp(most, 1, std::max(1, useful));
}

// Divides the workers that were asked for among the ranks that this program has started itself.
void share_workers(SolveLine& line, int ranks) {
    int& workers = line.request.mesh.workers.count;
    if (workers > 0 && line.ranks == 0 && is_own_launch()) workers = std::max(1, workers / ranks);
}

// The log of events, if there is one and this is the rank that writes it.
std::unique_ptr<EventLog> open_solve_events(const SolveLine& line, Communicator& ranks) {
    std::unique_ptr<EventLog> log;
    in_agreement(ranks, [&] {
        const std::string& file = line.request.mesh.outputs.events_file;
        if (ranks.rank() != 0 || file.empty() || line.list_patches) return;
        for (const std::string& read : {line.request.solve.case_file, line.meshes ? line.input : std::string()})
            refuse_to_overwrite(read, "--events", file);
        require_writable("--events", file, output_kind::events);
        log = std::make_unique<EventLog>(file);
        RunRequest told = line.request.mesh;
        told.input = line.input;
        told.output = line.request.solve.output;
        log->on_start(told);
    });
    return log;
}

int solve_on_ranks(const SolveLine& line, MpiRanks& ranks, EventLog* events) {
    const bool root = ranks.rank() == 0;
    const SolveRequest& request = line.request.solve;
    if (line.list_patches) {
        const std::vector<PatchSummary> patches = list_patches(request.folder, ranks);
        if (root) print_data(to_text(patches));
        return 0;
    }
    SolveReport report;
    {
        ProgressLine progress(line.quiet || !root, events);
        if (root) progress.tell_each_second();
        report = solve_run(request, ranks, &progress);
    }
    if (root && !line.quiet) tell(to_text(report));
    return report.exit_code;
}

int mesh_and_solve_on_ranks(const SolveLine& line, const Ranks& ranks, EventLog* events) {
    const bool root = ranks.communicator->rank() == 0;
    MeshAndSolveRequest request = line.request;
    MeshAndSolveReport report;
    {
        ProgressLine progress(line.quiet || !root, events);
        if (root) progress.tell_each_second();
        report = mesh_and_solve(request, ranks.cores_of_rank, *ranks.mpi, &progress,
                                [&](std::size_t number, const MeshAndSolveStep& step) {
                                    if (root && !line.quiet && request.steps > 0) progress.say(to_text(number, step));
                                });
    }
    if (!root) return report.exit_code;
    if (!report.solution) tell_failed_parts(report.mesh);
    if (!line.quiet) {
        tell(to_text(report.mesh));
        if (report.solution) tell("\n" + to_text(*report.solution));
    }
    return report.exit_code;
}

// Runs the solver and returns the exit code. An error that all ranks meet ends them alike; an error of a single rank,
// in the middle of an operation of all, has to end the others.
int run_solver(int argc, char** argv) {
    SolveLine line;
    if (const auto answer = parse_solve_line(argc, argv, line)) return tell_answer(*answer);
    if (const int wanted = is_launched() ? 1 : wanted_ranks(line); wanted > 1)
        if (const std::optional<int> code = run_as_ranks(wanted, argv)) return *code;
    const Ranks ranks = join_ranks(MpiUse::always);
    std::unique_ptr<EventLog> events;
    const auto end_events = [&](int code, const std::string& message) {
        if (events) events->on_end(code, message);
        return code;
    };
    const auto end_all = [&](ErrorCode code, const std::string& message) {
        end_events(static_cast<int>(code), message);
        tell(fmt::format("kerf: {}\n", message));
        if (ranks.mpi->size() > 1) ranks.mpi->end_all(static_cast<int>(code));
        return static_cast<int>(code);
    };
    try {
        require_own_ranks(ranks.communicator->size());
        share_workers(line, ranks.communicator->size());
        events = open_solve_events(line, *ranks.communicator);
        return end_events(line.meshes ? mesh_and_solve_on_ranks(line, ranks, events.get())
                                      : solve_on_ranks(line, *ranks.mpi, events.get()),
                          "");
    } catch (const PetscFailure& e) {
        return end_all(e.code(), e.what());
    } catch (const Error& e) {
        if (ranks.communicator->rank() == 0) tell(fmt::format("kerf: {}\n", e.what()));
        return end_events(static_cast<int>(e.code()), e.what());
    } catch (const std::exception& e) {
        if (is_out_of_memory(e))
            return end_all(ErrorCode::memory, "Out of memory. Use more ranks, more hosts, a coarser mesh or order 1.");
        return end_all(ErrorCode::internal, fmt::format("internal error: {}", e.what()));
    }
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    kerf::prepare_standard_streams();
    ::unsetenv("PETSC_OPTIONS");  // the case alone sets options of PETSc
    try {
        return kerf::run_solver(argc, argv);
    } catch (const kerf::Error& e) {
        if (kerf::is_first_rank()) kerf::tell(fmt::format("kerf: {}\n", e.what()));
        return static_cast<int>(e.code());
    } catch (const std::exception& e) {
        if (!kerf::is_out_of_memory(e)) throw;
        kerf::tell("kerf: Out of memory.\n");
        return static_cast<int>(kerf::ErrorCode::memory);
    }
}
