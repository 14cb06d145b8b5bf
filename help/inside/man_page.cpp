#include "help/inside/man_page.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace kerf {

namespace {

// The text in roff's spelling: backslashes and dashes show as they are, and no line begins with a request.
std::string roff(const std::string& text) {
    std::string result;
    bool at_start = true;
    for (const char c : text) {
        if (at_start && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
        at_start = c == '\n';
    }
    return result;
}

std::string page_name(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

// The text as paragraphs; lines that are indented stay as they are.
std::string paragraphs(const std::string& text) {
    std::string result;
    for (const std::string& line : CLI::detail::split(text, '\n'))
        result += line.starts_with(' ') ? ".br\n" + roff(line) + "\n" : ".PP\n" + roff(line) + "\n";
    return result;
}

std::string tagged(const std::string& heading, const std::string& text) {
    return ".TP\n.B " + roff(heading) + "\n" + roff(text) + "\n";
}

std::string options_of(const std::vector<OptionHelp>& options) {
    std::string text;
    for (const OptionHelp& option : options) {
        text += tagged(heading_of(option), option.text);
        const bool are_in_heading = option.value == fmt::format("{}", fmt::join(option.choices, "|"));
        const std::string choices = fmt::format("{}", fmt::join(option.choices, ", "));
        if (!option.choices.empty() && !are_in_heading) text += ".br\n" + roff("Values: " + choices + ".") + "\n";
    }
    return text;
}

}  // namespace

std::string man_page(const CommandHelp& command, const std::string& version) {
    const std::string name = page_name(command.name);
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string first_line = command.text.substr(0, command.text.find('\n'));
    if (first_line.ends_with('.')) first_line.pop_back();
    std::string page = fmt::format(".TH {} 1 \"\" \"Kerf {}\" \"Kerf\"\n", roff(title), version);
    page += fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(first_line));
    page += fmt::format(".SH SYNOPSIS\n.B {}\n", roff(usage_of(command)));
    page += ".SH DESCRIPTION\n" + paragraphs(command.text).substr(4);
    if (!command.positionals.empty()) page += ".SH ARGUMENTS\n" + options_of(command.positionals);
    page += ".SH OPTIONS\n";
    for (const OptionGroup& group : command.groups)
        page += (command.groups.size() > 1 ? ".SS " + roff(group.name) + "\n" : "") + options_of(group.options);
    if (!command.commands.empty()) page += ".SH COMMANDS\n";
    for (const CommandHelp& one : command.commands) page += tagged(one.name, one.text);
    if (!command.footer.empty()) page += ".SH NOTES\n" + paragraphs(command.footer).substr(4);
    page += ".SH SEE ALSO\n";
    if (command.commands.empty()) return page + ".BR kerf (1)\n";
    for (const CommandHelp& one : command.commands)
        page += fmt::format(".BR {} (1){}\n", roff(page_name(command.name + " " + one.name)),
                            &one == &command.commands.back() ? "" : ",");
    return page;
}

}  // namespace kerf
