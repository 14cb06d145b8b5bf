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

/// A stop of a tour. Tetrahedra have two: all parts as they are, and cut open.
struct TourStop {
    Stage stage = Stage::input;
    bool cut_open = false;

    bool operator==(const TourStop&) const = default;
};

/// Returns the stops of the node from its input on, without tries that were refused.
std::vector<TourStop> stops_of_tour(const Document& document, NodeId node);
/// Returns the stop that a view shows, or the nearest one before it.
std::size_t nearest_stop(const std::vector<TourStop>& stops, const ViewState& state);

/// Tells the events at a stop to a reader who sees them for the first time. A sentence whose figures are not known is
/// left out.
std::string tell(const Document& document, NodeId node, const TourStop& stop);

/// The view of a stop.
struct TourView {
    ViewState state;            ///< state of the view, without a camera
    Eigen::AlignedBox3d box;    ///< the box that fits into the picture
    Vec3 back = Vec3::UnitX();  ///< direction from the box to the eye, of length 1
};
/// Returns the view of a stop. `surface` is the node's, or nullptr where it is not known. Theme, panels and times are
/// those of `before`. The node must have a recorded cut.
TourView view_of_stop(const Document& document, NodeId node, const TourStop& stop, const NodeSurface* surface,
                      const ViewState& before);

}  // namespace kerf::view
