// Usage errors in words of Kerf. CLI11 tells the wrong option and the reason in the text of its errors alone, as in
// "--size: 1 required H missing", so that sentences are made from the class of an error and the option that its text
// begins with; another version of CLI11 may word its errors otherwise. Unknown and old options are found in the command
// line itself (written_options()), because CLI11 may trip over something else first. For that, arguments are read as
// CLI11 reads them: "-qn4" is the flag q and the option n with its value, and the value of an option is no option even
// if it looks like one.
#include "help/usage_error.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "help/command_help.h"
#include "help/inside/old_spellings.h"
#include "help/nearest.h"

namespace kerf {

namespace {

// Lines that can be typed as they stand, once there is a part.stl.
constexpr std::array<std::pair<const char*, const char*>, 11> examples = {{
    {"mesh", "kerf mesh part.stl -o out -n 8"},
    {"decompose", "kerf decompose part.stl -o cut -n 8"},
    {"check", "kerf check part.stl"},
    {"verify", "kerf verify out"},
    {"export", "kerf export out --format openfoam -o case"},
    {"merge", "kerf merge out -o part.msh"},
    {"quality", "kerf quality out"},
    {"remesh", "kerf remesh part.stl -o better.obj"},
    {"solve", "kerf solve part.stl --case case.toml -o solved"},
    {"view", "kerf view out"},
    {"screenshot", "kerf screenshot out -o out.png"},
}};

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

// The option of an argument with one dash that takes the rest of it, or the next ones, as its value: that of -qn4 or
// -qn. Of flags alone it is the last one. None if a letter is no option.
const CLI::Option* last_of_letters(const CLI::App& app, const std::string& argument) {
    const CLI::Option* option = nullptr;
    for (std::size_t i = 1; i < argument.size(); ++i) {
        option = app.get_option_no_throw(std::string("-") + argument[i]);
        if (!option || option->get_items_expected_max() > 0) break;
    }
    return option;
}

bool is_option_like(const std::string& argument) {
    return argument.size() > 1 && argument[0] == '-' &&
           (argument[1] == '-' || std::isalpha(static_cast<unsigned char>(argument[1])));
}

struct WrittenOption {
    std::string name;                     // name with its dashes
    std::string value;                    // the first value
    const CLI::Option* option = nullptr;  // option of the command; null: it has none of this name
};

// The arguments that look like an option and are not the value of one.
std::vector<WrittenOption> written_options(const CLI::App& command, int first, int argc, const char* const* argv) {
    std::vector<WrittenOption> written;
    for (int i = first; i < argc; ++i) {
        const std::string argument = argv[i], name = argument.substr(0, argument.find('='));
        if (name == "--") break;
        if (!is_option_like(argument)) continue;
        const bool is_long = name.starts_with("--");
        const CLI::Option* option = is_long ? command.get_option_no_throw(name) : last_of_letters(command, argument);
        const bool has_value =
            is_long ? name != argument : option && !option->check_sname(argument.substr(argument.size() - 1));
        const std::string behind = i + 1 < argc ? argv[i + 1] : "";
        written.push_back({name, has_value && is_long ? argument.substr(name.size() + 1) : behind, option});
        if (option && !has_value) i += option->get_items_expected_min();
    }
    return written;
}

// The first of these that the command does not have; empty if it has all.
std::string unknown_option(const std::vector<WrittenOption>& written) {
    const auto unknown =
        std::find_if(written.begin(), written.end(), [](const WrittenOption& one) { return !one.option; });
    return unknown == written.end() ? "" : unknown->name;
}

bool has_word(std::string_view words, const std::string& word) {
    const std::vector<std::string> all = CLI::detail::split(std::string(words), ' ');
    return std::find(all.begin(), all.end(), word) != all.end();
}

}  // namespace

std::string unknown_command(const CLI::App& app, const std::string& word) {
    std::error_code ignored;
    if (std::filesystem::is_directory(word, ignored))
        return fmt::format(
            "'{}' is a folder, not a command. kerf verify {} checks the run in it, kerf quality {} "
            "measures its cells.",
            word, word, word);
    const std::string stem = std::filesystem::path(word).stem().string();
    if (std::filesystem::exists(word, ignored) || word.find_first_of("./") != word.npos)
        return fmt::format(
            "'{}' is not a command, but looks like a file. kerf check {} says whether it can be meshed, kerf mesh {} "
            "-o {}-mesh meshes it.",
            word, word, word, stem);
    return fmt::format("'{}' is not a command.{} Run kerf --help for the commands.", word,
                       did_you_mean(word, command_names(app)));
}

namespace {

// The text before the first of these words.
std::string before(const std::string& text, std::initializer_list<const char*> words) {
    std::size_t end = text.npos;
    for (const char* word : words) end = std::min(end, text.find(word));
    return text.substr(0, end);
}

// The option as the help has it: "--size H", or "INPUT".
std::string word_for(const CLI::Option& option, const CLI::App& command) {
    if (option.get_positional()) return option.get_type_name();
    for (const OptionGroup& group : describe(command).groups)
        for (const OptionHelp& one : group.options)
            if (one.names.back() == option.get_name())
                return one.names.back() + (one.value.empty() ? "" : " " + one.value);
    return option.get_name();
}

// The name of an option; a positional is called as in the usage line.
std::string name_for(const std::string& name, const CLI::App& command) {
    const CLI::Option* option = command.get_option_no_throw(name);
    return option && option->get_positional() ? option->get_type_name() : name;
}

std::string lacking(const std::string& name, const CLI::App& command, const std::string& full_name) {
    const CLI::Option* option = command.get_option_no_throw(name);
    if (!option) return fmt::format("{} needs {}.", full_name, name);
    return fmt::format("{} needs {}: {}", full_name, word_for(*option, command), option->get_description());
}

std::string sentence(const CLI::ParseError& error, const CLI::App& command, const std::string& full_name) {
    const std::string kind = error.get_name(), text = error.what();
    const std::string name = before(text, {":", " is required", " excludes ", " was given"});
    const CLI::Option* option = command.get_option_no_throw(name);
    if (kind == "RequiredError" && !command.get_subcommands(nullptr).empty())
        return fmt::format("Which command? There are {}.", fmt::join(command_names(command), ", "));
    if (kind == "RequiredError") return lacking(name, command, full_name);
    if (kind == "ExcludesError")
        return fmt::format("{} and {} do not go together. Leave one of them out.", name_for(name, command),
                           name_for(text.substr(text.rfind(' ') + 1), command));
    if (text.starts_with("The following argument"))  // the kind of this error is the name of the command
        return fmt::format("{} takes no further arguments, but there is {}.", full_name,
                           text.substr(text.find(": ") + 2));
    if (kind == "ArgumentMismatch" && option && option->get_items_expected_max() == 0)
        return fmt::format("{} is a flag: give it without a value.", name);
    if (kind == "ArgumentMismatch" && option && text.find(" At Most ") == text.npos)
        return fmt::format("{} needs a value: {}. {}", name, word_for(*option, command), option->get_description());
    if (kind == "ArgumentMismatch" && option) return fmt::format("{} is given more than once. Choose one.", name);
    if (kind == "ConversionError") return fmt::format("{}. A flag is given without a value.", text);
    if (kind == "ValidationError" && option)
        return name + text.substr(name.size() + 1);  // the sentence of one_of() follows the name
    return text;
}

std::string way_on(const CLI::App& command, const std::string& full_name) {
    for (const auto& [name, example] : examples)
        if (command.get_name() == name)
            return fmt::format("Example: {}. Run {} --help for all options.", example, full_name);
    return fmt::format("Run {} --help for more.", full_name);
}

}  // namespace

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
    for (const CLI::App* command : app.get_subcommands(nullptr))
        if (command->get_name() == name) return command;
    return nullptr;
}

