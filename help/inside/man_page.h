// Manual pages.
#pragma once

#include <string>

#include "help/command_help.h"

namespace kerf {

/// Returns the page of a command in the man macros of roff, section 1. It has no date, so that the same version has the
/// same page.
std::string man_page(const CommandHelp& command, const std::string& version);

}  // namespace kerf
