// The tree of cuts of a surface, in memory: the result of `kerf decompose`, without a folder.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "cut/decompose/tree_node.h"
#include "kerf/kerf.h"
#include "run/work/part_job.h"

namespace kerf {

/// The two ends of an edge of a surface.
using EdgeEnds = std::array<Vec3, 2>;

/// One attempt at a cut, with places in place of numbers of vertices.
struct RecordedTry {
    CutTry what;                    ///< its contour is empty
    std::vector<EdgeEnds> contour;  ///< the half below is on the left
};

/// The contour at each stage of its making, as ContourStages has it.
struct RecordedStages {
    std::vector<EdgeEnds> crossed_edges, hanging_edges_removed, closed_loops, multiple_paths_removed, smoothed;
};

/// A bisection, beside the numbers that its TreeNode keeps.
struct RecordedCut {
    std::vector<RecordedTry> tries;          ///< all; the accepted one last, those of contours of edges first
    std::vector<std::vector<Vec3>> contour;  ///< closed loops, the half below on the left; empty if no cut was made
    RecordedStages stages;                   ///< only of contours of edges, else empty
};

struct CutTree {
    std::vector<TreeNode> nodes;         ///< all, ascending by number
    std::map<NodeId, RecordedCut> cuts;  ///< one for each node where a cut was tried
    std::vector<PartJob> parts;          ///< in the order of the tree: surfaces, neighbours, global numbers
    std::vector<std::string> patch_names;
    std::vector<std::string> region_names;  ///< empty if there is one region
};

/// Cuts the surface as `kerf decompose` does with the same options: the same parts, to the last bit. Throws
/// Error(usage) for an option out of range, Error(verification) if a facet of the surface or a side of an interface is
/// missing, and Error(cancelled). Memory: the surfaces of the parts, and all contours.
CutTree cut_to_tree(const ClosedSurface& surface, const MeshOptions& options);

}  // namespace kerf
