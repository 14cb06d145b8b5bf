// Other ways to call a mesher that has failed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "volume/mesher.h"

namespace kerf {

/// One call of the mesher, and in which way it departs from what was asked for.
struct MesherCall {
    std::string remedy;  ///< "another order of the vertices"; empty for the first call
    MesherOptions options;
    std::uint32_t vertex_order_seed = 0;
    bool cut_first = false;  ///< fill both halves of a cut, and join them
    bool easier = false;     ///< gives the mesher less to do, so that it helps against time-outs
};

enum class MesherFailure {
    failed,     ///< gave up, crashed, or returned a mesh that breaks the laws
    timed_out,  ///< ran longer than it may
};

/// All calls in the order in which they are tried: as asked for, two other orders of the vertices, other tolerances, a
/// weaker bound of the shape, no bound of the shape, the part cut in two, eight times the wanted volume. With the
/// expert's switches only the order of the vertices changes, and the part is cut in two. Deterministic.
std::vector<MesherCall> mesher_calls(const MesherOptions& wanted);

/// The number of the call after `call` has failed. What hangs does so while it refines: after one other order only the
/// easier calls follow. Nothing if all has been tried.
std::optional<std::size_t> next_call(const std::vector<MesherCall>& calls, std::size_t call, MesherFailure failure);

}  // namespace kerf
