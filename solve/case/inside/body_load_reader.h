// The tables of a case file for whole bodies (gravity, rotation, temperature) and for combinations of cases.
#pragma once

#include "solve/case/elastic_case.h"
#include "solve/case/inside/case_table.h"

namespace kerf {

/// Each reads one table of the case file `path`. Throws Error(usage).
Gravity read_gravity(const std::string& path, const toml::table& values);
Rotation read_rotation(const std::string& path, const toml::table& values);
Temperature read_temperature(const std::string& path, const toml::table& values);
/// Reads one [[combination]]. `cases`: the names of all cases; `others`: the combinations before it. Throws
/// Error(usage).
Combination read_combination(const std::string& path, const toml::table& values, const std::vector<std::string>& cases,
                             const std::vector<Combination>& others);

}  // namespace kerf
