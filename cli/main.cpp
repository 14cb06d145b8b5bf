// kerf: the program without windows. Commands of other programs (other_programs.h) replace this process; the others
// have a file each (commands.h). Messages go to standard error, from the first rank of a job; data goes to files, or to
// standard output where the user has asked for it there.
#include <cstring>
#include <exception>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "base/core/out_of_memory.h"
#include "base/core/version.h"
#include "base/parallel/failure_deadline.h"
#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/other_programs.h"
#include "cli/ranks.h"
#include "cli/terminal.h"
#include "files/io/standard_streams.h"
#include "help/program_help.h"

namespace kerf {

namespace {

constexpr const char* description =
    "Kerf: parallel tetrahedral meshes by decomposition of the closed surface.\n"
    "mpirun -n P kerf mesh ... runs the same command on P ranks.\n"
    "kerf COMMAND --help lists the options of a command.";

constexpr const char* exit_codes =
    "Exit codes: 0 done and verified, 1 internal error, 2 usage, 3 input rejected, 4 a part could not be meshed, 5 out "
    "of memory, 6 a limit of quality was missed, 7 reading or writing failed, 8 verification failed, 9 the solver did "
    "not reach its tolerance, 130 cancelled.";

int run_program(int argc, char** argv) {
    const int place = argc > 2 && std::strcmp(argv[1], "--man") == 0 ? 2 : 1;
    if (argc > place)
        if (const OtherProgram* other = find_other_program(argv[place])) become(*other, argv);
    CLI::App app(description, "kerf");
    app.footer(exit_codes);
    use_help_text(app);
    app.set_version_flag("-V,--version", std::string("kerf ") + version, "Print the version and end.");
    app.require_subcommand(1);
    int exit_code = 0;
    for (AddCommand* add : own_commands) add(app, exit_code);
    // Commands of other programs are here only for the list: they have been passed on.
    for (const OtherProgram& other : other_programs) app.add_subcommand(other.command, other.help)->disabled();
    if (const auto answer = answer_before_parsing(app, argc, argv, version, [](const std::string& shell) {
            return output_of_other_programs({"--completion", shell});
        }))
        return tell_answer(*answer);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return tell_answer(answer_to(app, e, argc, argv));
    }
    return exit_code;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    kerf::prepare_standard_streams();
    try {
        return kerf::run_program(argc, argv);
    } catch (const kerf::Error& e) {
        // All ranks meet this error, and the first one tells it; where they do not, this rank tells it at the deadline.
        if (kerf::is_first_rank()) kerf::tell_error(e.what());
        kerf::begin_failure_deadline(static_cast<int>(e.code()), kerf::is_first_rank() ? "" : e.what());
        return static_cast<int>(e.code());
    } catch (const std::exception& e) {
        const bool no_memory = kerf::is_out_of_memory(e);
        const int code = static_cast<int>(no_memory ? kerf::ErrorCode::memory : kerf::ErrorCode::internal);
        kerf::begin_failure_deadline(code, "");
        kerf::tell_error(no_memory ? "Out of memory." : fmt::format("internal error: {}", e.what()));
        return code;
    }
}
