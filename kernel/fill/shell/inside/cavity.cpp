#include "fill/shell/inside/cavity.h"

#include <algorithm>

namespace kerf {

namespace {

template <class All, class One>
bool has(const All& all, const One& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

std::vector<CellFace> sides_of(const EditableTets& tets, std::span<const CellId> cavity) {
    std::vector<CellFace> sides;
    for (const CellId cell : cavity)
        for (int i = 0; i < 4; ++i)
            if (!has(cavity, tets.neighbour(cell, i))) sides.push_back(cell_face(cell, i));
    return sides;
}

bool may_be_removed(const EditableTets& tets, std::span<const CellId> cavity, const IsKept& is_kept) {
    std::vector<std::int32_t> vertices;
    std::vector<UndirectedEdge> edges;
    for (const CellFace side : sides_of(tets, cavity)) {
        const Triangle corners = tets.face_vertices(side);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
        for (int i = 0; i < 3; ++i) edges.push_back(undirected(corners[i], corners[(i + 1) % 3]));
    }
    for (const CellId cell : cavity) {
        const Tetrahedron& v = tets.vertices(cell);
        for (int i = 0; i < 4; ++i) {
            if (!has(vertices, v[i])) return false;
            if (tets.is_constrained(cell_face(cell, i)) && has(cavity, tets.neighbour(cell, i))) return false;
            for (int j = i + 1; j < 4; ++j)
                if (const UndirectedEdge edge = undirected(v[i], v[j]); !has(edges, edge) && is_kept(edge[0], edge[1]))
                    return false;
        }
    }
    return true;
}

}  // namespace kerf
