// The steps of each node, through which the keys left and right go.
#pragma once

#include <string>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/stage.h"

namespace kerf::view {

/// Returns whether a part below the node has been meshed, and its cells can be shown.
bool has_cells(const Document& document, NodeId node);

/// Returns the steps of a node for which the document has data, in order; refused tries come between input and plane.
/// Never empty.
std::vector<Step> steps_of(const Document& document, NodeId node);

/// Returns the index of a step in `steps`: of the step itself, else of the last one before it.
std::size_t nearest_step(const std::vector<Step>& steps, const Step& step);

/// Describes a step in one or two sentences with numbers: "Refused: chord at 3 places. Try 2 of 5: first axis,
/// the plane in its first place, after 1 repair."
std::string describe_step(const Document& document, NodeId node, const Step& step);

/// Returns whether a node was cut, but only the result of its cut is known: the run has left no trace.
bool has_no_stages(const Document& document, NodeId node);

/// A place where a refused try failed.
struct FailurePlace {
    Vec3 where = Vec3::Zero();
    double radius = 0;  ///< radius of the triangles that meet there; 0: the place is a point
};
/// Returns the places of a refused try in the order in which they were found: the pairs of triangles that meet, else
/// the points.
std::vector<FailurePlace> failure_places(const Document& document, NodeId node, const Step& step);

/// Returns the node before (`direction` < 0) or after `node` in depth-first order; `node` itself at the ends.
NodeId next_node(const Tree& tree, NodeId node, int direction);

}  // namespace kerf::view
