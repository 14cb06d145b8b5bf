// What is wrong with a command line, and what would be right.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

namespace kerf {

/// The command of this name; null if there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name);

/// What to say of a word that is no command: the file, folder or command that may have been meant.
std::string unknown_command(const CLI::App& app, const std::string& word);

/// One line that says what is wrong, with the command or option that may have been meant, and one with an example or
/// where to read on; without a line end.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

/// What to say where an option is spelled as it was once (help/old_spellings.h); else empty.
std::string old_spelling(const CLI::App& app, int argc, const char* const* argv);

/// Choices as suggest() has them; others are refused.
CLI::Validator one_of(const std::string& choices);

}  // namespace kerf
