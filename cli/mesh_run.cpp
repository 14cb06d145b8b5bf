// kerf mesh and kerf decompose on the ranks of a job: checks of outputs, the log of events, the run
// (run/run/pipeline.h), the merge into one file, and the messages. Every step that only the first rank does and that
// may fail is done in_agreement(), so that an error of it ends all ranks alike; run_together() does the same for the
// whole. Outputs are checked before the run, as an error after hours would be late. If the merge fails, the run's
// folder stays, because it holds the whole mesh. The log of events outlives an error, which is its last line. Messages
// go to standard error, from the first rank.
#include "cli/mesh_run.h"

#include <cstdlib>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/shell_word.h"
#include "cli/failed_parts.h"
#include "cli/progress.h"
#include "cli/ranks.h"
#include "cli/terminal.h"
#include "files/export/merged_file.h"
#include "files/io/output_file.h"
#include "files/io/program_finder.h"
#include "files/io/run_manifest.h"
#include "files/io/standard_streams.h"
#include "run/report/tree_text.h"
#include "run/run/pipeline.h"

namespace kerf {

namespace {

// The log of events, if there is one and this is the rank that writes it.
std::unique_ptr<EventLog> open_event_log(const MeshRequest& request, Communicator& ranks) {
    std::unique_ptr<EventLog> log;
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0 || request.options.outputs.events_file.empty()) return;
        request.options.check_files();
        log = std::make_unique<EventLog>(request.options.outputs.events_file);
        log->on_start(request.options);
    });
    return log;
}

// The file in which TetGen's .poly and .smesh may have their nodes; empty for other files.
std::string node_file_of(const std::string& input) {
    std::filesystem::path file = input;
    const std::string ending = file.extension().string();
    return ending == ".poly" || ending == ".smesh" ? file.replace_extension(".node").string() : "";
}

// Refuses outputs that would be lost, or would take the place of files that are read. Before the run; collective.
void check_outputs(const MeshRequest& request, Communicator& ranks) {
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return;
        std::vector<NamedPath> outputs = request.options.outputs.files();
        if (!request.merged_file.empty()) {
            for (const std::string& read :
                 {request.options.input, node_file_of(request.options.input), request.options.sizes.field_file})
                refuse_to_overwrite(read, "--output", request.merged_file);
            check_merged_file({.folder = request.options.output,
                               .output = request.merged_file,
                               .options = {},
                               .order = request.options.order});
            outputs.push_back({"--output", request.merged_file});
        }
        for (const NamedPath& output : outputs) refuse_to_overwrite(request.config_file, output.option, output.path);
        refuse_same_outputs(outputs);
    });
}

// Merges the run into one file in the place of its folder. Collective.
void merge_result(const MeshRequest& request, const RunReport& report, Communicator& ranks) {
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return;
        try {
            merge_run({.folder = report.folder.path,
                       .output = request.merged_file,
                       .options = {},
                       .order = request.options.order});
        } catch (const Error& e) {
            throw Error(
                e.code(),
                fmt::format("{} The mesh is whole in {}; kerf merge {} -o {} writes it.", e.what(), report.folder.path,
                            shell_word(report.folder.path), shell_word(request.merged_file)),
                e.elements());
        }
        remove_run_folder(report.folder.path);
    });
}

bool has_display() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

bool can_be_measured(const std::string& file) {
    const std::string ending = std::filesystem::path(file).extension().string();
    return ending == ".msh" || ending == ".mesh" || ending == ".vtu" || ending == ".vtk" || ending == ".node";
}

// The command that a user is likely to run next; empty if another program takes the result.
std::string next_command(const MeshRequest& request, const RunReport& report) {
    if (!request.merged_file.empty())
        return can_be_measured(request.merged_file) ? "kerf quality " + shell_word(request.merged_file) : "";
    if (has_display() && look_for_program("kerf-view").found) return "kerf view " + shell_word(request.options.output);
    return report.request.volume ? "kerf quality " + shell_word(request.options.output)
                                 : "kerf mesh " + shell_word(report.request.input);
}

std::string result_text(const MeshRequest& request, const RunReport& report) {
    const std::string place = request.merged_file.empty() ? request.options.output : request.merged_file;
    const std::string next = next_command(request, report);
    return fmt::format("{:<11} {}{}\n", "result", place, next.empty() ? "" : "; next: " + next);
}

void tell_result(const MeshRequest& request, const RunReport& report) {
    if (request.verbose || !report.request.volume) tell(tree_text(report.cut.nodes, request.verbose) + "\n");
    tell_report(to_text(report, request.verbose ? ReportDetail::all : ReportDetail::brief));
    if (report.exit_code == 0) tell_report(result_text(request, report));
    if (request.verbose && report.reference) tell(report.reference->comparison);
}

// Runs the request and returns the exit code. The log of events outlives an error.
int run_on_ranks(const MeshRequest& request, const Ranks& ranks, std::unique_ptr<EventLog>& events) {
    const bool root = ranks.communicator->rank() == 0;
    const RunRequest& options = request.options;
    check_outputs(request, *ranks.communicator);
    events = open_event_log(request, *ranks.communicator);
    RunReport report;
    {
        ProgressLine progress(request.quiet || !root, events.get(), request.verbose || options.dry_run);
        if (root && !request.quiet && request.has_usual_output)
            tell(fmt::format("kerf: The result goes into {}; -o chooses another place.\n", options.output));
        if (const std::string note = binding_note(ranks, options.workers.count);
            root && !request.quiet && !note.empty())
            tell(fmt::format("kerf: {}\n", note));
        report = run(options, ranks.cores_of_rank, *ranks.communicator, &progress);
    }
    const bool is_merged = !request.merged_file.empty() && report.exit_code == 0 && !options.dry_run;
    if (is_merged) merge_result(request, report, *ranks.communicator);
    if (events) events->on_end(report.exit_code, "");
    if (options.dry_run) return 0;
    if (root && !request.quiet) tell_result(request, report);
    if (root) tell_failed_parts(report);
    if (root && !request.merged_file.empty() && !is_merged)
        tell(fmt::format("kerf: {} is not written. kerf mesh --resume {} does that when all parts are there.\n",
                         request.merged_file, shell_word(request.merged_file)));
    return report.exit_code;
}

}  // namespace

int mesh_on_ranks(const MeshRequest& request) {
    const Ranks ranks = join_ranks();
    std::unique_ptr<EventLog> events;
    try {
        return run_together(*ranks.communicator, [&] { return run_on_ranks(request, ranks, events); });
    } catch (const Error& e) {
        if (ranks.communicator->rank() == 0) tell_error(e.what());
        if (events) events->on_end(static_cast<int>(e.code()), e.what());
        return static_cast<int>(e.code());
    }
}

}  // namespace kerf
