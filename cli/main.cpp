// kerf: the headless program. Root rank prints; data goes to files, except for --json and --print-config.
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/check.h"
#include "cli/command_line.h"
#include "cli/failed_parts.h"
#include "cli/merge.h"
#include "cli/other_programs.h"
#include "cli/progress.h"
#include "cli/quality.h"
#include "cli/ranks.h"
#include "cli/remesh.h"
#include "cli/terminal.h"
#include "cli/verify.h"
#include "io/output_file.h"
#include "io/program_finder.h"
#include "io/run_manifest.h"
#include "io/standard_streams.h"
#include "report/tree_text.h"
#include "run/pipeline.h"

namespace kerf {

namespace {

// The log of events, if there is one and this is the rank that writes it.
std::unique_ptr<EventLog> open_event_log(const CommandLine& line, Communicator& ranks) {
    std::unique_ptr<EventLog> log;
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0 || line.options.events_file.empty()) return;
        line.options.check_files();
        log = std::make_unique<EventLog>(line.options.events_file);
        log->on_start(line.options);
    });
    return log;
}

// Where TetGen's .poly and .smesh may have their nodes; empty for other files.
std::string node_file_of(const std::string& input) {
    std::filesystem::path file = input;
    const std::string ending = file.extension().string();
    return ending == ".poly" || ending == ".smesh" ? file.replace_extension(".node").string() : "";
}

// Before the run: outputs that would be lost, or would take the place of what was read. Collective.
void check_outputs(const CommandLine& line, Communicator& ranks) {
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return;
        std::vector<NamedPath> outputs = line.options.output_files();
        if (!line.merged_file.empty()) {
            for (const std::string& read :
                 {line.options.input, node_file_of(line.options.input), line.options.sizes.field_file})
                refuse_to_overwrite(read, "--output", line.merged_file);
            check_merged_file({line.options.output, line.merged_file, {}});
            outputs.push_back({"--output", line.merged_file});
        }
        for (const NamedPath& output : outputs) refuse_to_overwrite(line.config_file, output.option, output.path);
        refuse_same_outputs(outputs);
    });
}

// The one file in place of the run's folder. Collective.
void merge_result(const CommandLine& line, const RunReport& report, Communicator& ranks) {
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return;
        try {
            merge_run({.folder = report.folder, .output = line.merged_file, .options = {}});
        } catch (const Error& e) {
            throw Error(e.code(), fmt::format("{} The mesh is whole in {}; kerf merge {} -o {} writes it.", e.what(),
                                              report.folder, shell_word(report.folder), shell_word(line.merged_file)));
        }
        remove_run_folder(report.folder);
    });
}

bool has_display() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

bool can_be_measured(const std::string& file) {
    const std::string ending = std::filesystem::path(file).extension().string();
    return ending == ".msh" || ending == ".mesh" || ending == ".vtu" || ending == ".node";
}

// What one does next with the result; empty if that is the business of another program.
std::string next_command(const CommandLine& line, const RunReport& report) {
    if (!line.merged_file.empty())
        return can_be_measured(line.merged_file) ? "kerf quality " + shell_word(line.merged_file) : "";
    if (has_display() && look_for_program("kerf-view").found) return "kerf view " + shell_word(line.options.output);
    return report.options.volume ? "kerf quality " + shell_word(line.options.output)
                                 : "kerf mesh " + shell_word(report.options.input);
}

std::string result_text(const CommandLine& line, const RunReport& report) {
    const std::string place = line.merged_file.empty() ? line.options.output : line.merged_file;
    const std::string next = next_command(line, report);
    return fmt::format("{:<11} {}{}\n", "result", place, next.empty() ? "" : "; next: " + next);
}

void tell_result(const CommandLine& line, const RunReport& report) {
    if (line.verbose || !report.options.volume) tell(tree_text(report.nodes, line.verbose) + "\n");
    tell_report(to_text(report, line.verbose ? ReportDetail::all : ReportDetail::brief));
    if (report.exit_code == 0) tell_report(result_text(line, report));
    if (line.verbose && report.reference) tell(report.reference->comparison);
}

