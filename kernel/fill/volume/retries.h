// Other ways to call a mesher that has failed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fill/volume/mesher.h"

namespace kerf {

/// One call of a mesher, with the way in which it departs from the options that were asked for.
struct MesherCall {
    std::string fallback;  ///< the change in words, such as "another order of the vertices"; empty for the first call
    MesherOptions options;
    bool cut_first = false;  ///< true: both halves of a cut are filled, and joined
    bool easier = false;     ///< true: the mesher has less to do, so that the call helps against time-outs
};

enum class MesherFailure {
    failed,     ///< gave up, crashed, or returned a mesh that breaks the laws
    timed_out,  ///< ran longer than it may
};

/// Returns all calls in the order in which they are tried: as asked for, then those that the mesher has for failures
/// (Mesher::calls). Deterministic. Throws Error(usage) where no mesher has the name.
std::vector<MesherCall> mesher_calls(const MesherOptions& wanted);

/// Returns the number of the call that is tried after `call` has failed; nothing if all were tried. A mesher that hangs
/// does so while it refines, so a time-out of any call but the first is followed by easier ones only.
std::optional<std::size_t> next_call(const std::vector<MesherCall>& calls, std::size_t call, MesherFailure failure);

}  // namespace kerf
