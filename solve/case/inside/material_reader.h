// The materials of a case file.
#pragma once

#include "solve/case/elastic_case.h"
#include "solve/case/inside/case_table.h"

namespace kerf {

/// Reads all [material.NAME] of the file `path`, in the order of names. A material that is `like` another takes its
/// numbers from the table of materials, and so does one that has no numbers and a name of the table. Throws
/// Error(usage).
std::vector<MaterialUse> read_materials(const std::string& path, const toml::node& node, CaseUnits units);

}  // namespace kerf
