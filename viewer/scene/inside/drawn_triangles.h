// Adds triangles with values and edges to a geometry, as all shapes do.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/core/types.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

using Corners = std::array<Vec3, 3>;

using Places = std::span<const Vec3>;

inline void add_triangle(Geometry& geometry, const Frame& frame, const Corners& corners, float value,
                         std::uint16_t edges, std::int32_t element) {
    for (const Vec3& p : corners) geometry.corners.push_back({frame.draw(p), {}, edges, value});
    geometry.element.push_back(element);
}

inline std::array<std::int16_t, 3> packed_normal(const Vec3& normal) {
    const double length = normal.norm();
    if (!(length > 0)) return {};
    const auto n = (normal / length * 32767).cast<std::int16_t>().eval();
    return {n.x(), n.y(), n.z()};
}

// Adds the places of the last triangle's corners when nothing is deformed.
inline void add_rest(Geometry& geometry, const Frame& frame, const Corners& corners) {
    for (const Vec3& p : corners) geometry.rest.push_back(frame.draw(p));
}

inline Corners shrunk(Corners corners, const Vec3& center, double shrink) {
    if (shrink > 0)
        for (Vec3& p : corners) p += shrink * (center - p);
    return corners;
}

inline Corners corners_at(const Places& places, const Triangle& t) {
    return {places[t[0]], places[t[1]], places[t[2]]};
}

// Gives the last triangle values of its own at its corners.
inline void set_corner_values(Geometry& geometry, const std::array<float, 3>& values) {
    for (std::size_t k = 0; k < 3; ++k) (geometry.corners.end() - 3 + k)->value = values[k];
}
inline void set_corner_values(Geometry& geometry, const Triangle& t, std::span<const float> vertex_value) {
    set_corner_values(geometry, {vertex_value[t[0]], vertex_value[t[1]], vertex_value[t[2]]});
}

struct ValuedPoint {
    Vec3 place = Vec3::Zero();
    float value = 0;
    Vec3 rest = Vec3::Zero();  // see Geometry::rest
};

// Adds a convex polygon as a fan of triangles whose inner edges are not drawn.
inline void add_polygon(Geometry& geometry, const Frame& frame, const std::vector<ValuedPoint>& polygon,
                        std::int32_t element, bool is_moved = false) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        std::uint16_t edges = 2;  // from i to i + 1
        if (i == 1) edges |= 1;
        if (i + 2 == polygon.size()) edges |= 4;
        const ValuedPoint &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
        add_triangle(geometry, frame, {a.place, b.place, c.place}, 0, edges, element);
        set_corner_values(geometry, {a.value, b.value, c.value});
        if (is_moved) add_rest(geometry, frame, {a.rest, b.rest, c.rest});
    }
}

}  // namespace kerf::view
