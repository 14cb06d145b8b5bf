#include "help/program_help.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"
#include "help/completion.h"
#include "help/help_text.h"
#include "help/man_page.h"
#include "help/nearest.h"

namespace kerf {

namespace {

constexpr const char* help_names = "-h,--help";
constexpr const char* help_of_help = "Print this help and end.";

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
    for (const CLI::App* command : app.get_subcommands(nullptr))
        if (command->get_name() == name) return command;
    return nullptr;
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

// The first argument that looks like an option, but is neither one of `app` nor the value of one; or empty.
std::string unknown_option(const CLI::App& app, int first, int argc, const char* const* argv) {
    for (int i = first; i < argc; ++i) {
        const std::string argument = argv[i], name = argument.substr(0, argument.find('='));
        if (name == "--") break;
        if (!name.starts_with('-')) continue;
        if (const CLI::Option* option = app.get_option_no_throw(name))
            i += name == argument ? option->get_items_expected_min() : 0;
        else if (name.starts_with("--"))
            return name;
    }
    return "";
}

std::string usage_error(const CLI::App& app, const std::string& message, int argc, const char* const* argv) {
    const std::string word = argc > 1 ? argv[1] : "";
    const CLI::App* command = find_command(app, word);
    if (!command && !word.empty() && !word.starts_with('-'))
        return fmt::format("'{}' is not a command.{} Run kerf --help for the commands.", word,
                           did_you_mean(word, command_names(app)));
    const std::string name = command ? "kerf " + word : "kerf";
    const CLI::App& asked = command ? *command : app;
    const std::string option = unknown_option(asked, command ? 2 : 1, argc, argv);
    if (option.empty()) return fmt::format("{}\nRun {} --help for more information.", message, name);
    return fmt::format("'{}' is not an option of {}.{} Run {} --help for its options.", option, name,
                       did_you_mean(option, option_names(asked)), name);
}

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
    return {static_cast<int>(ErrorCode::usage), "kerf: " + usage_error(app, error.what(), argc, argv) + "\n"};
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
