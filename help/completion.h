// Scripts by which a shell completes commands, options, their values, and files.
#pragma once

#include <array>
#include <string>

#include "help/command_help.h"

namespace kerf {

inline constexpr std::array<const char*, 3> shells = {"bash", "fish", "zsh"};

/// The part of the script of `shell` that knows one command. Programs beside kerf write those of their own commands.
std::string command_completion(const CommandHelp& command, const std::string& shell);

/// The whole script: what `program`, with the list of all commands, does itself, and the parts of these commands.
std::string completion_script(const CommandHelp& program, const std::string& parts, const std::string& shell);

}  // namespace kerf
