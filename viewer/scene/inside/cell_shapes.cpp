// A face of a chosen cell is open if there is no cell behind it, or one that is not chosen; a cell with an open face is
// an outer one. Open faces are drawn; with shrink all faces of outer cells, about the centre of the cell, and unshrunk
// those faces behind them that outer cells would cover, so that the gaps do not look into nothing. A plane chooses
// cells by the signed distances of their corners, which are positive on the hidden side. It cuts a tetrahedron in a
// triangle or, with two corners on each side, a quadrangle, whose corners are listed in the order of going around.
// Values and places at rest are interpolated along the cut edges like the places. Face k is opposite to corner k.
#include "viewer/scene/inside/cell_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/core/ids.h"
#include "fill/mesh/edge_table.h"
#include "fill/mesh/tet_mesh.h"
#include "viewer/scene/inside/drawn_triangles.h"

namespace kerf::view {

namespace {

Places places_of(const PartCells& cells, const CellChoice& choice) {
    return choice.places.empty() ? Places(cells.vertices) : choice.places;
}

Vec3 center_of(const Places& places, const std::array<std::int32_t, 4>& tet) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : tet) sum += places[v];
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
    for (std::size_t k = 0; k < 3; ++k) corners[k] = cells.tets[tet][tet_faces[face][k]];
    return corners;
}

// The nodes on the edges 01, 12 and 02 of a face, from edges_of_tet.
std::array<std::int32_t, 3> edges_of_face(const PartCells& cells, std::size_t tet, std::size_t face) {
    std::array<std::int32_t, 3> edges = {};
    for (std::size_t e = 0; e < 3; ++e) {
        const int a = tet_faces[face][ends_of_edges[e][0]], b = tet_faces[face][ends_of_edges[e][1]];
        for (std::size_t k = 0; k < tet_edges.size(); ++k)
            if (tet_edges[k] == std::array{a, b} || tet_edges[k] == std::array{b, a})
                edges[e] = cells.edges_of_tet[tet][k];
    }
    return edges;
}

void add_quadratic_face(Geometry& geometry, const PartCells& cells, const Frame& frame, const CellChoice& choice,
                        const std::pair<std::int32_t, std::size_t>& tet_and_face, float value, const Vec3& center,
                        double shrink) {
    const auto [tet, face] = tet_and_face;
    const DrawnVertices vertices{places_of(cells, choice), cells.vertices, choice.vertex_value};
    QuadraticTriangle t =
        quadratic_triangle(vertices, choice.edges, face_of(cells, tet, face), edges_of_face(cells, tet, face), value);
    for (Vec3& p : t.place) p += shrink * (center - p);
    add_quadratic(geometry, frame, t, pieces_of(t, cells.tets.size()), tet, !choice.places.empty());
}

// The points where the plane cuts a tetrahedron: three or four, in the order of going around, or none.
std::vector<ValuedPoint> section_of(const PartCells& cells, const CellChoice& choice, std::size_t tet,
                                    const std::array<double, 4>& distance) {
    const Places places = places_of(cells, choice);
    const auto corner = [&](std::size_t i) -> ValuedPoint {
        const std::int32_t v = cells.tets[tet][i];
        const float of_cell = choice.value.empty() ? 0 : choice.value[tet];
        return {places[v], choice.vertex_value.empty() ? of_cell : choice.vertex_value[v], cells.vertices[v]};
    };
    const auto between = [&](std::size_t i, std::size_t j) -> ValuedPoint {
        const double s = distance[i] / (distance[i] - distance[j]);
        const ValuedPoint a = corner(i), b = corner(j);
        return {a.place + s * (b.place - a.place), a.value + static_cast<float>(s) * (b.value - a.value),
                a.rest + s * (b.rest - a.rest)};
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

}  // namespace

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
        for (std::size_t k = 0; k < 4; ++k) d[k] = distance[cells.tets[t][k]];
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
        for (std::size_t k = 0; k < 4; ++k)  // the corner opposite to the face is none of the facet's
            if (std::find(facet.begin(), facet.end(), cells.tets[tet][k]) == facet.end()) values[tet][k] = of_facet[f];
    }
    return values;
}

std::shared_ptr<Geometry> cell_faces(const PartCells& cells, const Frame& frame, const CellChoice& choice) {
    auto geometry = std::make_shared<Geometry>();
    const std::vector<char> chosen = chosen_cells(cells, choice);
    const Places places = places_of(cells, choice);
    const auto is_open = [&](std::int32_t t, std::size_t face) {
        const CellId neighbour = cells.neighbours[t][face];
        return !neighbour.is_valid() || !chosen[neighbour.value()];
    };
    const auto is_outer = [&](std::int32_t t) {
        return is_open(t, 0) || is_open(t, 1) || is_open(t, 2) || is_open(t, 3);
    };
    const bool shrinks = choice.shrink > 0;
    const bool is_quadratic = !choice.edges.empty() && !cells.edges_of_tet.empty();
    for (std::int32_t t = 0; t < count_of(chosen); ++t) {
        if (!chosen[t]) continue;
        const bool outer = is_outer(t);
        if (!outer && !shrinks) continue;
        const float value = choice.value.empty() ? 0 : choice.value[t];
        const Vec3 center = center_of(places, cells.tets[t]);
        // A cell behind shrunk ones has those faces drawn that these would cover.
        const auto is_drawn = [&](std::size_t face) {
            if (outer) return shrinks || is_open(t, face);
            return is_outer(cells.neighbours[t][face].value());
        };
        for (std::size_t face = 0; face < 4; ++face) {
            if (!is_drawn(face)) continue;
            const Triangle corners = face_of(cells, t, face);
            const double shrink = outer ? choice.shrink : 0;
            const float of_face = choice.face_value.empty() ? value : choice.face_value[t][face];
            if (is_quadratic) {
                add_quadratic_face(*geometry, cells, frame, choice, {t, face}, of_face, center, shrink);
                continue;
            }
            add_triangle(*geometry, frame, shrunk(corners_at(places, corners), center, shrink), of_face, 7, t);
            if (!choice.vertex_value.empty()) set_corner_values(*geometry, corners, choice.vertex_value);
            if (!choice.places.empty()) add_rest(*geometry, frame, corners_at(cells.vertices, corners));
        }
    }
    return geometry;
}

std::shared_ptr<Geometry> cell_sections(const PartCells& cells, const Frame& frame, const CellChoice& choice) {
    auto geometry = std::make_shared<Geometry>();
    if (!choice.side) return geometry;
    const std::vector<char> chosen = chosen_cells(cells, choice);
    const Places places = places_of(cells, choice);
    for (std::int32_t t = 0; t < count_of(chosen); ++t) {
        if (!chosen[t]) continue;
        std::array<double, 4> distance = {};
        for (std::size_t k = 0; k < 4; ++k) distance[k] = choice.side->distance(places[cells.tets[t][k]]);
        std::vector<ValuedPoint> polygon = section_of(cells, choice, t, distance);
        if (polygon.empty()) continue;
        if (choice.shrink > 0) {
            Vec3 center = Vec3::Zero();
            for (const ValuedPoint& p : polygon) center += p.place / polygon.size();
            for (ValuedPoint& p : polygon) p.place += choice.shrink * (center - p.place);
        }
        face_towards(choice.side->normal, polygon);
        add_polygon(*geometry, frame, polygon, t, !choice.places.empty());
    }
    return geometry;
}

}  // namespace kerf::view
