// One cut of a trace made again.
#pragma once

#include <memory>
#include <optional>

#include "viewer/model/replayer.h"
#include "viewer/model/tree.h"

namespace kerf::view {

/// What came of it.
struct RedoneCut {
    std::shared_ptr<Replayer> replayer;  ///< of the trace with this cut instead of the old one, without those below it
    std::vector<TreeRow> rows;           ///< of the node and, if a cut was made, its halves
};

/// Cuts the node at `plane` (place_of()), else where it was cut before, else in two of equal load, with
/// options.decompose.cut; by a straight cut where no contour of edges is found and the options allow it. `options` need
/// not be resolved. Throws Error(usage) for options out of range or a node that the tree does not have.
RedoneCut redo_cut(Replayer& replayer, NodeId node, RunOptions options, const std::optional<Plane>& plane = {});

}  // namespace kerf::view