std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    const std::string word = argc > 1 ? argv[1] : "";
    const CLI::App* command = find_command(app, word);
    if (!command && !word.empty() && !word.starts_with('-')) return unknown_command(app, word);
    const std::string name = command ? "kerf " + word : "kerf";
    const CLI::App& asked = command ? *command : app;
    const std::string option = unknown_option(written_options(asked, command ? 2 : 1, argc, argv));
    if (option.empty()) return sentence(error, asked, name) + "\n" + way_on(asked, name);
    return fmt::format("'{}' is not an option of {}.{} Run {} --help for its options.", option, name,
                       did_you_mean(option, option_names(asked)), name);
}

std::string old_spelling(const CLI::App& app, int argc, const char* const* argv) {
    const CLI::App* command = argc > 1 ? find_command(app, argv[1]) : nullptr;
    if (!command) return "";
    for (const WrittenOption& written : written_options(*command, 2, argc, argv))
        for (const OldSpelling& old : old_spellings) {
            const bool is_meant = has_word(old.commands, argv[1]) && written.name == old.option;
            if (is_meant && (old.value.empty() || written.value == old.value))
                return fmt::format("{}{}{} of kerf {} is {} now. Run kerf {} --help for its options.", old.option,
                                   old.value.empty() ? "" : " ", old.value, argv[1], old.now, argv[1]);
        }
    return "";
}

CLI::Validator one_of(const std::string& choices) {
    const std::vector<std::string> names = CLI::detail::split(choices, ',');
    CLI::Validator validator = suggest(choices);
    validator.operation([names](std::string& text) {
        if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
        return fmt::format("is '{}', but it must be one of {}.", text, fmt::join(names, ", "));
    });
    return validator;
}

}  // namespace kerf
