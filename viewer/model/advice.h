// The options that a message advises, found in its text so that a button can carry the advice out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/prepare/input.h"
#include "run/request/run_request.h"

namespace kerf::view {

/// Returns all options of a run that a text names as "--name", in the order of the text, each once with the same value.
/// The value is the one that follows the name, "true" for a switch, or empty where the text leaves it to the reader, as
/// "--weld" does.
std::vector<OptionText> advised_options(const std::string& text);

/// Returns the option that a text advises, if it names one alone and that needs no number: a choice with its value, as
/// "--surface remesh", or a switch.
std::optional<OptionText> advised_option(const std::string& text);

/// Returns whether the options have this option with this value.
bool is_set(const RunRequest& options, const OptionText& option);

/// Returns `options` with one of them changed, or nothing if the value does not exist or is out of range.
std::optional<RunRequest> options_with(RunRequest options, const OptionText& option);

/// Returns the list of repairs `plan` (RepairOptions::plan) with those steps of `more` added that it lacks.
std::string with_repairs(const std::string& plan, const std::string& more);

/// Returns the label of a button: "Remesh the surface", "Run with --voids parity", or "Run with --weld" as long as the
/// option has no value. `verb` is the first word of the label.
std::string words_of(const OptionText& advice, const char* verb = "Run");

/// Returns whether the option of this name influences how a file is read.
bool is_input_option(const std::string& option);

/// Returns a value to begin with where a text names none: for --fill-holes the edges of the largest hole, for --weld a
/// distance at which points are as good as equal, for other options twice the value that the run had. Empty if nothing
/// is known. `checked` may be null.
std::string usual_value(const std::string& option, const RunRequest& options, const CheckedSoup* checked);

}  // namespace kerf::view
