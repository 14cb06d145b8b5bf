// kerf help COMMAND, which is kerf COMMAND --help.
#include <array>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/other_programs.h"
#include "help/help_text.h"
#include "help/usage_error.h"

namespace kerf {

namespace {

int show_help(const CLI::App& kerf, std::string name) {
    std::string program = kerf.get_name(), option = "--help";
    std::array<char*, 4> argv = {program.data(), name.data(), option.data(), nullptr};
    if (const OtherProgram* other = find_other_program(name)) become(*other, argv.data());
    const CLI::App* command = name.empty() ? &kerf : find_command(kerf, name);
    if (!command) throw Error(ErrorCode::usage, unknown_command(kerf, name));
    return tell_answer({0, help_text(describe(*command))});
}

}  // namespace

void add_help_command(CLI::App& kerf, int& exit_code) {
    const auto name = std::make_shared<std::string>();
    CLI::App* command = kerf.add_subcommand("help", "Print the help of a command.");
    command->add_option("command", *name, "Command whose help is wanted. Default: kerf itself.")->type_name("COMMAND");
    command->callback([=, &kerf, &exit_code] { exit_code = show_help(kerf, *name); });
}

}  // namespace kerf
