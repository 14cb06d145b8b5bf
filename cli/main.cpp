// kerf: the headless program. Root rank prints; data goes to files, except for --json and --print-config.
#include <cstdio>
#include <exception>
#include <filesystem>

#include <fmt/format.h>

#include "cli/check.h"
#include "cli/command_line.h"
#include "cli/progress.h"
#include "cli/ranks.h"
#include "cli/verify.h"
#include "run/tree_text.h"

namespace kerf {

namespace {

std::string worker_beside_this_program() {
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "kerf-worker").string();
}

void report_failed_parts(const RunReport& report) {
    for (const PartReport& part : report.parts)
        if (part.result.code)
            fmt::print(stderr, "kerf: part {} could not be meshed: {} Its surface is kept in {}/failed.\n", part.id,
                       part.result.message, report.options.output);
}

int run_command(const CommandLine& line) {
    const Ranks ranks = join_ranks();
    const bool root = ranks.communicator->rank() == 0;
    RunOptions options = line.options;
    options.worker_program = worker_beside_this_program();
    Input input;
    try {
        RunReport report;
        {
            ProgressLine progress(line.quiet || !root);
            report = run(options, ranks.cores_of_rank, *ranks.communicator, input, &progress);
        }
        if (root && !line.quiet && (line.verbose || !options.volume))
            fmt::print(stderr, "{}\n", tree_text(report.nodes, line.verbose));
        if (root && !line.quiet) fmt::print(stderr, "{}", to_text(report));
        if (root) report_failed_parts(report);
        return report.exit_code;
    } catch (const Error& e) {
        if (root) fmt::print(stderr, "kerf: {}\n", e.what());
        return static_cast<int>(e.code());
    }
}

int run_program(int argc, char** argv) {
    const CommandLine line = parse_command_line(argc, argv);
    if (line.finished) {
        if (is_first_rank()) std::fputs(line.output.c_str(), line.exit_code == 0 ? stdout : stderr);
        return line.exit_code;
    }
    if (line.print_config) {
        std::fputs(line.config.c_str(), stdout);
        return 0;
    }
    switch (line.command) {
        case Command::check:
            return check_surface(line.check);
        case Command::verify:
            return verify_run(line.options.output);
        default:
            return run_command(line);
    }
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    try {
        return kerf::run_program(argc, argv);
    } catch (const kerf::Error& e) {
        fmt::print(stderr, "kerf: {}\n", e.what());
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "kerf: Out of memory.\n");
        return static_cast<int>(kerf::ErrorCode::memory);
    } catch (const std::exception& e) {
        fmt::print(stderr, "kerf: internal error: {}\n", e.what());
        return static_cast<int>(kerf::ErrorCode::internal);
    }
}
