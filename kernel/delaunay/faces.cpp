// Triangles are listed by their smallest vertex, with the other two in the order in which they follow it; then all
// faces are looked up once.
#include "delaunay/faces.h"

#include "core/check.h"

namespace kerf {

namespace {

// Turned so that the smallest vertex is the first one.
Triangle smallest_first(const Triangle& t) {
    if (t[0] < t[1]) return t[0] < t[2] ? t : Triangle{t[2], t[0], t[1]};
    return t[1] < t[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

// The vertices of face i, counter-clockwise seen from outside of the cell.
Triangle vertices_of_face(const Tetrahedron& cell, int i) {
    constexpr std::array<std::array<int, 3>, 4> others = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    return {cell[others[i][0]], cell[others[i][1]], cell[others[i][2]]};
}

// Triangles start[v] to start[v + 1] of the list have the smallest vertex v.
struct TrianglesByVertex {
    std::vector<std::int32_t> start, list;
};

TrianglesByVertex by_smallest_vertex(const std::vector<Triangle>& triangles, std::size_t vertices) {
    TrianglesByVertex sorted{std::vector<std::int32_t>(vertices + 1), std::vector<std::int32_t>(triangles.size())};
    for (const Triangle& triangle : triangles) ++sorted.start[triangle[0]];
    std::int32_t end = 0;
    for (std::int32_t& start : sorted.start) start = end += start;
    for (std::size_t t = triangles.size(); t-- > 0;)
        sorted.list[--sorted.start[triangles[t][0]]] = static_cast<std::int32_t>(t);
    return sorted;
}

}  // namespace

std::vector<CellFace> find_faces(const Triangulation& triangulation, const std::vector<Triangle>& triangles) {
    std::vector<Triangle> rotated;
    rotated.reserve(triangles.size());
    for (const Triangle& triangle : triangles) rotated.push_back(smallest_first(triangle));
    const auto [start, list] = by_smallest_vertex(rotated, triangulation.points().size());
    std::vector<CellFace> faces(triangles.size(), Triangulation::none);
    for (std::int32_t cell = 0; cell < triangulation.cell_count(); ++cell)
        for (int i = 0; i < 4; ++i) {
            const CellFace face = cell_face(cell, i), behind = triangulation.mirror(face);
            if (behind < face || (triangulation.is_ghost(cell) && i != 3)) continue;
            const Triangle seen = smallest_first(vertices_of_face(triangulation.vertices(cell), i));
            const Triangle reversed = {seen[0], seen[2], seen[1]};
            for (std::int32_t k = start[seen[0]]; k < start[seen[0] + 1]; ++k) {
                if (rotated[list[k]] == seen) faces[list[k]] = face;
                if (rotated[list[k]] == reversed) faces[list[k]] = behind;
            }
        }
    return faces;
}

std::optional<std::vector<bool>> cells_behind(const Triangulation& triangulation, const std::vector<CellFace>& faces) {
    std::vector<bool> is_behind(static_cast<std::size_t>(triangulation.cell_count()));
    std::vector<std::int32_t> found;
    const auto reach = [&](std::int32_t cell) {
        if (is_behind[cell]) return;
        is_behind[cell] = true;
        found.push_back(cell);
    };
    for (const CellFace face : faces) {
        KERF_CHECK(triangulation.is_constrained(face));
        reach(cell_of(face));
    }
    while (!found.empty()) {
        const std::int32_t cell = found.back();
        found.pop_back();
        if (triangulation.is_ghost(cell)) return std::nullopt;
        for (int i = 0; i < 4; ++i)
            if (!triangulation.is_constrained(cell_face(cell, i))) reach(triangulation.neighbour(cell, i));
    }
    for (const CellFace face : faces)
        if (is_behind[cell_of(triangulation.mirror(face))]) return std::nullopt;
    return is_behind;
}

}  // namespace kerf
