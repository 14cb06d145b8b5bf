// Other ways to call a mesher that has failed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "volume/mesher.h"

namespace kerf {

/// One call of a mesher, and in which way it departs from what was asked for.
struct MesherCall {
    std::string fallback;  ///< "another order of the vertices"; empty for the first call
    MesherOptions options;
    bool cut_first = false;  ///< fill both halves of a cut, and join them
    bool easier = false;     ///< gives the mesher less to do, so that it helps against time-outs
};

enum class MesherFailure {
    failed,     ///< gave up, crashed, or returned a mesh that breaks the laws
    timed_out,  ///< ran longer than it may
};

/// All calls in the order in which they are tried: as asked for, then what the mesher has for failures
/// (Mesher::calls). Deterministic. Throws Error(usage) where no mesher has the name.
std::vector<MesherCall> mesher_calls(const MesherOptions& wanted);

/// The number of the call after `call` has failed. What hangs does so while it refines: after one other call only the
/// easier ones follow. Nothing if all has been tried.
std::optional<std::size_t> next_call(const std::vector<MesherCall>& calls, std::size_t call, MesherFailure failure);

}  // namespace kerf
