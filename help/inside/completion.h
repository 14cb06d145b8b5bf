// Scripts by which a shell completes commands, options, their values, and files.
#pragma once

#include <array>
#include <string>

#include "help/command_help.h"

namespace kerf {

inline constexpr std::array<const char*, 3> shells = {"bash", "fish", "zsh"};

/// Returns the part of the script of `shell` that knows one command. Programs beside kerf write those of their own
/// commands.
std::string command_completion(const CommandHelp& command, const std::string& shell);

/// Returns the whole script: the completion of `program` with its list of all commands, and the parts of these
/// commands.
std::string completion_script(const CommandHelp& program, const std::string& parts, const std::string& shell);

}  // namespace kerf
