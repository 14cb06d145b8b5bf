// The viewer's commands, which are a program of their own: kerf links no window library.
#pragma once

#include <string>

namespace kerf {

inline constexpr const char* viewer_commands[] = {"view", "screenshot"};

/// Whether a command is the viewer's.
bool is_viewer_command(const std::string& command);

/// Replaces this program by kerf-view, which lies beside it, with the same arguments. Throws Error(usage), saying how
/// to build it, if it is not there. `argv` ends with a null pointer.
[[noreturn]] void become_viewer(char** argv);

}  // namespace kerf
