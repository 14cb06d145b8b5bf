// Makes geometry of surfaces, contours and planes. The functions are pure, and coordinates that they are given are
// those of the file.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "viewer/model/camera.h"
#include "viewer/model/document.h"
#include "viewer/model/view_state.h"
#include "viewer/scene/inside/quadratic_triangle.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// The half space of points with normal . p <= offset.
struct ShownSide {
    Vec3 normal = Vec3::UnitX();
    double offset = 0;

    double distance(const Vec3& p) const { return normal.dot(p) - offset; }  ///< signed; positive: hidden
};
/// Returns the half space that a clip plane shows of a body in the box.
ShownSide shown_side(const Clip& clip, const Eigen::AlignedBox3d& box);
ClipPlane clip_plane(const ShownSide& side, const Frame& frame);

/// The choice of facets of a surface, and the way to draw them.
struct FacetChoice {
    std::function<bool(std::int32_t facet)> wanted;  ///< the facets that are drawn; none: all
    std::span<const float> value;                    ///< value per facet; empty: 0
    std::span<const float> vertex_value;             ///< value per vertex, instead of `value`; empty: none
    std::span<const Vec3> places;                    ///< places of the vertices; empty: those of the surface
    DrawnEdges edges = {};                           ///< the nodes of NodeSurface::edges; empty: facets are flat
    bool smooth = false;                             ///< normals are smooth over edges below 40 degrees
    double shrink = 0;                               ///< of triangles about their centres
};

/// Returns the wanted facets, curved ones in pieces; `element` is the number of the facet. Facets of the input come
/// first, then those of interfaces. O(#F).
std::shared_ptr<Geometry> facet_triangles(const NodeSurface& surface, const Frame& frame, const FacetChoice& choice);
/// Returns the number of triangles in such a geometry that are of the input, which come first. O(#F).
std::uint32_t input_triangles(const Geometry& geometry, const NodeSurface& surface);

/// Returns the segments inside of the first `count` triangles on which values are those of the levels. O(count) for
/// each level.
std::shared_ptr<Geometry> isolines(const Geometry& triangles, std::size_t count, const std::vector<float>& levels);

/// Returns triangles over points, with their edges; `element` is the number of the triangle.
std::shared_ptr<Geometry> triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                    const Frame& frame);

std::shared_ptr<Geometry> segments(const std::vector<std::array<Vec3, 2>>& ends, const Frame& frame);
std::shared_ptr<Geometry> points(const std::vector<Vec3>& places, const Frame& frame);

/// Returns a rectangle in the plane that covers the box's section and a little more, without inner edges.
std::shared_ptr<Geometry> plane_rectangle(const Plane& plane, const Eigen::AlignedBox3d& box, const Frame& frame);
/// Returns the border of that rectangle and an arrow along the normal, at a corner.
std::shared_ptr<Geometry> plane_outline(const Plane& plane, const Eigen::AlignedBox3d& box, const Frame& frame);

Eigen::AlignedBox3d box_of(const std::vector<Vec3>& vertices);
/// Returns the box of the part of a closed surface and its inside that a clip plane leaves; for ClipStyle::layer the
/// box of the section alone. O(#F).
Eigen::AlignedBox3d box_of_shown(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const ShownSide& side, ClipStyle style);

}  // namespace kerf::view
