#include "run/report/inside/recovery_json.h"

#include <nlohmann/json.hpp>

namespace kerf {

nlohmann::ordered_json json_of_recovery(const FacetRecoveryCounts& recovery) {
    return {{"missing", recovery.missing},
            {"by_flips", recovery.by_flips},
            {"split", recovery.split},
            {"added_vertices", recovery.added_vertices}};
}

void add_way(const PartOutcome& part, nlohmann::ordered_json& json) {
    if (!part.fallback.empty()) json["remedy"] = part.fallback;
    if (!part.result.strategy.empty()) json["way"] = part.result.strategy;
    if (!part.result.reason.empty()) json["reason"] = part.result.reason;
    if (part.result.core_tets) json["core_tets"] = part.result.core_tets;
    if (part.result.recovery.missing) json["recovery"] = json_of_recovery(part.result.recovery);
}

}  // namespace kerf
