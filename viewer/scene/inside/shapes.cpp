// Facets become triangles that share no corners, so that each has its own edges, value and normals. Facets of the input
// come before those of interfaces, on which ranges of layers rely (input_triangles()). The normal of a corner is the
// sum of the area normals of the facets around its vertex that turn by less than 40 degrees against the corner's own
// facet: edges stay sharp without a search for creases. An isoline crosses a triangle where exactly two of its sides
// have their ends on different sides of the level; an end at the level itself counts as above it on both sides of an
// edge, so that lines go on from triangle to triangle. A clip plane is kept as the half space normal . p <= offset in
// coordinates of the file, and is turned into draw coordinates, with the opposite sign, only for the renderer.
#include "viewer/scene/inside/shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/core/ids.h"
#include "viewer/scene/inside/drawn_triangles.h"

namespace kerf::view {

namespace {

constexpr double crease_cosine = 0.766;  // 40 degrees

// Facets around each vertex, one after the other.
struct Fans {
    std::vector<std::int32_t> begin, facet;

    explicit Fans(const NodeSurface& surface) : begin(surface.vertices.size() + 1, 0) {
        for (const Triangle& t : surface.facets)
            for (const std::int32_t v : t) ++begin[v + 1];
        for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
        facet.resize(begin.back());
        std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
        for (std::int32_t f = 0; f < count_of(surface.facets); ++f)
            for (const std::int32_t v : surface.facets[f]) facet[next[v]++] = f;
    }
};

std::vector<Vec3> area_normals(const NodeSurface& surface) {
    std::vector<Vec3> normals(surface.facets.size());
    for (std::size_t f = 0; f < normals.size(); ++f) {
        const Triangle& t = surface.facets[f];
        const Vec3& a = surface.vertices[t[0]];
        normals[f] = (surface.vertices[t[1]] - a).cross(surface.vertices[t[2]] - a);
    }
    return normals;
}

// The corners' normals: means over the facets around a vertex that turn little against the corner's own.
class SmoothNormals {
 public:
    explicit SmoothNormals(const NodeSurface& surface)
        : surface_(surface), fans_(surface), normals_(area_normals(surface)) {}

    std::array<Vec3, 3> of_facet(std::size_t f) const {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t v = surface_.facets[f][k];
            corners[k] = Vec3::Zero();
            for (std::int32_t j = fans_.begin[v]; j < fans_.begin[v + 1]; ++j) {
                const Vec3& other = normals_[fans_.facet[j]];
                if (other.dot(normals_[f]) > crease_cosine * other.norm() * normals_[f].norm()) corners[k] += other;
            }
        }
        return corners;
    }

 private:
    const NodeSurface& surface_;
    Fans fans_;
    std::vector<Vec3> normals_;
};

void add_quadratic_facet(Geometry& geometry, const NodeSurface& surface, const Frame& frame, const FacetChoice& choice,
                         std::int32_t f, const SmoothNormals* normals) {
    const DrawnVertices vertices{choice.places.empty() ? Places(surface.vertices) : choice.places, surface.vertices,
                                 choice.vertex_value};
    QuadraticTriangle t = quadratic_triangle(vertices, choice.edges, surface.facets[f], surface.edges_of_facet[f],
                                             choice.value.empty() ? 0 : choice.value[f]);
    if (normals) t.normals = normals->of_facet(f);
    const Vec3 center = (t.place[0] + t.place[1] + t.place[2]) / 3;
    for (Vec3& p : t.place) p += choice.shrink * (center - p);
    add_quadratic(geometry, frame, t, pieces_of(t, surface.facets.size()), f, !choice.places.empty());
}

void add_flat_facet(Geometry& geometry, const NodeSurface& surface, const Frame& frame, const FacetChoice& choice,
                    std::int32_t f, const SmoothNormals* normals) {
    const Triangle& t = surface.facets[f];
    const Corners corners = corners_at(choice.places.empty() ? Places(surface.vertices) : choice.places, t);
    const Vec3 center = (corners[0] + corners[1] + corners[2]) / 3;
    if (!center.allFinite()) return;
    add_triangle(geometry, frame, shrunk(corners, center, choice.shrink), choice.value.empty() ? 0 : choice.value[f], 7,
                 f);
    if (!choice.vertex_value.empty()) set_corner_values(geometry, t, choice.vertex_value);
    if (!choice.places.empty()) add_rest(geometry, frame, corners_at(surface.vertices, t));
    if (!normals) return;
    const std::array<Vec3, 3> of_corners = normals->of_facet(f);
    for (std::size_t k = 0; k < 3; ++k) (geometry.corners.end() - 3 + k)->normal = packed_normal(of_corners[k]);
}

// Corners of the rectangle, counter-clockwise seen against the normal.
std::array<Vec3, 4> rectangle_corners(const Plane& plane, const Eigen::AlignedBox3d& box) {
    Eigen::AlignedBox2d flat;
    for (int i = 0; i < 8; ++i) flat.extend(plane.project(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))));
    const Vec2 more = Vec2::Constant(0.06 * flat.diagonal().norm());
    const Vec2 low = flat.min() - more, high = flat.max() + more;
    return {plane.lift(low, 0), plane.lift({high.x(), low.y()}, 0), plane.lift(high, 0),
            plane.lift({low.x(), high.y()}, 0)};
}

}  // namespace

ShownSide shown_side(const Clip& clip, const Eigen::AlignedBox3d& box) {
    const ValueRange range = extent_along(box, clip.normal);
    const double offset = range.low + clip.position * (range.high - range.low);
    if (clip.flipped) return {-clip.normal, -offset};
    return {clip.normal, offset};
}

