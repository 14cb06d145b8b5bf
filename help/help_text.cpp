#include "help/help_text.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace kerf {

namespace {

constexpr std::size_t help_columns = 80, text_column = 24;

std::string wrapped_line(std::string_view line, std::size_t indent) {
    const std::string next_line = "\n" + std::string(indent, ' ');
    std::string text;
    std::size_t used = 0;
    while (!line.empty()) {
        const std::string_view word = line.substr(0, line.find(' '));
        line.remove_prefix(std::min(line.size(), word.size() + 1));
        if (used > 0 && indent + used + 1 + word.size() > help_columns) {
            text += next_line;
            used = 0;
        }
        if (used > 0) text += ' ';
        text += word;
        used += word.size() + (used > 0 ? 1 : 0);
    }
    return text;
}

// Returns `text` broken at spaces so that no line, with `indent` spaces before it, is longer than help_columns; a word
// that is longer alone stays whole. Newlines stay, and lines that begin with a space are not broken. The first line
// has no indent, the last one no newline.
std::string wrapped(std::string_view text, std::size_t indent) {
    std::string result;
    for (bool first = true; first || !text.empty(); first = false) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (!first) result += "\n" + std::string(line.empty() ? 0 : indent, ' ');
        result += line.starts_with(' ') ? std::string(line) : wrapped_line(line, indent);
    }
    return result;
}

// An entry of the help. Its text stands beside its heading, or below a long one.
std::string entry(const std::string& heading, const std::string& text) {
    const std::string gap(text_column, ' ');
    std::string line = "  " + heading;
    if (line.size() + 2 > text_column)
        line += "\n" + gap;
    else
        line.resize(text_column, ' ');
    return line + wrapped(text, text_column) + "\n";
}

std::string section(const std::string& name, const std::vector<OptionHelp>& options) {
    std::string text = "\n" + name + ":\n";
    for (const OptionHelp& option : options) text += entry(heading_of(option), option.text);
    return text;
}

}  // namespace

std::string short_help_text(CommandHelp command, const std::vector<std::string>& common) {
    OptionGroup chosen = {"Options", {}};
    std::vector<std::string> wanted = common;
    wanted.insert(wanted.end(), {"h", "help"});
    std::size_t all = 0;
    for (const OptionGroup& group : command.groups) all += group.options.size();
    for (const std::string& name : wanted)
        for (const OptionGroup& group : command.groups)
            for (const OptionHelp& option : group.options)
                if (option.names.back() == (name.size() == 1 ? "-" : "--") + name) chosen.options.push_back(option);
    command.groups = {chosen};
    command.footer = fmt::format("{} --help lists all {} options.", command.name, all);
    return help_text(command);
}

std::string help_text(const CommandHelp& command) {
    std::string text = "Usage: " + wrapped(usage_of(command), 7) + "\n" + wrapped(command.text, 0) + "\n";
    if (!command.positionals.empty()) text += section("Arguments", command.positionals);
    for (const OptionGroup& group : command.groups) text += section(group.name, group.options);
    if (!command.commands.empty()) text += "\nCommands:\n";
    for (const CommandHelp& one : command.commands) text += entry(one.name, one.text);
    if (!command.footer.empty()) text += "\n" + wrapped(command.footer, 0) + "\n";
    return text;
}

}  // namespace kerf
