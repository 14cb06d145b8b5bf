// Messages about a wrong command line, with a right one.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

namespace kerf {

/// Returns the command of this name; null if there is none.
const CLI::App* find_command(const CLI::App& app, const std::string& name);

/// Returns the message about a word that is no command, with the file, folder or command that may have been meant.
std::string unknown_command(const CLI::App& app, const std::string& word);

/// Returns a line that tells the mistake, with the command or option that may have been meant, and a line with an
/// example or the place to read on; without a line end.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

/// Returns the message about an option of an old spelling (help/inside/old_spellings.h); empty if there is none.
std::string old_spelling(const CLI::App& app, int argc, const char* const* argv);

/// Returns a validator of choices as suggest() has them, which refuses other values.
CLI::Validator one_of(const std::string& choices);

}  // namespace kerf
