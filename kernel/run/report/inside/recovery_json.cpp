#include "run/report/inside/recovery_json.h"

#include <nlohmann/json.hpp>

namespace kerf {

nlohmann::ordered_json json_of_recovery(const FacetRecoveryCounts& recovery) {
    return {{"missing", recovery.missing},
            {"by_flips", recovery.by_flips},
            {"split", recovery.split},
            {"added_vertices", recovery.added_vertices}};
}

}  // namespace kerf
