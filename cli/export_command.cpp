// kerf export: a finished run in the formats of solvers, also on the ranks of a job. The line goes into an
// ExportRequest, and export_run() (run/run/export_run.h) does all else; formats, their names and their help come from
// the table of files/export/formats.cpp, so that a new format needs no code here. The request lives in a shared pointer
// that the callback of the parsed command keeps, as all commands have it: the function that adds the command has
// returned when it runs.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "base/core/number_text.h"
#include "cli/commands.h"
#include "cli/option_flags.h"
#include "cli/progress.h"
#include "cli/ranks.h"
#include "files/export/format.h"
#include "files/io/standard_streams.h"
#include "help/number_option.h"
#include "run/run/export_run.h"

namespace kerf {

namespace {

struct ExportLine {
    ExportRequest request;
    bool quiet = false;
};

std::string summary_text(const ExportRequest& request, const ExportSummary& summary) {
    std::int64_t bytes = 0;
    for (const RunFile& file : summary.files) bytes += file.bytes;
    return fmt::format("kerf: {}: {} in {} part{}, {} tetrahedra, {} files, {:.1f} MB\n", summary.folder,
                       request.formats, summary.pieces, summary.pieces == 1 ? "" : "s", grouped(summary.tets),
                       summary.files.size(), bytes * 1e-6);
}

// Exports the run. Collective. Returns the exit code, the same on every rank.
int export_on_ranks(ExportRequest request, bool quiet) {
    const Ranks ranks = join_ranks();
    const bool root = ranks.communicator->rank() == 0;
    if (request.threads == 0) request.threads = ranks.cores_of_rank;
    try {
        ExportSummary summary;
        {
            ProgressLine progress(quiet || !root, nullptr);
            summary =
                run_together(*ranks.communicator, [&] { return export_run(request, *ranks.communicator, &progress); });
        }
        if (root && !quiet) {
            tell(summary_text(request, summary));
            for (const std::string& note : summary.notes) tell(fmt::format("kerf: note: {}\n", note));
        }
        return 0;
    } catch (const Error& e) {
        if (root) tell(fmt::format("kerf: {}\n", e.what()));
        return static_cast<int>(e.code());
    }
}

std::string list_of_formats() {
    std::string list = "Formats:\n";
    for (const Format* format : formats()) list += fmt::format("  {:<10} {}\n", format->name, format->help);
    return list +
           "\nA single format goes into OUT itself, several go into sub-folders. mpirun -n P kerf export shares the "
           "parts among P ranks.";
}

void add_options(CLI::App& command, ExportLine& line) {
    ExportRequest& request = line.request;
    command.add_option("folder", request.folder, "Folder of the run, or of a solution, with its values.")
        ->required()
        ->type_name("DIR");
    command.add_option("-f,--format", request.formats, "Formats, with commas between.")
        ->required()
        ->type_name("LIST")
        ->check(suggest_formats());
    command
        .add_option("-o,--output", request.output,
                    "Folder for them. Default: DIR/export/NAME, so that they become part of the run.")
        ->type_name("OUT");
    command
        .add_option("--fields", request.fields,
                    "Qualities of cells in vtu files, as kerf mesh --help says. Default min-dihedral.")
        ->type_name("LIST")
        ->check(suggest_cell_fields());
    command.add_flag("--msh-ascii", request.msh_ascii, "Write msh as text instead of binary.");
    command
        .add_option(
            "--patch-type", request.patch_types,
            "OpenFOAM's type of a patch: patch, wall, symmetry, symmetryPlane; * in NAME stands for any characters. "
            "Default: as kerf mesh was told, else patch. Repeatable.")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("NAME=TYPE");
    command.add_flag("--split-regions", request.split_regions,
                     "OpenFOAM: one mesh for each region, their walls mapped to each other.");
    add_number(command, "--into", request.into, {"a whole number, 1 or more", 1},
               "Join the parts along the tree into so many pieces.")
        ->type_name("N");
    add_number(command, "--order", request.order, {"1 or 2", 1, 2},
               "Of the cells: 2 has a node on each edge. Default: that of the run.")
        ->type_name("N");
    add_number(command, "-j,--workers", request.threads, {"a whole number, 1 to 4096", 1, 4096},
               "Parts that each rank writes at once. Default: its processors.")
        ->type_name("W");
    command.add_flag("-q,--quiet", line.quiet, "Print nothing but errors.");
}

}  // namespace

void add_export_command(CLI::App& kerf, int& exit_code) {
    const auto line = std::make_shared<ExportLine>();
    line->request.threads = 0;
    CLI::App* command = kerf.add_subcommand("export", "Write a finished run in the formats of solvers, part by part.");
    command->footer(list_of_formats());
    add_options(*command, *line);
    command->callback([=, &exit_code] { exit_code = export_on_ranks(line->request, line->quiet); });
}

}  // namespace kerf
