// The commands that kerf runs itself. Each has a file, which adds its options to the command line and runs it.
#pragma once

namespace CLI {
class App;
}

namespace kerf {

/// Adds a command to kerf. A parsed command line that asks for the command runs it and sets `exit_code`; it throws
/// CLI::ParseError for options that do not go together, and Error.
using AddCommand = void(CLI::App& kerf, int& exit_code);

AddCommand add_check_command, add_decompose_command, add_export_command, add_help_command, add_merge_command,
    add_mesh_command, add_quality_command, add_remesh_command, add_repair_command, add_report_command,
    add_verify_command, add_wrap_command;

/// The functions that add these commands, in the order of the help.
inline constexpr AddCommand* own_commands[] = {
    add_mesh_command,   add_decompose_command, add_check_command,   add_verify_command,
    add_export_command, add_merge_command,     add_quality_command, add_report_command,
    add_repair_command, add_remesh_command,    add_wrap_command,    add_help_command,
};

}  // namespace kerf
