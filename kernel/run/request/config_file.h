// Options in a file, as --print-config writes and --config reads them.
#pragma once

#include <string>
#include <vector>

#include "run/request/run_request.h"

namespace kerf {

/// Returns options as TOML: a line for each option, numbers with all their digits, after the line of comment that is
/// its help. Options without a value, and K where the run chooses it, are comments. Paths that are not UTF-8 are as
/// path_text() has them.
std::string to_config(const std::vector<OptionField>& fields);

/// An option of a config file.
struct ConfigEntry : OptionText {
    std::string place;  ///< "kerf.toml, line 3"
};

/// Returns the options of a config file, in its order. Throws Error(io) for a file that cannot be read, Error(usage),
/// naming file and line, for one that is not TOML or has anything but values.
std::vector<ConfigEntry> read_config(const std::string& path);

/// Sets the field that the entry names. Throws Error(usage), naming file and line, for a name that no field has, and
/// for a text that is no value of the field.
void set_option(const std::vector<OptionField>& fields, const ConfigEntry& entry);

}  // namespace kerf
