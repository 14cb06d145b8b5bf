// kerf: the headless program. Root rank prints; data goes to files, except for --json and --print-config.
#include <cstring>
#include <exception>
#include <memory>

#include <fmt/format.h>

#include "cli/check.h"
#include "cli/command_line.h"
#include "cli/failed_parts.h"
#include "cli/other_programs.h"
#include "cli/progress.h"
#include "cli/quality.h"
#include "cli/ranks.h"
#include "cli/remesh.h"
#include "cli/verify.h"
#include "io/standard_streams.h"
#include "run/pipeline.h"
#include "run/tree_text.h"

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

// Returns the exit code. The log of events outlives an error.
int run_on_ranks(const CommandLine& line, const Ranks& ranks, std::unique_ptr<EventLog>& events) {
    const bool root = ranks.communicator->rank() == 0;
    RunOptions options = line.options;
    options.worker_program = program_beside_this("kerf-worker");
    events = open_event_log(line, *ranks.communicator);
    Input input;
    RunReport report;
    {
        ProgressLine progress(line.quiet || !root, events.get());
        if (const std::string note = binding_note(ranks, options.workers); root && !line.quiet && !note.empty())
            tell(fmt::format("kerf: {}\n", note));
        report = run(options, ranks.cores_of_rank, *ranks.communicator, input, &progress);
    }
    if (events) events->on_end(report.exit_code, "");
    if (options.dry_run) return 0;
    if (root && !line.quiet && (line.verbose || !options.volume)) tell(tree_text(report.nodes, line.verbose) + "\n");
    if (root && !line.quiet) tell(to_text(report));
    if (root && line.verbose && report.reference) tell(report.reference->comparison);
    if (root) tell_failed_parts(report);
    return report.exit_code;
}

int run_command(const CommandLine& line) {
    const Ranks ranks = join_ranks();
    std::unique_ptr<EventLog> events;
    try {
        return run_together(*ranks.communicator, [&] { return run_on_ranks(line, ranks, events); });
    } catch (const Error& e) {
        if (ranks.communicator->rank() == 0) tell(fmt::format("kerf: {}\n", e.what()));
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
    switch (line.command) {
        case Command::check:
            return check_surface(line.check);
        case Command::export_formats:
            return export_formats(line.export_request, line.quiet);
        case Command::merge:
            return merge_run(line.merge);
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
        if (kerf::is_first_rank()) kerf::tell(fmt::format("kerf: {}\n", e.what()));  // all ranks meet it
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        kerf::tell("kerf: Out of memory.\n");
        return static_cast<int>(kerf::ErrorCode::memory);
    } catch (const std::exception& e) {
        kerf::tell(fmt::format("kerf: internal error: {}\n", e.what()));
        return static_cast<int>(kerf::ErrorCode::internal);
    }
}
