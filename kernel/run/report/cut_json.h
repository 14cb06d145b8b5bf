// A cut in the report, both ways.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cut/cut/cut.h"

namespace kerf {

/// Returns the object that the report has of each cut.
nlohmann::ordered_json json_of_cut(const CutSummary& cut);

/// Returns the cut of such an object. Numbers that were not finite are null there, and -1 here. Throws nlohmann's
/// exceptions, and Error(input) for names that it does not know.
CutSummary cut_of_json(const nlohmann::json& json);

}  // namespace kerf
