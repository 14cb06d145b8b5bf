// What a message advises, so that it can be done by a button.
#pragma once

#include <optional>
#include <string>

#include "run/options.h"

namespace kerf::view {

/// The option that a text advises, if it is one that needs no number: a choice with its value, as "--surface remesh",
/// or a switch. Nothing if the text names several options, or one that is not to be known without asking.
std::optional<OptionText> advised_option(const std::string& text);

/// Whether the options have it.
bool is_set(const RunOptions& options, const OptionText& option);

/// What a button says: "Remesh the surface", or "Run with --voids parity".
std::string words_of(const OptionText& advice);

}  // namespace kerf::view
