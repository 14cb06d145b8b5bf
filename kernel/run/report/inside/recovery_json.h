// The way of a part through its mesher in reports and events.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/work/part_queue.h"

namespace kerf {

/// Returns {"missing", "by_flips", "split", "added_vertices"}.
nlohmann::ordered_json json_of_recovery(const FacetRecoveryCounts& recovery);

/// Adds the fallback and the way of a part, and the counts of its core and its facets, but for those that it has not.
void add_way(const PartOutcome& part, nlohmann::ordered_json& json);

}  // namespace kerf
