// Repairs in JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "run/prepare/remedy.h"
#include "run/prepare/repaired_file.h"
#include "surface/repair/repair_report.h"

namespace kerf {

/// {"bound", "diagonal", "largest_move", "steps": [{"step", "largest_move", "actions": [{"what", "count", "done",
/// "refused_because", "measure", "places": [{"where", "facets", "value"}]}]}]}. "measure" names the quantity in
/// "value", and both are left out together; "refused_because" is there for actions that were not done.
nlohmann::ordered_json json_of_repair(const RepairReport& report);
std::string to_json(const RepairReport& report);

/// {"vertices_welded", "vertices_unused", "facets_dropped", "vertices_merged", "facets_removed", "holes_filled",
/// "facets_added"}: the sums of all that comes before the steps of json_of_repair().
nlohmann::ordered_json json_of_counts(const TidyCounts& tidied, const RepairReport& ladder);

/// {"repair": words of --repair or null, "tried", "largest_move", "wrap_distance", "voids": "parity" or null, "caps",
/// "losses": lines, "command"}.
nlohmann::ordered_json json_of_remedy(const Remedy& remedy, const std::string& path);

/// Returns the result of repair_file(): its steps, the measures before and after, and the defects that are left.
std::string to_json(const RepairedFile& repaired);

}  // namespace kerf