// Returns the exit code. The log of events outlives an error.
int run_on_ranks(const CommandLine& line, const Ranks& ranks, std::unique_ptr<EventLog>& events) {
    const bool root = ranks.communicator->rank() == 0;
    RunOptions options = line.options;
    check_outputs(line, *ranks.communicator);
    events = open_event_log(line, *ranks.communicator);
    Input input;
    RunReport report;
    {
        ProgressLine progress(line.quiet || !root, events.get(), line.verbose || options.dry_run);
        if (root && !line.quiet && line.has_usual_output)
            tell(fmt::format("kerf: The result goes into {}; -o chooses another place.\n", options.output));
        if (const std::string note = binding_note(ranks, options.workers); root && !line.quiet && !note.empty())
            tell(fmt::format("kerf: {}\n", note));
        report = run(options, ranks.cores_of_rank, *ranks.communicator, input, &progress);
    }
    const bool is_merged = !line.merged_file.empty() && report.exit_code == 0 && !options.dry_run;
    if (is_merged) merge_result(line, report, *ranks.communicator);
    if (events) events->on_end(report.exit_code, "");
    if (options.dry_run) return 0;
    if (root && !line.quiet) tell_result(line, report);
    if (root) tell_failed_parts(report);
    if (root && !line.merged_file.empty() && !is_merged)
        tell(fmt::format("kerf: {} is not written. kerf mesh --resume {} does that when all parts are there.\n",
                         line.merged_file, shell_word(line.merged_file)));
    return report.exit_code;
}

int run_command(const CommandLine& line) {
    const Ranks ranks = join_ranks();
    std::unique_ptr<EventLog> events;
    try {
        return run_together(*ranks.communicator, [&] { return run_on_ranks(line, ranks, events); });
    } catch (const Error& e) {
        if (ranks.communicator->rank() == 0) tell_error(e.what());
        if (events) events->on_end(static_cast<int>(e.code()), e.what());
        return static_cast<int>(e.code());
    }
}

int run_program(int argc, char** argv) {
    const int place = argc > 2 && std::strcmp(argv[1], "--man") == 0 ? 2 : 1;
    if (argc > place)
        if (const OtherProgram* other = find_other_program(argv[place])) become(*other, argv);
    const CommandLine line = parse_command_line(argc, argv);
    if (line.finished) {
        if (!is_first_rank()) return line.exit_code;
        if (line.exit_code == 0)
            print_data(line.output);
        else
            tell(line.output);
        return line.exit_code;
    }
    if (line.print_config) {
        if (is_first_rank()) print_data(line.config);
        return 0;
    }
    const bool is_of_ranks =
        line.command == Command::mesh || line.command == Command::decompose || line.command == Command::export_formats;
    if (!is_of_ranks && !is_first_rank()) return 0;  // one is enough
    switch (line.command) {
        case Command::check:
            return check_surface(line.check);
        case Command::export_formats:
            return export_formats(line.export_request, line.quiet);
        case Command::merge:
            return merge_command(line.merge, line.quiet);
        case Command::quality:
            return show_quality(line.quality);
        case Command::remesh:
            return remesh_surface(line.options, line.remeshed_file, line.quiet);
        case Command::verify:
            return verify_run(line.options.output, line.verify);
        default:
            return run_command(line);
    }
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    kerf::prepare_standard_streams();
    try {
        return kerf::run_program(argc, argv);
    } catch (const kerf::Error& e) {
        if (kerf::is_first_rank()) kerf::tell_error(e.what());  // all ranks meet it
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        kerf::tell_error("Out of memory.");
        return static_cast<int>(kerf::ErrorCode::memory);
    } catch (const std::exception& e) {
        kerf::tell_error(fmt::format("internal error: {}", e.what()));
        return static_cast<int>(kerf::ErrorCode::internal);
    }
}
