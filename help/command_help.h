// What a command and its options are called and do, from which help, manual and completion are written.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace kerf {

struct OptionHelp {
    std::vector<std::string> names;    ///< with their dashes, short ones first; of a positional its value name alone
    std::string value;                 ///< stands for the value, as "FILE"; empty for a flag
    std::vector<std::string> choices;  ///< values that it may have, or in a list or beside others; empty: any
    std::string text;
    bool required = false;
    bool repeatable = false;
};

struct OptionGroup {
    std::string name;
    std::vector<OptionHelp> options;
};

struct CommandHelp {
    std::string name;  ///< with that of the program, as "kerf mesh"
    std::string text;  ///< what it does
    std::vector<OptionHelp> positionals;
    std::vector<OptionGroup> groups;
    std::vector<CommandHelp> commands;  ///< their names and texts alone
    std::string footer;                 ///< paragraphs; lines that are indented stay as they are
};

/// The options that are not hidden (of a group without a name), in their order. Choices are those of CLI::IsMember or
/// of suggest(). An option without a name for its value, but with choices, is named by these: "light|dark".
CommandHelp describe(const CLI::App& app);

/// Choices, with commas between, for help and completion of an option that checks its value elsewhere.
CLI::Validator suggest(const std::string& choices);

/// "-o, --output FILE".
std::string heading_of(const OptionHelp& option);

/// Whether what has this value name is a file or a folder.
bool is_path(const std::string& value);

/// "kerf merge [OPTIONS] -o FILE DIR": what has to be given is named.
std::string usage_of(const CommandHelp& command);

}  // namespace kerf
