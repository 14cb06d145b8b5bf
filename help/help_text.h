// The answers to --help and -h.
#pragma once

#include <string>
#include <vector>

#include "help/command_help.h"

namespace kerf {

/// At most help_columns wide: usage, what the command does, its options under their headings, the footer.
std::string help_text(const CommandHelp& command);

/// The same with the options of these names (the last ones, without dashes) and help alone, in this order.
std::string short_help_text(CommandHelp command, const std::vector<std::string>& common);

}  // namespace kerf
