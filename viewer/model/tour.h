// A guided tour of one cut: plain sentences on each stage, with the figures of this very cut, and the best view of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Returns the node whose cut is shown: `wanted`, if its cut was made and recorded, else the first node of which that
/// is true; none if the document has no stages.
std::optional<NodeId> node_of_tour(const Document& document, NodeId wanted);

/// Returns the steps of the node from its input on, without tries that were refused.
std::vector<Step> stops_of_tour(const Document& document, NodeId node);

/// Tells the events at a stop to a reader who sees them for the first time. A sentence whose figures are not known is
/// left out.
std::string tell(const Document& document, NodeId node, Stage stage);

/// The view of a stop.
struct TourView {
    ViewState state;            ///< state of the view, without a camera
    Eigen::AlignedBox3d box;    ///< the box that fits into the picture
    Vec3 back = Vec3::UnitX();  ///< direction from the box to the eye, of length 1
};
/// Returns the view of a stop. `body` is the box of the node's surface. Theme, panels and times are those of `before`.
/// The node must have a recorded cut.
TourView view_of_stop(const Document& document, NodeId node, Stage stage, const Eigen::AlignedBox3d& body,
                      const ViewState& before);

}  // namespace kerf::view
