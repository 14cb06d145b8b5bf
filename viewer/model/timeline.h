// The steps of each node: what left and right go through.
#pragma once

#include <string>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/stage.h"

namespace kerf::view {

/// Whether a part below the node has been meshed, and its cells can be shown.
bool has_cells(const Document& document, NodeId node);

/// The steps of a node that the document has data for, in order; refused tries come between input and plane. Never
/// empty for a node that exists.
std::vector<Step> steps_of(const Document& document, NodeId node);

/// The index of a step in `steps`: the step itself, else the last one before it.
std::size_t nearest_step(const std::vector<Step>& steps, const Step& step);

/// What happened in a step, in one or two sentences with numbers: "Refused: chord at 3 places. Try 2 of 5: first axis,
/// the plane in its first place, after 1 repair."
std::string describe_step(const Document& document, NodeId node, const Step& step);

/// A node that was cut, but of whose cut only the result is known: the run has left no trace.
bool has_no_stages(const Document& document, NodeId node);

/// A place where a refused try failed.
struct FailurePlace {
    Vec3 where = Vec3::Zero();
    double radius = 0;  ///< of the triangles that meet there; 0: the place is a point
};
/// Those of a refused try, in the order in which they were found: the pairs of triangles that meet, else the points.
std::vector<FailurePlace> failure_places(const Document& document, NodeId node, const Step& step);

/// The node before or after `node` in depth-first order; `node` itself at the ends.
NodeId next_node(const Tree& tree, NodeId node, int direction);

}  // namespace kerf::view
