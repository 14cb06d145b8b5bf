// Surfaces, contours and planes to geometry. Pure functions; all coordinates in are those of the file.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "viewer/model/camera.h"
#include "viewer/model/document.h"
#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/quadratic_triangle.h"

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
    DrawnEdges edges = {};                           ///< of NodeSurface::edges; empty: facets are flat
    bool smooth = false;                             ///< normals over edges below 40 degrees
    double shrink = 0;                               ///< of triangles about their centres
};

/// The wanted facets, curved ones in pieces; `element` is the facet's number. First those of the input, then those of
/// interfaces. O(#F).
std::shared_ptr<Geometry> facet_triangles(const NodeSurface& surface, const Frame& frame, const FacetChoice& choice);
/// How many of their triangles are no interface's. O(#F).
std::size_t input_triangles(const Geometry& geometry, const NodeSurface& surface);

/// Where the values inside of the first `count` triangles are those of the levels: segments. O(count) for each level.
std::shared_ptr<Geometry> isolines(const Geometry& triangles, std::size_t count, const std::vector<float>& levels);

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
