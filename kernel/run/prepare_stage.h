// From the surfaces that each rank has cut to what its parts need to be meshed on their own.
#pragma once

#include <vector>

#include "decompose/decomposition.h"
#include "parallel/communicator.h"
#include "prepare/input.h"
#include "report/report.h"
#include "work/part_job.h"

namespace kerf {

/// A part that this rank has cut: what is known of it, and what is to be done.
struct OwnPart {
    PartReport report;
    PartJob job;
};

struct PreparedParts {
    std::vector<OwnPart> own;           ///< of this rank, in the order of the tree
    std::int64_t surface_vertices = 0;  ///< distinct ones of all parts: vertices inside of parts are numbered from here
    std::int64_t unmatched_interface_facets = 0;
    std::int64_t missing_input_facets = 0;
};

/// Brings both sides of all interfaces together: neighbours, global numbers, and what parts share. Collective. `nodes`:
/// of the whole tree, ascending by number; `own`: of this rank. Memory and messages of a rank follow what its own parts
/// have to do with others, but for 16 bytes a part of the run. The jobs are the same for any number of ranks.
PreparedParts prepare_parts(Communicator& ranks, const Input& input, const std::vector<TreeNode>& nodes,
                            Decomposition own, const RunOptions& options);

/// The reports of all parts, in the order of the tree. Collective.
std::vector<PartReport> gather_reports(Communicator& ranks, const std::vector<OwnPart>& own);

}  // namespace kerf
