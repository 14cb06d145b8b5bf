// The answers of Kerf's programs to a request for help or a wrong command line.
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

/// Makes --help answer with help_text(). Call it before commands are added, which take it over.
void use_help_text(CLI::App& app);

/// Puts the command's --help behind its other options, under this heading. If some options are more `common` than the
/// others, named without their dashes, -h lists them alone, in this order.
void put_help_last(CLI::App& command, const std::string& group, const std::vector<std::string>& common = {});

/// Returns the answer after parsing has ended with this error: the help or version that was asked for, or the mistake
/// (exit code 2), with the command or option that may have been meant.
Answer answer_to(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

/// A function that returns the completion of the commands of other programs for a shell.
using OtherCompletions = std::function<std::string(const std::string& shell)>;

/// Returns the answers that need no parsing, or nothing: the manual and the completion, for those who package Kerf
/// (--man COMMAND or --man kerf, --completion SHELL), and the new spelling of an old option. With `others`, the
/// completion is a whole script, else the part of this program's commands. Commands of `app` that are disabled are
/// those of other programs.
std::optional<Answer> answer_before_parsing(const CLI::App& app, int argc, const char* const* argv,
                                            const std::string& version, const OtherCompletions& others = nullptr);

}  // namespace kerf
