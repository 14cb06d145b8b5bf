// The names and texts of a command and its options, from which help, manual and completion are written.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace kerf {

struct OptionHelp {
    std::vector<std::string>
        names;          ///< names with their dashes, short ones first; of a positional the name of its value alone
    std::string value;  ///< name of the value, as "FILE"; empty for a flag
    std::vector<std::string> choices;  ///< values that it may have, alone, in a list or beside others; empty: any
    std::string text;
    bool required = false;
    bool repeatable = false;
};

struct OptionGroup {
    std::string name;
    std::vector<OptionHelp> options;
};

struct CommandHelp {
    std::string name;  ///< name with that of the program, as "kerf mesh"
    std::string text;  ///< description of the command
    std::vector<OptionHelp> positionals;
    std::vector<OptionGroup> groups;
    std::vector<CommandHelp> commands;  ///< commands of a program, with names and texts alone
    std::string footer;                 ///< paragraphs behind the options; lines that are indented stay as they are
};

/// Returns the texts of a command with its options that are not hidden (of a group without a name), in their order.
/// Choices are those of CLI::IsMember or of suggest(). An option without a name for its value, but with choices, is
/// named by these: "light|dark".
CommandHelp describe(const CLI::App& app);

/// Returns choices, given with commas between, for help and completion of an option that checks its value elsewhere.
CLI::Validator suggest(const std::string& choices);

/// Returns "-o, --output FILE".
std::string heading_of(const OptionHelp& option);

/// Returns whether a value of this name is a file or a folder.
bool is_path(const std::string& value);

/// Returns "kerf merge [OPTIONS] -o FILE DIR", with all options and arguments that are required.
std::string usage_of(const CommandHelp& command);

}  // namespace kerf
