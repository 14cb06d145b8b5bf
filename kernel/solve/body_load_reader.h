// What a case file says of whole bodies: gravity, rotation, temperature; and combinations of cases.
#pragma once

#include "solve/case_table.h"
#include "solve/elastic_case.h"

namespace kerf {

/// A table, or several in two brackets, of the file `path`. Throws Error(usage).
Gravity read_gravity(const std::string& path, const toml::table& values);
Rotation read_rotation(const std::string& path, const toml::table& values);
Temperature read_temperature(const std::string& path, const toml::table& values);
/// `cases`: names of those that there are.
Combination read_combination(const std::string& path, const toml::table& values, const std::vector<std::string>& cases,
                             const std::vector<Combination>& others);

}  // namespace kerf
