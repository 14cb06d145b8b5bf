// Finds the thing that was clicked, and describes it in words.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/session.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// The facet or cell of `owner` that was hit, and the point on it in coordinates of the file.
struct Hit {
    bool is_cell = false;
    NodeId owner = no_node;
    std::int32_t element = -1;
    Vec3 point = Vec3::Zero();
};

/// Returns the surface whose numbers a selection of `owner` uses, and of which `owner` is drawn: for a part of a run
/// folder that of its file, else that of the node, which has other numbers. nullptr while it is being fetched.
std::shared_ptr<const NodeSurface> surface_of(Session& session, NodeId owner);

/// Returns the facet, cell or vertex that a hit selects; none while the cells or surface for it are being fetched.
std::optional<Selection> select(Session& session, const Hit& hit, PickMode mode);

/// Describes a selection: numbers (in the file, global, of the part), coordinates, neighbours and quality, a fact a
/// line, and displacement and stresses of a solution, as means over the corners. Empty if there is none or it is being
/// fetched.
std::string describe_selection(Session& session, const Selection& selection, int load_case);

/// Returns the corners of the selected thing, or the selected place; empty while it is being fetched.
std::vector<Vec3> selected_points(Session& session, const Selection& selection);

/// Returns the edges of the selected thing, each once; for a defect those of its facets. Empty where it is a point.
std::vector<std::array<Vec3, 2>> selected_edges(Session& session, const Selection& selection);

/// Returns the direction to an eye that sees a cell of a part at the shown surface, see direction_to_eye() in
/// model/line_of_sight.h; none if the cell lies inside, or cannot be seen from outside. O(#F).
std::optional<Vec3> direction_to_cell(const PartCells& cells, const NodeSurface& part, const NodeSurface& shown,
                                      std::int32_t cell, const Vec3& present);

/// Returns the global numbers of the corners of a selected cell; none if the selection is no cell, or it is being
/// fetched.
std::optional<std::array<std::int64_t, 4>> selected_cell(Session& session, const Selection& selection);

}  // namespace kerf::view
