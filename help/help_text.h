// The answers to --help and -h.
#pragma once

#include <string>
#include <vector>

#include "help/command_help.h"

namespace kerf {

/// Returns the help of a command, at most 80 columns wide: usage, description, options under their headings, the
/// footer.
std::string help_text(const CommandHelp& command);

/// Returns the help with the options of these names alone (the last of their names, without dashes) and that of help,
/// in this order.
std::string short_help_text(CommandHelp command, const std::vector<std::string>& common);

}  // namespace kerf
