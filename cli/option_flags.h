// The options of the kernel's table as flags of a command.
#pragma once

#include "run/request/run_request.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace kerf {

/// Adds --NAME, and -N where the option has a short name. Values go through OptionField::set_text(), as those of config
/// files do.
CLI::Option* add_option_field(CLI::App& app, const OptionField& field);

/// Adds input_option_fields() to a command that has no other options of the table. `options` learns whether --unit was
/// given, too.
void add_input_options(CLI::App& app, InputOptions& options);

/// Makes `options` learn whether --unit is given, an option that the command has to have already.
void heed_unit(CLI::App& app, InputOptions& options);

/// Adds -o to a command that writes a surface.
void add_surface_output(CLI::App& app, std::string& output);

/// Adds all options that shape a mesh and its making (option_fields()), and --tetgen, another name of
/// --tetgen-switches.
void add_run_options(CLI::App& app, RunRequest& options);

/// Returns the names of all formats, or of the qualities that vtu files may have, as suggested values.
CLI::Validator suggest_formats();
CLI::Validator suggest_cell_fields();

}  // namespace kerf
