// Repairs in JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "prepare/remedy.h"
#include "prepare/repaired_file.h"
#include "repair/repair_report.h"

namespace kerf {

/// {"bound", "diagonal", "largest_move", "steps": [{"step", "largest_move", "actions": [{"what", "count", "done",
/// "refused_because", "measure", "places": [{"where", "facets", "value"}]}]}]}. "measure" says what "value" is, both
/// are there if it is; "refused_because" is there of what is not done.
nlohmann::ordered_json json_of_repair(const RepairReport& report);
std::string to_json(const RepairReport& report);

/// {"repair": words of --repair or null, "tried", "largest_move", "wrap_distance", "voids": "parity" or null, "caps",
/// "losses": lines, "command"}.
nlohmann::ordered_json json_of_remedy(const Remedy& remedy, const std::string& path);

/// What repair_file() did, what was measured, and what is left.
std::string to_json(const RepairedFile& repaired);

}  // namespace kerf
