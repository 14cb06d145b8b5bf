#include "help/command_help.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace kerf {

namespace {

// The parts of "LIST:{a,b}" or "N:INT in [1 - 4]", as CLI11 has the name of a value with its check appended.
struct TypeText {
    std::string value;
    std::vector<std::string> choices;
};

TypeText read_type(const std::string& text) {
    std::size_t end = text.size();
    for (const char* check : {":{", ":INT", ":FLOAT", ":POSITIVE"}) end = std::min(end, text.find(check));
    TypeText type = {text.substr(0, end), {}};
    const std::size_t open = text.find(":{"), close = text.find('}', open == text.npos ? 0 : open);
    if (open != text.npos && close != text.npos)
        for (std::string choice : CLI::detail::split(text.substr(open + 2, close - open - 2), ','))
            type.choices.push_back(CLI::detail::trim(choice));
    if (type.value.empty()) type.value = fmt::format("{}", fmt::join(type.choices, "|"));
    return type;
}

OptionHelp describe_option(const CLI::Option& option) {
    OptionHelp help;
    const TypeText type = option.get_type_size() == 0 ? TypeText() : read_type(option.get_type_name());
    if (option.get_positional()) {
        help.names = {type.value};
    } else {
        for (const std::string& name : option.get_snames()) help.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
        help.value = type.value;
    }
    help.choices = type.choices;
    help.text = option.get_description();
    help.required = option.get_required();
    help.repeatable = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    return help;
}

std::string full_name(const CLI::App& app) {
    const std::string& own = app.get_name();
    return app.get_parent() ? full_name(*app.get_parent()) + " " + own : own;
}

}  // namespace

CommandHelp describe(const CLI::App& app) {
    CommandHelp help;
    help.name = full_name(app);
    help.text = app.get_description();
    for (const std::string& name : app.get_groups()) {
        if (name.empty()) continue;
        OptionGroup group = {name, {}};
        for (const CLI::Option* option : app.get_options([&](const CLI::Option* o) { return o->get_group() == name; }))
            (option->get_positional() ? help.positionals : group.options).push_back(describe_option(*option));
        if (!group.options.empty()) help.groups.push_back(std::move(group));
    }
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        CommandHelp& one = help.commands.emplace_back();
        one.name = command->get_name();
        one.text = command->get_description();
    }
    help.footer = app.get_footer();
    return help;
}

CLI::Validator suggest(const std::string& choices) { return CLI::Validator("{" + choices + "}"); }

std::string heading_of(const OptionHelp& option) {
    const std::string names = fmt::format("{}", fmt::join(option.names, ", "));
    return option.value.empty() ? names : names + " " + option.value;
}

bool is_path(const std::string& value) {
    for (const std::string& kind : CLI::detail::split(value, '|'))
        if (kind == "FILE" || kind == "DIR" || kind == "OUT" || kind == "INPUT" || kind == "OTHER") return true;
    return false;
}

std::string usage_of(const CommandHelp& command) {
    std::string usage = command.name + " [OPTIONS]";
    for (const OptionGroup& group : command.groups)
        for (const OptionHelp& option : group.options)
            if (option.required) usage += fmt::format(" {} {}", option.names.front(), option.value);
    for (const OptionHelp& positional : command.positionals) {
        const std::string& name = positional.names.front();
        usage += positional.required ? " " + name : " [" + name + "]";
    }
    return command.commands.empty() ? usage : usage + " COMMAND";
}

}  // namespace kerf
