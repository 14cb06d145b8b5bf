// The answer to --help.
#pragma once

#include <string>

#include "help/command_help.h"

namespace kerf {

/// At most help_columns wide: usage, what the command does, its options under their headings, the footer.
std::string help_text(const CommandHelp& command);

}  // namespace kerf
