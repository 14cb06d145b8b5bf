// kerf-solve: linear elasticity on the parts of a run, in a program of its own. Started by `kerf solve`, also under
// mpirun.
#include <exception>
#include <new>
#include <sstream>

#include <fmt/format.h>
#include <mpi.h>
#include <CLI/CLI.hpp>

#include "cli/progress.h"
#include "cli/ranks.h"
#include "core/error.h"
#include "io/standard_streams.h"
#include "solve/solve_run.h"

namespace kerf {

namespace {

struct SolveLine {
    SolveRequest request;
    bool list_patches = false, quiet = false;
    bool finished = false;
    int exit_code = 0;
    std::string output;
};

SolveLine parse_solve_line(int argc, const char* const* argv) {
    SolveLine line;
    CLI::App app(
        "Kerf: linear elasticity on the parts of a finished run.\n"
        "mpirun -n P kerf solve ... shares the parts out among P ranks.",
        "kerf");
    CLI::App* solve = app.add_subcommand("solve", "Displacements and stresses of a body under loads (docs/solve.md).");
    app.require_subcommand(1);
    solve->add_option("folder", line.request.folder, "Folder of the run.")->required()->type_name("DIR");
    CLI::Option* case_file =
        solve->add_option("--case", line.request.case_file, "Materials, supports and loads, as TOML.")
            ->type_name("FILE");
    CLI::Option* output =
        solve->add_option("-o,--output", line.request.output, "Folder for the solution.")->type_name("DIR");
    solve
        ->add_flag("--list-patches", line.list_patches, "Print name, area, centroid and normal of each patch, and end.")
        ->excludes(case_file)
        ->excludes(output);
    solve->add_flag("-q,--quiet", line.quiet, "Print errors alone.");
    try {
        app.parse(argc, argv);
        if (!line.list_patches && (line.request.case_file.empty() || line.request.output.empty()))
            throw CLI::RequiredError("--case FILE and --output DIR, or --list-patches");
    } catch (const CLI::ParseError& e) {
        std::ostringstream out, err;
        line.finished = true;
        line.exit_code = app.exit(e, out, err) == 0 ? 0 : static_cast<int>(ErrorCode::usage);
        line.output = line.exit_code == 0 ? out.str() : "kerf: " + err.str();
    }
    return line;
}

int solve_on_ranks(const SolveLine& line, Communicator& ranks) {
    const bool root = ranks.rank() == 0;
    if (line.list_patches) {
        const std::vector<PatchSummary> patches = list_patches(line.request.folder, ranks);
        if (root) print_data(to_text(patches));
        return 0;
    }
    SolveReport report;
    {
        ProgressLine progress(line.quiet || !root, nullptr);
        report = solve_run(line.request, ranks, &progress);
    }
    if (root && !line.quiet) tell(to_text(report));
    return report.exit_code;
}

// An error that all ranks meet ends them alike. What only one of them meets, in the middle of what they do together,
// has to end the others.
int run_solver(int argc, char** argv) {
    const SolveLine line = parse_solve_line(argc, argv);
    if (line.finished) {
        if (is_first_rank()) (line.exit_code == 0 ? print_data : tell)(line.output);
        return line.exit_code;
    }
    const Ranks ranks = join_ranks(MpiUse::always);
    const auto end_all = [&](ErrorCode code, const std::string& message) {
        tell(fmt::format("kerf: {}\n", message));
        if (ranks.communicator->size() > 1) MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
        return static_cast<int>(code);
    };
    try {
        return solve_on_ranks(line, *ranks.communicator);
    } catch (const PetscFailure& e) {
        return end_all(e.code(), e.what());
    } catch (const Error& e) {
        if (ranks.communicator->rank() == 0) tell(fmt::format("kerf: {}\n", e.what()));
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        return end_all(ErrorCode::memory, "Out of memory. Use more ranks, more hosts, a coarser mesh or order 1.");
    } catch (const std::exception& e) {
        return end_all(ErrorCode::internal, fmt::format("internal error: {}", e.what()));
    }
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    kerf::prepare_standard_streams();
    try {
        return kerf::run_solver(argc, argv);
    } catch (const kerf::Error& e) {
        if (kerf::is_first_rank()) kerf::tell(fmt::format("kerf: {}\n", e.what()));
        return static_cast<int>(e.code());
    }
}
