#include "fill/volume/retries.h"

#include "base/core/check.h"
#include "fill/volume/meshers.h"

namespace kerf {

std::vector<MesherCall> mesher_calls(const MesherOptions& wanted) { return find_mesher(wanted.name).calls(wanted); }

std::optional<std::size_t> next_call(const std::vector<MesherCall>& calls, std::size_t call, MesherFailure failure) {
    KERF_CHECK(call < calls.size());
    const bool any = failure == MesherFailure::failed || call == 0;
    for (std::size_t next = call + 1; next < calls.size(); ++next)
        if (any || calls[next].easier) return next;
    return std::nullopt;
}

}  // namespace kerf
