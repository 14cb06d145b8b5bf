// Makes one cut of a trace again.
#pragma once

#include <memory>
#include <optional>

#include "viewer/model/inside/replayer.h"
#include "viewer/model/tree.h"

namespace kerf::view {

/// A cut that was made again.
struct RedoneCut {
    std::shared_ptr<Replayer> replayer;  ///< of the trace with this cut for the old one, without cuts below it
    std::vector<TreeRow> rows;           ///< rows of the node and, if a cut was made, of its halves
};

/// Cuts the node at `plane` (place_of()), else where it was cut before, else into two halves of equal load, with
/// options.cut. The cut is straight where no contour of edges is found and the options allow it. Any request
/// will do: choices_of() checks it. Throws Error(usage) for options out of range or a node that the tree does not have.
RedoneCut redo_cut(Replayer& replayer, NodeId node, RunRequest options, const std::optional<Plane>& plane = {});

}  // namespace kerf::view
