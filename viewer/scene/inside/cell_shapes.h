// Makes geometry of cells. The functions are pure, and coordinates that they are given are those of the file.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viewer/scene/inside/shapes.h"

namespace kerf::view {

/// The choice of cells, and the way to draw them.
struct CellChoice {
    std::span<const float> value;                      ///< value per cell; empty: 0
    std::span<const std::array<float, 4>> face_value;  ///< value per cell and face, instead of `value`; empty: none
    std::span<const float> vertex_value;               ///< value per vertex, instead of both; empty: none
    std::span<const Vec3> places;                      ///< places of the vertices; empty: those of the cells
    DrawnEdges edges = {};                             ///< the nodes of PartCells::edges; empty: faces are flat
    std::optional<ValueRange> filter;                  ///< range of `value` that is chosen; needs values
    std::function<bool(std::size_t cell)> wanted;      ///< further condition; none: all cells
    const ShownSide* side = nullptr;                   ///< the side that a clip plane shows, or nullptr
    ClipStyle style = ClipStyle::cells;
    double shrink = 0;
};

/// Returns the visible faces of the chosen cells: boundary faces, and faces between a chosen cell and one that is not.
/// With shrink these are all faces of the cells that have such a face, and behind them, not shrunk, the faces that
/// these cells cover. `element` is the cell. O(#T).
std::shared_ptr<Geometry> cell_faces(const PartCells& cells, const Frame& frame, const CellChoice& choice);

/// Returns the sections of the chosen cells with the plane of choice.side, as triangles whose edges are drawn only
/// where they are sides of a section. `element` is the cell. O(#T).
std::shared_ptr<Geometry> cell_sections(const PartCells& cells, const Frame& frame, const CellChoice& choice);

/// Returns the values of the facets of a part's surface at the faces of its cells; NaN at inner faces. O(#T + #F).
std::vector<std::array<float, 4>> face_values(const PartCells& cells, const NodeSurface& surface,
                                              std::span<const float> of_facet);

/// Returns 1 for each chosen cell, by number, and 0 for the others. O(#T).
std::vector<char> chosen_cells(const PartCells& cells, const CellChoice& choice);

}  // namespace kerf::view
