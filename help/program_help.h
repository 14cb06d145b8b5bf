// What the programs of Kerf answer when they are asked for help or asked wrongly.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace kerf {

struct Answer {
    int exit_code = 0;  ///< 0: `text` is for standard output, else for standard error
    std::string text;
};

/// To be called before commands are added, which take it over: --help answers with help_text().
void use_help_text(CLI::App& app);

/// Puts the command's --help behind its other options, under this heading. Where there are options that are more common
/// than the others, named without their dashes, -h lists them alone, in this order.
void put_help_last(CLI::App& command, const std::string& group, const std::vector<std::string>& common = {});

/// What to say after parsing has ended with this error: the help or version that was asked for, or what is wrong (exit
/// code 2), with the command or option that may have been meant.
Answer answer_to(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

/// The completion of commands that are other programs', for a shell.
using OtherCompletions = std::function<std::string(const std::string& shell)>;

/// What is answered without a look at the options: who packages Kerf asks for manual and completion (--man COMMAND or
/// --man kerf, --completion SHELL), and an old spelling gets the new one. Nothing for all else. With `others`, the
/// completion is a whole script, else the part of this program's commands. Commands of `app` that are disabled are
/// those of other programs.
std::optional<Answer> answer_before_parsing(const CLI::App& app, int argc, const char* const* argv,
                                            const std::string& version, const OtherCompletions& others = nullptr);

}  // namespace kerf
