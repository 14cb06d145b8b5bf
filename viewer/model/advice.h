// What a message advises, so that it can be done by a button.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prepare/input.h"
#include "request/options.h"

namespace kerf::view {

/// All options of a run that a text names as "--name", each once, in this order: with the value that follows, "true" of
/// a switch, or an empty text where the value is left to the reader: "--weld".
std::vector<OptionText> advised_options(const std::string& text);

/// The option that a text advises, if it names one alone, and that needs no number: a choice with its value, as
/// "--surface remesh", or a switch.
std::optional<OptionText> advised_option(const std::string& text);

/// Whether the options have it.
bool is_set(const RunOptions& options, const OptionText& option);

/// `options` with one of them changed; nothing if it has no such value, or one out of its range.
std::optional<RunOptions> options_with(RunOptions options, const OptionText& option);

/// A list of InputOptions::repair with what is missing in it of another one.
std::string with_repairs(const std::string& plan, const std::string& more);

/// What a button says: "Remesh the surface", "Run with --voids parity", or "Run with --weld" as long as it has no
/// value. `verb`: what it does with the option.
std::string words_of(const OptionText& advice, const char* verb = "Run");

/// Whether an option, by its name, has a say in how a file is read.
bool is_input_option(const std::string& option);

/// A value to begin with where a text names none: what would fill the largest hole, weld what is as good as equal, or
/// give a run twice as much as it had. Empty if nothing is known. `checked` may be null.
std::string usual_value(const std::string& option, const RunOptions& options, const CheckedSoup* checked);

}  // namespace kerf::view