ClipPlane clip_plane(const ShownSide& side, const Frame& frame) {
    const Eigen::Vector3f n = (-side.normal).cast<float>();
    const double d = (side.offset - side.normal.dot(frame.center)) * frame.scale;
    return {{n.x(), n.y(), n.z(), static_cast<float>(d)}};
}

std::shared_ptr<Geometry> facet_triangles(const NodeSurface& surface, const Frame& frame, const FacetChoice& choice) {
    auto geometry = std::make_shared<Geometry>();
    const std::int32_t count = count_of(surface.facets);
    if (!choice.wanted) {
        geometry->corners.reserve(3 * surface.facets.size());
        geometry->element.reserve(surface.facets.size());
    }
    std::optional<SmoothNormals> normals;
    if (choice.smooth) normals.emplace(surface);
    const bool is_quadratic = !choice.edges.empty() && !surface.edges_of_facet.empty();
    for (const bool interfaces : {false, true})
        for (std::int32_t f = 0; f < count; ++f) {
            if (surface.is_interface(f) != interfaces || (choice.wanted && !choice.wanted(f))) continue;
            (is_quadratic ? add_quadratic_facet : add_flat_facet)(*geometry, surface, frame, choice, f,
                                                                  normals ? &*normals : nullptr);
        }
    return geometry;
}

std::uint32_t input_triangles(const Geometry& geometry, const NodeSurface& surface) {
    const auto& element = geometry.element;
    return static_cast<std::uint32_t>(
        std::find_if(element.begin(), element.end(), [&](std::int32_t f) { return surface.is_interface(f); }) -
        element.begin());
}

std::shared_ptr<Geometry> isolines(const Geometry& triangles, std::size_t count, const std::vector<float>& levels) {
    auto geometry = std::make_shared<Geometry>();
    for (std::size_t i = 0; i < 3 * count; i += 3)
        for (const float level : levels) {
            std::array<std::array<float, 3>, 2> ends = {};
            std::size_t found = 0;
            for (std::size_t k = 0; k < 3 && found < 2; ++k) {
                const Corner &a = triangles.corners[i + k], &b = triangles.corners[i + (k + 1) % 3];
                if ((a.value < level) == (b.value < level) || std::isnan(a.value) || std::isnan(b.value)) continue;
                const float s = (level - a.value) / (b.value - a.value);
                for (std::size_t c = 0; c < 3; ++c)
                    ends[found][c] = a.position[c] + s * (b.position[c] - a.position[c]);
                ++found;
            }
            if (found < 2) continue;
            geometry->segments.push_back({ends[0], ends[1]});
            geometry->origins.push_back({static_cast<std::uint32_t>(i / 3), level});
        }
    return geometry;
}

std::shared_ptr<Geometry> triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                    const Frame& frame) {
    auto geometry = std::make_shared<Geometry>();
    for (std::int32_t i = 0; i < count_of(triangles); ++i) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = points[triangles[i][k]];
        add_triangle(*geometry, frame, corners, 0, 7, i);
    }
    return geometry;
}

std::shared_ptr<Geometry> segments(const std::vector<std::array<Vec3, 2>>& ends, const Frame& frame) {
    auto geometry = std::make_shared<Geometry>();
    geometry->segments.reserve(ends.size());
    for (const auto& [from, to] : ends) geometry->segments.push_back({frame.draw(from), frame.draw(to)});
    return geometry;
}

std::shared_ptr<Geometry> points(const std::vector<Vec3>& places, const Frame& frame) {
    auto geometry = std::make_shared<Geometry>();
    for (const Vec3& p : places)
        if (p.allFinite()) geometry->points.push_back(frame.draw(p));
    return geometry;
}

std::shared_ptr<Geometry> plane_rectangle(const Plane& plane, const Eigen::AlignedBox3d& box, const Frame& frame) {
    auto geometry = std::make_shared<Geometry>();
    std::vector<ValuedPoint> corners;
    for (const Vec3& corner : rectangle_corners(plane, box)) corners.push_back({corner, 0});
    add_polygon(*geometry, frame, corners, 0);
    geometry->element.clear();
    return geometry;
}

std::shared_ptr<Geometry> plane_outline(const Plane& plane, const Eigen::AlignedBox3d& box, const Frame& frame) {
    const std::array<Vec3, 4> corners = rectangle_corners(plane, box);
    std::vector<std::array<Vec3, 2>> lines;
    for (std::size_t i = 0; i < 4; ++i) lines.push_back({corners[i], corners[(i + 1) % 4]});
    const double length = 0.18 * (corners[2] - corners[0]).norm();
    const Vec3& from = corners[2];
    const Vec3 tip = from + length * plane.normal;
    lines.push_back({from, tip});
    for (const Vec3& side : {plane.u, plane.v})
        for (const double sign : {-1.0, 1.0})
            lines.push_back({tip, tip - 0.22 * length * plane.normal + sign * 0.1 * length * side});
    return segments(lines, frame);
}

Eigen::AlignedBox3d box_of(const std::vector<Vec3>& vertices) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : vertices)
        if (p.allFinite()) box.extend(p);
    return box;
}

Eigen::AlignedBox3d box_of_shown(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const ShownSide& side, ClipStyle style) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : facets)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = vertices[t[k]], &b = vertices[t[(k + 1) % 3]];
            const double da = side.distance(a), db = side.distance(b);
            if (da <= 0 && style != ClipStyle::layer) box.extend(a);
            if ((da < 0) != (db < 0) && da != db) box.extend(a + da / (da - db) * (b - a));
        }
    return box;
}

}  // namespace kerf::view
