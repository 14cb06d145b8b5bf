#include "viewer/scene/shapes.h"

#include <algorithm>
#include <cmath>

#include "mesh/tet_mesh.h"

namespace kerf::view {

namespace {

constexpr double crease_cosine = 0.766;  // 40 degrees

using Corners = std::array<Vec3, 3>;

std::array<std::int16_t, 3> packed(const Vec3& normal) {
    const double length = normal.norm();
    if (!(length > 0)) return {};
    const Vec3 n = normal / length * 32767;
    return {static_cast<std::int16_t>(n.x()), static_cast<std::int16_t>(n.y()), static_cast<std::int16_t>(n.z())};
}

void add_triangle(Geometry& geometry, const Frame& frame, const Corners& corners, float value, std::uint16_t edges,
                  std::int32_t element) {
    for (const Vec3& p : corners) geometry.corners.push_back({frame.draw(p), {}, edges, value});
    geometry.element.push_back(element);
}

Corners shrunk(Corners corners, const Vec3& center, double shrink) {
    if (shrink > 0)
        for (Vec3& p : corners) p += shrink * (center - p);
    return corners;
}

// Facets around each vertex, one after the other.
struct Fans {
    std::vector<std::int32_t> begin, facet;

    explicit Fans(const NodeSurface& surface) : begin(surface.vertices.size() + 1, 0) {
        for (const Triangle& t : surface.facets)
            for (const std::int32_t v : t) ++begin[static_cast<std::size_t>(v) + 1];
        for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
        facet.resize(static_cast<std::size_t>(begin.back()));
        std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t f = 0; f < surface.facets.size(); ++f)
            for (const std::int32_t v : surface.facets[f])
                facet[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = static_cast<std::int32_t>(f);
    }
};

std::vector<Vec3> area_normals(const NodeSurface& surface) {
    std::vector<Vec3> normals(surface.facets.size());
    for (std::size_t f = 0; f < normals.size(); ++f) {
        const Triangle& t = surface.facets[f];
        const Vec3& a = surface.vertices[static_cast<std::size_t>(t[0])];
        normals[f] = (surface.vertices[static_cast<std::size_t>(t[1])] - a)
                         .cross(surface.vertices[static_cast<std::size_t>(t[2])] - a);
    }
    return normals;
}

// The corners' normals: means over the facets around a vertex that turn little against the corner's own.
void smooth_normals(const NodeSurface& surface, Geometry& geometry) {
    const Fans fans(surface);
    const std::vector<Vec3> normals = area_normals(surface);
    for (std::size_t i = 0; i < geometry.element.size(); ++i) {
        const auto f = static_cast<std::size_t>(geometry.element[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(surface.facets[f][k]);
            Vec3 sum = Vec3::Zero();
            for (std::int32_t j = fans.begin[v]; j < fans.begin[v + 1]; ++j) {
                const Vec3& other = normals[static_cast<std::size_t>(fans.facet[static_cast<std::size_t>(j)])];
                if (other.dot(normals[f]) > crease_cosine * other.norm() * normals[f].norm()) sum += other;
            }
            geometry.corners[3 * i + k].normal = packed(sum);
        }
    }
}

using Places = std::span<const Vec3>;

Places places_of(const PartCells& cells, const CellChoice& choice) {
    return choice.places.empty() ? Places(cells.vertices) : choice.places;
}

Vec3 center_of(const Places& places, const std::array<std::int32_t, 4>& tet) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : tet) sum += places[static_cast<std::size_t>(v)];
    return sum / 4;
}

bool is_chosen_by_plane(const std::array<double, 4>& distance, ClipStyle style) {
    const auto [least, most] = std::minmax_element(distance.begin(), distance.end());
    switch (style) {
        case ClipStyle::cells:
            return distance[0] + distance[1] + distance[2] + distance[3] <= 0;
        case ClipStyle::smooth:
            return *least < 0;
        case ClipStyle::layer:
            return *least < 0 && *most >= 0;
    }
    return true;
}

Triangle face_of(const PartCells& cells, std::size_t tet, std::size_t face) {
    Triangle corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = cells.tets[tet][static_cast<std::size_t>(tet_faces[face][k])];
    return corners;
}

Corners corners_at(const Places& places, const Triangle& t) {
    return {places[static_cast<std::size_t>(t[0])], places[static_cast<std::size_t>(t[1])],
            places[static_cast<std::size_t>(t[2])]};
}

// The last triangle gets values of its own at its corners.
void set_corner_values(Geometry& geometry, const std::array<float, 3>& values) {
    for (std::size_t k = 0; k < 3; ++k)
        (geometry.corners.end() - 3 + static_cast<std::ptrdiff_t>(k))->value = values[k];
}
void set_corner_values(Geometry& geometry, const Triangle& t, std::span<const float> vertex_value) {
    set_corner_values(geometry,
                      {vertex_value[static_cast<std::size_t>(t[0])], vertex_value[static_cast<std::size_t>(t[1])],
                       vertex_value[static_cast<std::size_t>(t[2])]});
}

struct ValuedPoint {
    Vec3 place = Vec3::Zero();
    float value = 0;
};

// A convex polygon as a fan of triangles whose inner edges are not drawn.
void add_polygon(Geometry& geometry, const Frame& frame, const std::vector<ValuedPoint>& polygon,
                 std::int32_t element) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        std::uint16_t edges = 2;  // from i to i + 1
        if (i == 1) edges |= 1;
        if (i + 2 == polygon.size()) edges |= 4;
        const ValuedPoint &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
        add_triangle(geometry, frame, {a.place, b.place, c.place}, 0, edges, element);
        set_corner_values(geometry, {a.value, b.value, c.value});
    }
}

