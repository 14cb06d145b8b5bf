#include "help/program_help.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"
#include "help/completion.h"
#include "help/help_text.h"
#include "help/man_page.h"
#include "help/usage_error.h"

namespace kerf {

namespace {

constexpr const char* help_names = "-h,--help";
constexpr const char* help_of_help = "Print this help and end.";

Answer man_page_of(const CLI::App& app, const std::string& name, const std::string& version) {
    const CLI::App* command = name == app.get_name() ? &app : find_command(app, name);
    if (!command) return {static_cast<int>(ErrorCode::usage), fmt::format("kerf: '{}' is not a command.\n", name)};
    return {0, man_page(describe(*command), version)};
}

Answer completion_of(const CLI::App& app, const std::string& shell, const OtherCompletions& others) {
    if (std::find(shells.begin(), shells.end(), shell) == shells.end())
        return {static_cast<int>(ErrorCode::usage),
                fmt::format("kerf: There is no completion for '{}', but for {}.\n", shell, fmt::join(shells, ", "))};
    std::string parts;
    for (const CLI::App* command : app.get_subcommands(nullptr))
        if (!command->get_disabled()) parts += command_completion(describe(*command), shell);
    if (!others) return {0, parts};
    return {0, completion_script(describe(app), parts + others(shell), shell)};
}

}  // namespace

void use_help_text(CLI::App& app) {
    app.set_help_flag(help_names, help_of_help);
    app.formatter_fn(
        [](const CLI::App* command, const std::string&, CLI::AppFormatMode) { return help_text(describe(*command)); });
}

void put_help_last(CLI::App& command, const std::string& group) {
    command.set_help_flag(help_names, help_of_help)->group(group);
}

Answer answer_to(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    std::ostringstream out, err;
    if (app.exit(error, out, err) == 0) return {0, out.str()};
    return {static_cast<int>(ErrorCode::usage), "kerf: " + usage_error(app, error, argc, argv) + "\n"};
}

std::optional<Answer> document(const CLI::App& app, int argc, const char* const* argv, const std::string& version,
                               const OtherCompletions& others) {
    if (argc != 3) return std::nullopt;
    const std::string asked = argv[1], about = argv[2];
    if (asked == "--man") return man_page_of(app, about, version);
    if (asked == "--completion") return completion_of(app, about, others);
    return std::nullopt;
}

}  // namespace kerf
