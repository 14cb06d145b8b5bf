// The table of options as flags of a command.
#pragma once

#include "request/options.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace kerf {

/// Adds --NAME, and -N where it has a short name. Values go through OptionField::set_text(), as those of config files
/// do.
CLI::Option* add_option_field(CLI::App& app, const OptionField& field);

/// Adds input_option_fields() of a command that has no others. `options` learns whether --unit was given, too.
void add_input_options(CLI::App& app, InputOptions& options);

/// Has `options` learn whether --unit, which the command has by now, is given.
void heed_unit(CLI::App& app, InputOptions& options);

/// Adds all that shapes a mesh and how it is made (option_fields()), and --tetgen, another name of --tetgen-switches.
void add_run_options(CLI::App& app, RunOptions& options);

/// Names of all formats, and of the qualities that vtu files may have, as values that are suggested.
CLI::Validator suggest_formats();
CLI::Validator suggest_cell_fields();

}  // namespace kerf
