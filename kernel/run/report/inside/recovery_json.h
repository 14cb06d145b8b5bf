// The recovery of facets in reports and events.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/work/part_job.h"

namespace kerf {

/// Returns {"missing", "by_flips", "split", "added_vertices"}.
nlohmann::ordered_json json_of_recovery(const FacetRecoveryCounts& recovery);

}  // namespace kerf
