#include "help/program_help.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "help/help_text.h"
#include "help/inside/completion.h"
#include "help/inside/man_page.h"
#include "help/usage_error.h"

namespace kerf {

namespace {

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
    app.set_help_flag("-h,--help", "Print this help and end.");
    app.formatter_fn(
        [](const CLI::App* command, const std::string&, CLI::AppFormatMode) { return help_text(describe(*command)); });
}

void put_help_last(CLI::App& command, const std::string& group, const std::vector<std::string>& common) {
    if (common.empty()) {
        command.set_help_flag("-h,--help", "Print this help and end.")->group(group);
        return;
    }
    command.set_help_flag("-h", "Print the options that most people need and end.")->group(group);
    command.set_help_all_flag("--help", "Print all options and end.")->group(group);
    command.formatter_fn([common](const CLI::App* app, const std::string&, CLI::AppFormatMode mode) {
        return mode == CLI::AppFormatMode::All ? help_text(describe(*app)) : short_help_text(describe(*app), common);
    });
}

Answer answer_to(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    std::ostringstream out, err;
    if (app.exit(error, out, err) == 0) return {0, out.str()};
    return {static_cast<int>(ErrorCode::usage), "kerf: " + usage_error(app, error, argc, argv) + "\n"};
}

std::optional<Answer> answer_before_parsing(const CLI::App& app, int argc, const char* const* argv,
                                            const std::string& version, const OtherCompletions& others) {
    const std::string asked = argc == 3 ? argv[1] : "";
    if (asked == "--man") return man_page_of(app, argv[2], version);
    if (asked == "--completion") return completion_of(app, argv[2], others);
    if (const std::string answer = old_spelling(app, argc, argv); !answer.empty())
        return Answer{static_cast<int>(ErrorCode::usage), "kerf: " + answer + "\n"};
    return std::nullopt;
}

}  // namespace kerf
