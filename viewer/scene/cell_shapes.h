// Cells to geometry. Pure functions; all coordinates in are those of the file.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viewer/scene/shapes.h"

namespace kerf::view {

/// How cells are chosen and drawn.
struct CellChoice {
    std::span<const float> value;                      ///< per cell; empty: 0
    std::span<const std::array<float, 4>> face_value;  ///< per cell and face, instead of `value`; empty: none
    std::span<const float> vertex_value;               ///< per vertex, instead of both; empty: none
    std::span<const Vec3> places;                      ///< of the vertices, if not where the cells have them
    DrawnEdges edges = {};                             ///< of PartCells::edges; empty: faces are flat
    std::optional<ValueRange> filter;                  ///< of the values; needs them
    std::function<bool(std::size_t cell)> wanted;      ///< besides; none: all
    const ShownSide* side = nullptr;                   ///< of a clip plane, or nullptr
    ClipStyle style = ClipStyle::cells;
    double shrink = 0;
};

/// What is seen of the chosen cells: faces between a chosen cell and one that is not, and boundary faces; with shrink
/// all faces of the cells that have one of these, and behind them, whole, what these cells cover. `element` is the
/// cell. O(#T).
std::shared_ptr<Geometry> cell_faces(const PartCells& cells, const Frame& frame, const CellChoice& choice);

/// The sections of the chosen cells with the plane of choice.side: triangles, of which only the sides of sections are
/// edges. `element` is the cell. O(#T).
std::shared_ptr<Geometry> cell_sections(const PartCells& cells, const Frame& frame, const CellChoice& choice);

/// The values of the facets of a part's surface at the faces of its cells; NaN at inner faces. O(#T + #F).
std::vector<std::array<float, 4>> face_values(const PartCells& cells, const NodeSurface& surface,
                                              std::span<const float> of_facet);

/// The chosen cells by number. O(#T).
std::vector<char> chosen_cells(const PartCells& cells, const CellChoice& choice);

}  // namespace kerf::view
