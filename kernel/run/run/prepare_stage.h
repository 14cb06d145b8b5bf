// The jobs of parts: the surfaces that each rank has cut become all that a part needs to be meshed on its own.
#pragma once

#include <vector>

#include "base/parallel/communicator.h"
#include "cut/decompose/decomposition.h"
#include "run/prepare/input.h"
#include "run/report/report.h"
#include "run/run/plan.h"
#include "run/work/part_job.h"

namespace kerf {

/// A part that this rank has cut: the numbers that are known of it, and its job.
struct OwnPart {
    PartReport report;
    PartJob job;
};

struct PreparedParts {
    std::vector<OwnPart> own;           ///< parts of this rank, in the order of the tree
    std::int64_t surface_vertices = 0;  ///< distinct ones of all parts; those inside are numbered from here
    std::int64_t unmatched_interface_facets = 0;
    std::int64_t missing_input_facets = 0;
};

/// Brings both sides of all interfaces together, and gives each part of this rank its neighbours, global numbers, and
/// the vertices and edges that it shares. Collective. `nodes`: nodes of the whole tree, ascending by number; `own`: the
/// parts of this rank. Memory and messages of a rank follow what its own parts share with others, but for 16 bytes a
/// part of the run. The jobs are the same for any number of ranks.
PreparedParts prepare_parts(Communicator& ranks, const Input& input, const std::vector<TreeNode>& nodes,
                            Decomposition own, const RunPlan& plan);

/// Returns the reports of all parts, in the order of the tree. Collective.
std::vector<PartReport> gather_reports(Communicator& ranks, const std::vector<OwnPart>& own);

}  // namespace kerf
