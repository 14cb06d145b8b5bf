// Surfaces, contours and cells to geometry. Pure functions; all coordinates in are those of the file.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "viewer/model/camera.h"
#include "viewer/model/document.h"
#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// Half space of points with normal . p <= offset.
struct ShownSide {
    Vec3 normal = Vec3::UnitX();
    double offset = 0;

    double distance(const Vec3& p) const { return normal.dot(p) - offset; }  ///< positive: hidden
};
/// The half space that a clip plane shows of what lies in the box.
ShownSide shown_side(const Clip& clip, const Eigen::AlignedBox3d& box);
ClipPlane clip_plane(const ShownSide& side, const Frame& frame);

/// Which facets of a surface are wanted, and how.
struct FacetChoice {
    std::function<bool(std::int32_t facet)> wanted;  ///< none: all
    std::span<const float> value;                    ///< per facet; empty: 0
    std::span<const float> vertex_value;             ///< per vertex, instead of `value`; empty: none
    std::span<const Vec3> places;                    ///< of the vertices, if not where the surface has them
    bool smooth = false;                             ///< normals over edges below 40 degrees
    double shrink = 0;                               ///< of triangles about their centres
};

/// The wanted facets; `element` is the facet's number. First those of the input, then those of interfaces;
/// `interface_begin` receives the number of the first triangle of these. O(#F).
std::shared_ptr<Geometry> facet_triangles(const NodeSurface& surface, const Frame& frame, const FacetChoice& choice,
                                          std::uint32_t* interface_begin = nullptr);

/// How cells are chosen and drawn.
struct CellChoice {
    std::span<const float> value;                      ///< per cell; empty: 0
    std::span<const std::array<float, 4>> face_value;  ///< per cell and face, instead of `value`; empty: none
    std::span<const float> vertex_value;               ///< per vertex, instead of both; empty: none
    std::span<const Vec3> places;                      ///< of the vertices, if not where the cells have them
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

/// Where the values inside of the first `count` triangles are those of the levels: segments. O(count) for each level.
std::shared_ptr<Geometry> isolines(const Geometry& triangles, std::size_t count, const std::vector<float>& levels);

/// The chosen cells by number. O(#T).
std::vector<char> chosen_cells(const PartCells& cells, const CellChoice& choice);

/// Triangles over points, with their edges; `element` is the number of the triangle.
std::shared_ptr<Geometry> triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                    const Frame& frame);

std::shared_ptr<Geometry> segments(const std::vector<std::array<Vec3, 2>>& ends, const Frame& frame);
std::shared_ptr<Geometry> points(const std::vector<Vec3>& places, const Frame& frame);

/// A rectangle in the plane that covers the box's section and a little more, without inner edges.
std::shared_ptr<Geometry> plane_rectangle(const Plane& plane, const Eigen::AlignedBox3d& box, const Frame& frame);
/// Its border and an arrow along the normal.
std::shared_ptr<Geometry> plane_outline(const Plane& plane, const Eigen::AlignedBox3d& box, const Frame& frame);

Eigen::AlignedBox3d box_of(const std::vector<Vec3>& vertices);
/// Of what a clip plane leaves of a closed surface and of what is in it: of a layer, of the section alone. O(#F).
Eigen::AlignedBox3d box_of_shown(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const ShownSide& side, ClipStyle style);

}  // namespace kerf::view