// Where the plane cuts a tetrahedron: three or four points, in the order of going around.
std::vector<ValuedPoint> section_of(const PartCells& cells, const CellChoice& choice, std::size_t tet,
                                    const std::array<double, 4>& distance) {
    const Places places = places_of(cells, choice);
    const auto corner = [&](std::size_t i) -> ValuedPoint {
        const auto v = static_cast<std::size_t>(cells.tets[tet][i]);
        const float of_cell = choice.value.empty() ? 0 : choice.value[tet];
        return {places[v], choice.vertex_value.empty() ? of_cell : choice.vertex_value[v]};
    };
    const auto between = [&](std::size_t i, std::size_t j) -> ValuedPoint {
        const double s = distance[i] / (distance[i] - distance[j]);
        const ValuedPoint a = corner(i), b = corner(j);
        return {a.place + s * (b.place - a.place), a.value + static_cast<float>(s) * (b.value - a.value)};
    };
    std::vector<std::size_t> below, above;
    for (std::size_t i = 0; i < 4; ++i) (distance[i] < 0 ? below : above).push_back(i);
    std::vector<ValuedPoint> polygon;
    if (below.size() == 2) {
        polygon = {between(below[0], above[0]), between(below[0], above[1]), between(below[1], above[1]),
                   between(below[1], above[0])};
    } else if (!below.empty() && !above.empty()) {
        const std::vector<std::size_t>& single = below.size() == 1 ? below : above;
        for (const std::size_t other : below.size() == 1 ? above : below) polygon.push_back(between(single[0], other));
    }
    return polygon;
}

// Seen from the side that was cut away the polygon is to go around counter-clockwise.
void face_towards(const Vec3& normal, std::vector<ValuedPoint>& polygon) {
    const auto side = [&](std::size_t i) -> Vec3 { return polygon[i].place - polygon[0].place; };
    if (polygon.size() >= 3 && side(1).cross(side(2)).dot(normal) < 0) std::reverse(polygon.begin() + 1, polygon.end());
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
    const Vec3 n = -side.normal;
    const double d = (side.offset - side.normal.dot(frame.center)) * frame.scale;
    return {{static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z()), static_cast<float>(d)}};
}

std::shared_ptr<Geometry> facet_triangles(const NodeSurface& surface, const Frame& frame, const FacetChoice& choice,
                                          std::uint32_t* interface_begin) {
    auto geometry = std::make_shared<Geometry>();
    const auto count = static_cast<std::int32_t>(surface.facets.size());
    if (!choice.wanted) {
        geometry->corners.reserve(3 * surface.facets.size());
        geometry->element.reserve(surface.facets.size());
    }
    for (const bool interfaces : {false, true}) {
        if (interfaces && interface_begin) *interface_begin = static_cast<std::uint32_t>(geometry->triangle_count());
        for (std::int32_t f = 0; f < count; ++f) {
            if (surface.is_interface(f) != interfaces || (choice.wanted && !choice.wanted(f))) continue;
            const Triangle& t = surface.facets[static_cast<std::size_t>(f)];
            const Corners corners = corners_at(choice.places.empty() ? Places(surface.vertices) : choice.places, t);
            const Vec3 center = (corners[0] + corners[1] + corners[2]) / 3;
            if (!center.allFinite()) continue;
            const float value = choice.value.empty() ? 0 : choice.value[static_cast<std::size_t>(f)];
            add_triangle(*geometry, frame, shrunk(corners, center, choice.shrink), value, 7, f);
            if (!choice.vertex_value.empty()) set_corner_values(*geometry, t, choice.vertex_value);
        }
    }
    if (choice.smooth) smooth_normals(surface, *geometry);
    return geometry;
}

std::vector<char> chosen_cells(const PartCells& cells, const CellChoice& choice) {
    std::vector<char> chosen(cells.tets.size(), 1);
    std::vector<double> distance;
    if (choice.side) {
        for (const Vec3& p : places_of(cells, choice)) distance.push_back(choice.side->distance(p));
    }
    for (std::size_t t = 0; t < chosen.size(); ++t) {
        if (choice.filter && !choice.value.empty()) {
            const double value = choice.value[t];
            chosen[t] = value >= choice.filter->low && value <= choice.filter->high;
        }
        if (chosen[t] && choice.wanted) chosen[t] = choice.wanted(t);
        if (!choice.side || !chosen[t]) continue;
        std::array<double, 4> d = {};
        for (std::size_t k = 0; k < 4; ++k) d[k] = distance[static_cast<std::size_t>(cells.tets[t][k])];
        chosen[t] = is_chosen_by_plane(d, choice.style);
    }
    return chosen;
}

