// Triangles are listed by their smallest vertex, with the other two in the order in which they follow it; then all
// faces are looked up once.
#include "fill/delaunay/enclosing_faces.h"

#include <algorithm>
#include <cstdint>

#include "base/core/check.h"
#include "base/core/ids.h"

namespace kerf {

namespace {

// Returns the triangle turned so that the smallest vertex is the first one.
Triangle smallest_first(const Triangle& t) {
    if (t[0] < t[1]) return t[0] < t[2] ? t : Triangle{t[2], t[0], t[1]};
    return t[1] < t[2] ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

// The second and third vertex of a triangle that is turned so, as one number.
std::uint64_t other_vertices(std::int32_t second, std::int32_t third) {
    return static_cast<std::uint64_t>(second) << 32 | static_cast<std::uint32_t>(third);
}

// Entries start[v] to start[v + 1] of the list have the smallest vertex v.
struct TrianglesByVertex {
    struct Entry {
        std::uint64_t others;
        std::int32_t triangle;
    };
    std::vector<std::int32_t> start;
    std::vector<Entry> list;
};

TrianglesByVertex by_smallest_vertex(const std::vector<Triangle>& triangles, std::size_t vertices) {
    TrianglesByVertex sorted{std::vector<std::int32_t>(vertices + 1),
                             std::vector<TrianglesByVertex::Entry>(triangles.size())};
    for (const auto& [a, b, c] : triangles) ++sorted.start[std::min({a, b, c})];
    std::int32_t end = 0;
    for (std::int32_t& start : sorted.start) start = end += start;
    for (std::int32_t t = count_of(triangles); t-- > 0;) {
        const Triangle turned = smallest_first(triangles[t]);
        sorted.list[--sorted.start[turned[0]]] = {other_vertices(turned[1], turned[2]), t};
    }
    return sorted;
}

}  // namespace

std::vector<CellFace> find_faces(const SpatialTriangulation& triangulation, const std::vector<Triangle>& triangles) {
    const auto [start, list] = by_smallest_vertex(triangles, triangulation.points().size());
    std::vector<CellFace> faces(triangles.size(), SpatialTriangulation::none);
    for (const CellId cell : triangulation.cells())
        for (int i = triangulation.is_ghost(cell) ? 3 : 0; i < 4; ++i) {
            const CellFace face = cell_face(cell, i), behind = triangulation.mirror(face);
            if (behind < face) continue;
            const Triangle seen = smallest_first(triangulation.face_vertices(face));
            const std::uint64_t others = other_vertices(seen[1], seen[2]), reversed = other_vertices(seen[2], seen[1]);
            for (std::int32_t k = start[seen[0]]; k < start[seen[0] + 1]; ++k) {
                if (list[k].others == others) faces[list[k].triangle] = face;
                if (list[k].others == reversed) faces[list[k].triangle] = behind;
            }
        }
    return faces;
}

std::optional<std::vector<bool>> cells_behind(const SpatialTriangulation& triangulation,
                                              const std::vector<CellFace>& faces) {
    std::vector<bool> is_behind(triangulation.cell_count());
    std::vector<CellId> found;
    const auto reach = [&](CellId cell) {
        if (is_behind[cell.value()]) return;
        is_behind[cell.value()] = true;
        found.push_back(cell);
    };
    for (const CellFace face : faces) {
        KERF_CHECK(triangulation.is_constrained(face));
        reach(cell_of(face));
    }
    while (!found.empty()) {
        const CellId cell = found.back();
        found.pop_back();
        if (triangulation.is_ghost(cell)) return std::nullopt;
        for (int i = 0; i < 4; ++i)
            if (!triangulation.is_constrained(cell_face(cell, i))) reach(triangulation.neighbour(cell, i));
    }
    for (const CellFace face : faces)
        if (is_behind[cell_of(triangulation.mirror(face)).value()]) return std::nullopt;
    return is_behind;
}

}  // namespace kerf
