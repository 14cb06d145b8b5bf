// From a click to the thing clicked, and that in words.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/session.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// What was hit: a facet or cell of `owner`, and the point on it in coordinates of the file.
struct Hit {
    bool is_cell = false;
    NodeId owner = 0;
    std::int32_t element = -1;
    Vec3 point = Vec3::Zero();
};

/// The surface whose numbers a selection of `owner` uses: of a part of a run folder, its file's; else the node's.
/// nullptr while it is being fetched.
std::shared_ptr<const NodeSurface> surface_of(Session& session, NodeId owner);

/// The facet, cell or vertex that a hit selects; none while the cells behind a facet are being fetched.
std::optional<Selection> select(Session& session, const Hit& hit, PickMode mode);

/// Numbers (in the file, global, of the part), coordinates, neighbours and quality, a fact a line; empty if there is
/// nothing or it is being fetched. Of a solution displacement and stresses there, means over the corners.
std::string describe_selection(Session& session, const Selection& selection, int load_case);

/// The corners of what is selected, or the place; empty while it is being fetched.
std::vector<Vec3> selected_points(Session& session, const Selection& selection);

/// The edges of what is selected, each once; of a defect those of its facets. Empty where it is a point.
std::vector<std::array<Vec3, 2>> selected_edges(Session& session, const Selection& selection);

/// Where the eye goes to see a cell of a part at the surface of what is shown, see direction_to_eye() in
/// model/line_of_sight.h; none if the cell lies inside, or nobody outside can see it. O(#F).
std::optional<Vec3> direction_to_cell(const PartCells& cells, const NodeSurface& part, const NodeSurface& shown,
                                      std::int32_t cell, const Vec3& present);

/// The global numbers of the corners of a selected cell; none if that is no cell or it is being fetched.
std::optional<std::array<std::int64_t, 4>> selected_cell(Session& session, const Selection& selection);

}  // namespace kerf::view