std::vector<std::array<float, 4>> face_values(const PartCells& cells, const NodeSurface& surface,
                                              std::span<const float> of_facet) {
    const float none = std::nanf("");
    std::vector<std::array<float, 4>> values(cells.tets.size(), {none, none, none, none});
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const std::int32_t tet = cells.tet_at_facet[f];
        if (tet < 0) continue;
        const Triangle& facet = surface.facets[f];
        const auto t = static_cast<std::size_t>(tet);
        for (std::size_t k = 0; k < 4; ++k)  // the corner opposite to the face is none of the facet's
            if (std::find(facet.begin(), facet.end(), cells.tets[t][k]) == facet.end()) values[t][k] = of_facet[f];
    }
    return values;
}

std::shared_ptr<Geometry> cell_faces(const PartCells& cells, const Frame& frame, const CellChoice& choice) {
    auto geometry = std::make_shared<Geometry>();
    const std::vector<char> chosen = chosen_cells(cells, choice);
    const Places places = places_of(cells, choice);
    const auto is_open = [&](std::size_t t, std::size_t face) {
        const std::int32_t neighbour = cells.neighbours[t][face];
        return neighbour < 0 || !chosen[static_cast<std::size_t>(neighbour)];
    };
    const auto is_outer = [&](std::size_t t) {
        return is_open(t, 0) || is_open(t, 1) || is_open(t, 2) || is_open(t, 3);
    };
    const bool shrinks = choice.shrink > 0;
    for (std::size_t t = 0; t < chosen.size(); ++t) {
        if (!chosen[t]) continue;
        const bool outer = is_outer(t);
        if (!outer && !shrinks) continue;
        const float value = choice.value.empty() ? 0 : choice.value[t];
        const Vec3 center = center_of(places, cells.tets[t]);
        // Of a cell behind shrunk ones, what these would cover.
        const auto is_drawn = [&](std::size_t face) {
            if (outer) return shrinks || is_open(t, face);
            return is_outer(static_cast<std::size_t>(cells.neighbours[t][face]));
        };
        for (std::size_t face = 0; face < 4; ++face) {
            if (!is_drawn(face)) continue;
            const Triangle corners = face_of(cells, t, face);
            add_triangle(*geometry, frame, shrunk(corners_at(places, corners), center, outer ? choice.shrink : 0),
                         choice.face_value.empty() ? value : choice.face_value[t][face], 7,
                         static_cast<std::int32_t>(t));
            if (!choice.vertex_value.empty()) set_corner_values(*geometry, corners, choice.vertex_value);
        }
    }
    return geometry;
}

std::shared_ptr<Geometry> cell_sections(const PartCells& cells, const Frame& frame, const CellChoice& choice) {
    auto geometry = std::make_shared<Geometry>();
    if (!choice.side) return geometry;
    const std::vector<char> chosen = chosen_cells(cells, choice);
    const Places places = places_of(cells, choice);
    for (std::size_t t = 0; t < chosen.size(); ++t) {
        if (!chosen[t]) continue;
        std::array<double, 4> distance = {};
        for (std::size_t k = 0; k < 4; ++k)
            distance[k] = choice.side->distance(places[static_cast<std::size_t>(cells.tets[t][k])]);
        std::vector<ValuedPoint> polygon = section_of(cells, choice, t, distance);
        if (polygon.empty()) continue;
        if (choice.shrink > 0) {
            Vec3 center = Vec3::Zero();
            for (const ValuedPoint& p : polygon) center += p.place / static_cast<double>(polygon.size());
            for (ValuedPoint& p : polygon) p.place += choice.shrink * (center - p.place);
        }
        face_towards(choice.side->normal, polygon);
        add_polygon(*geometry, frame, polygon, static_cast<std::int32_t>(t));
    }
    return geometry;
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
            if (found == 2) geometry->segments.push_back({ends[0], ends[1]});
        }
    return geometry;
}

std::shared_ptr<Geometry> triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                    const Frame& frame) {
    auto geometry = std::make_shared<Geometry>();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = points[static_cast<std::size_t>(triangles[i][k])];
        add_triangle(*geometry, frame, corners, 0, 7, static_cast<std::int32_t>(i));
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
            const Vec3 &a = vertices[static_cast<std::size_t>(t[k])],
                       &b = vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
            const double da = side.distance(a), db = side.distance(b);
            if (da <= 0 && style != ClipStyle::layer) box.extend(a);
            if ((da < 0) != (db < 0) && da != db) box.extend(a + da / (da - db) * (b - a));
        }
    return box;
}

}  // namespace kerf::view
