// Completion scripts for bash, fish and zsh. kerf knows the options of its own commands alone, so that a script is put
// together from parts: each program beside kerf prints the parts of its commands, and kerf adds the function that
// chooses between them by the word behind "kerf". In bash the parts fill two maps, words by command and values by
// command and option; the value "/" means a file and "*" anything else. In zsh a part is a function _kerf_COMMAND for
// _arguments, in fish lines of complete. Texts are in single quotes, whose escape differs from shell to shell
// (quoted()); brackets and colons are special in zsh.
#include "help/inside/completion.h"

#include <fmt/format.h>

namespace kerf {

namespace {

// The text in single quotes; characters of `special` get a backslash before them, and a quote becomes `quote`.
std::string quoted(const std::string& text, const std::string& special, const std::string& quote) {
    std::string result = "'";
    for (const char c : text) {
        if (special.find(c) != special.npos) result += '\\';
        result += c == '\'' ? quote : std::string(1, c);
    }
    return result + "'";
}

std::string last_word(const std::string& text) { return text.substr(text.rfind(' ') + 1); }

// Marks of the bash script for a value that may be anything but a file, and for a file.
constexpr const char* free_value = "*";
constexpr const char* path_value = "/";

std::string bash_values(const OptionHelp& option) {
    if (!option.choices.empty()) return fmt::format("{}", fmt::join(option.choices, " "));
    return is_path(option.value) ? path_value : free_value;
}

std::string bash_part(const CommandHelp& command) {
    std::string words, values;
    for (const OptionGroup& group : command.groups)
        for (const OptionHelp& option : group.options)
            for (const std::string& name : option.names) {
                words += (words.empty() ? "" : " ") + name;
                if (!option.value.empty())
                    values += fmt::format("_kerf_values['{} {}']='{}'\n", command.name, name, bash_values(option));
            }
    for (const CommandHelp& one : command.commands) words += " " + one.name;
    return fmt::format("_kerf_words['{}']='{}'\n{}", command.name, words, values);
}

// The function of bash, which takes --cut=in for three words.
constexpr const char* bash_function = R"script(
_kerf() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=kerf
    if [[ $current == = ]]; then
        current=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    if ((COMP_CWORD > 1)); then command="kerf ${COMP_WORDS[1]}"; fi
    local values=${_kerf_values[$command $before]}
    COMPREPLY=()
    if [[ -z $values ]] && [[ $current == -* || $command == kerf ]]; then values=${_kerf_words[$command]}; fi
    case $values in
        '*') ;;
        '' | /)
            compopt -o filenames 2> /dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$current")
            ;;
        *) mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current") ;;
    esac
}
complete -F _kerf kerf
)script";

std::string zsh_value(const OptionHelp& option) {
    if (option.value.empty()) return "";
    if (!option.choices.empty()) return fmt::format(":value:({})", fmt::join(option.choices, " "));
    return is_path(option.value) ? ":file:_files" : ":value: ";
}

std::string zsh_part(const CommandHelp& command) {
    std::string specs;
    for (const OptionGroup& group : command.groups)
        for (const OptionHelp& option : group.options)
            for (const std::string& name : option.names) {
                const std::string others = option.repeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
                const std::string text = quoted("[" + option.text, "]:\\", "'\\''");
                specs += fmt::format(" \\\n        '{}'{}{}']{}'", others, name, text, zsh_value(option));
            }
    return fmt::format("_kerf_{}() {{\n    _arguments{} \\\n        '*:file:_files'\n}}\n", last_word(command.name),
                       specs);
}

std::string zsh_function(const CommandHelp& program) {
    std::string commands, options;
    for (const CommandHelp& one : program.commands)
        commands += "\n            " + quoted(one.name + ":" + one.text, "", "'\\''");
    for (const OptionGroup& group : program.groups)
        for (const OptionHelp& option : group.options) options += " " + option.names.back();
    return fmt::format(R"script(_kerf() {{
    if ((CURRENT == 2)); then
        local -a commands=({}
        )
        _describe command commands
        compadd -- {}
        return
    fi
    local command=$words[2]
    shift words
    ((CURRENT--))
    if (($+functions[_kerf_$command])); then _kerf_$command; fi
}}
if [[ $funcstack[1] == _kerf ]]; then _kerf "$@"; else compdef _kerf kerf; fi
)script",
                       commands, options);
}

std::string fish_value(const OptionHelp& option) {
    if (option.value.empty()) return "";
    if (!option.choices.empty()) return fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
    return is_path(option.value) ? " -r -F" : " -x";
}

std::string fish_line(const std::string& condition, const OptionHelp& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    return fmt::format("complete -c kerf -n '{}'{}{} -d {}\n", condition, names, fish_value(option),
                       quoted(option.text, "\\", "\\'"));
}

std::string fish_part(const CommandHelp& command) {
    std::string lines;
    for (const OptionGroup& group : command.groups)
        for (const OptionHelp& option : group.options)
            lines += fish_line("__fish_seen_subcommand_from " + last_word(command.name), option);
    return lines;
}

std::string fish_commands(const CommandHelp& program) {
    std::string lines;
    for (const OptionGroup& group : program.groups)
        for (const OptionHelp& option : group.options) lines += fish_line("__fish_use_subcommand", option);
    for (const CommandHelp& one : program.commands)
        lines += fmt::format("complete -c kerf -n __fish_use_subcommand -f -a {} -d {}\n", one.name,
                             quoted(one.text, "\\", "\\'"));
    return lines;
}

}  // namespace

std::string command_completion(const CommandHelp& command, const std::string& shell) {
    return shell == "bash" ? bash_part(command) : shell == "zsh" ? zsh_part(command) : fish_part(command);
}

std::string completion_script(const CommandHelp& program, const std::string& parts, const std::string& shell) {
    if (shell == "bash")
        return "# Completion of kerf for bash.\ndeclare -gA _kerf_words _kerf_values\n" + bash_part(program) + parts +
               bash_function;
    if (shell == "zsh") return "#compdef kerf\n" + parts + zsh_function(program);
    return "# Completion of kerf for fish.\n" + fish_commands(program) + parts;
}

}  // namespace kerf
