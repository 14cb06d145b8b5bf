#include "run/run/cut_stage.h"

#include <algorithm>
#include <optional>

#include "base/core/host_name.h"
#include "cut/decompose/straight_division.h"
#include "run/prepare/gathered_nodes.h"
#include "run/run/inside/cuts_on_ranks.h"
#include "run/run/inside/range_of_rank.h"
#include "run/run/trace.h"

namespace kerf {

namespace {

// Divides parts without a contour of edges by straight cuts. These need all other parts beside them, because facets
// that are split may be theirs, too.
Decomposition divide_unfinished(Communicator& ranks, Decomposition own, const DecomposeOptions& options,
                                CutListener* cuts) {
    const auto is_unfinished = [](const Leaf& leaf) { return leaf.leaves > 1; };
    const char any_own = std::any_of(own.leaves.begin(), own.leaves.end(), is_unfinished);
    const std::vector<char> any_of_rank = all_gather(ranks, any_own);
    if (std::none_of(any_of_rank.begin(), any_of_rank.end(), [](char any) { return any; })) return own;
    Decomposition whole;
    whole.nodes = gather_nodes(ranks, own.nodes, host_name());
    whole.leaves = gather_items(ranks, own.leaves);
    whole.contacts = std::move(own.contacts);
    return in_agreement(
        ranks, [&] { return divide_straight(std::move(whole), options, range_of_rank(options.parts, ranks), cuts); });
}

// Cuts on this rank alone. A single surface is taken out of `input`: the halves hold all that is needed of it.
Decomposition cut_here(Input& input, const DecomposeOptions& options, LeafRange range, CutListener* cuts) {
    return input.complex.region_count() == 1 ? decompose(input.complex.take_only_region(), options, range, cuts)
                                             : decompose(input.complex, options, range, cuts);
}

}  // namespace

Decomposition cut_surface(Communicator& ranks, Input& input, const RunPlan& plan, StageListener* listener) {
    const RunRequest& request = plan.request();
    const DecomposeOptions options = plan.decompose_options();
    DecomposeOptions wanted = options;
    const std::string& trace_file = request.outputs.trace_file;
    const LeafRange range = range_of_rank(wanted.parts, ranks);
    CutListener* cuts = listener;
    std::optional<TraceRecorder> trace;
    // A forecast counts the triangles of fine interfaces without making them.
    if (request.dry_run && trace_file.empty()) wanted.cut.has_coarse_interfaces = true;
    if (!trace_file.empty()) cuts = &trace.emplace(request, input, cuts);
    in_agreement(ranks, [&] { tell_progress(listener, "decompose", 0, 1); });
    Decomposition own = ranks.size() > 1 ? decompose_on_ranks(ranks, input.complex, wanted, cuts)
                                         : in_agreement(ranks, [&] { return cut_here(input, wanted, range, cuts); });
    if (wanted.facets == FacetPolicy::split) own = divide_unfinished(ranks, std::move(own), options, cuts);
    if (trace) trace->write(trace_file, ranks, own, range);  // a run that fails later has one, too
    return own;
}

}  // namespace kerf
