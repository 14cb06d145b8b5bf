// A guided tour of one cut: what happens at each stage, in plain sentences with the figures of this very cut, and how
// the stage is seen best.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// The node whose cut is shown: `wanted`, if its cut was made and recorded, else the first one of which that is true.
/// None: the document has no stages.
std::optional<NodeId> node_of_tour(const Document& document, NodeId wanted);

/// The steps of the node, without tries that were refused, from its input on.
std::vector<Step> stops_of_tour(const Document& document, NodeId node);

/// What happens at a stop, for who sees it for the first time. A sentence whose figures are not known is left out.
std::string tell(const Document& document, NodeId node, Stage stage);

/// How a stop is looked at.
struct TourView {
    ViewState state;            ///< without a camera
    Eigen::AlignedBox3d box;    ///< what fits into the picture
    Vec3 back = Vec3::UnitX();  ///< from there to the eye, of length 1
};
/// `body`: the box of the node's surface. Theme, panels and the like are those of `before`. The node has a recorded
/// cut.
TourView view_of_stop(const Document& document, NodeId node, Stage stage, const Eigen::AlignedBox3d& body,
                      const ViewState& before);

}  // namespace kerf::view
