// The ring of an edge is its cells in order, and spoke k of it leads to the ring's vertex k (Si 2015, si2015, for the
// recursion). Removing an edge with a ring of n cells needs a triangulation of the ring's polygon; where there is none
// with positive cells, a flip of a face at the edge takes a vertex out of the ring. A face cannot be flipped where an
// edge from its spoke's vertex to an end of the edge is reflex; then that edge is removed by the same method, one level
// deeper. `above_` is the stack of edges for which this is done. The cells around them must stay as they are, so that a
// ring which shares more than two cells with theirs, or a face next to them, is not touched. After a removal cells may
// have other numbers: a ring is found again by a cell with its edge (cell_with()).
#include "fill/shell/inside/nested_edge_removal.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/core/ids.h"
#include "base/geometry/predicates.h"

namespace kerf {

namespace {

bool has_edge(const Tetrahedron& cell, const UndirectedEdge& edge) {
    return index_of(cell, edge[0]) < 4 && index_of(cell, edge[1]) < 4;
}

// Vertex k of a ring and those before and after it.
struct Spoke {
    std::int32_t before, at, after;
    bool has_ghost() const { return std::min({before, at, after}) < 0; }
};

Spoke spoke(const EdgeRing& ring, std::size_t k) {
    const std::size_t n = ring.size();
    return {ring.ring[(k + n - 1) % n], ring.ring[k], ring.ring[(k + 1) % n]};
}

}  // namespace

bool NestedEdgeRemoval::remove(CellId cell, std::int32_t a, std::int32_t b) {
    has_changed_ = false;
    above_.clear();
    return remove(cell, undirected(a, b), {});
}

// Removes an edge. `kept`: two vertices of the ring whose edge must be there afterwards, or none.
bool NestedEdgeRemoval::remove(CellId cell, const UndirectedEdge& edge, std::span<const std::int32_t> kept) {
    if (is_kept_(edge[0], edge[1])) return false;
    EdgeRing ring = ring_around(t_, cell, edge[0], edge[1]);
    if (overlaps_rings_above(ring)) return false;
    while (--limits_.rings >= 0) {
        if (remove_at_once(ring, kept)) return true;
        if (ring.size() == 3 || !(flip_face(ring) || remove_reflex_edge(ring))) return false;
        const CellId next = cell_with(edge, ring);
        if (!next.is_valid()) return true;
        ring = ring_around(t_, next, edge[0], edge[1]);
    }
    return false;
}

// Removes the edge with all cells of its ring. At the top level, the goal is made of the ring if that has all of its
// corners.
bool NestedEdgeRemoval::remove_at_once(const EdgeRing& ring, std::span<const std::int32_t> kept) {
    const Goal& goal = limits_.goal;
    const NewVertices new_vertices = limits_.new_vertices;
    const auto corners = goal.corners();
    const bool has_goal =
        above_.empty() && !corners.empty() &&
        std::all_of(corners.begin(), corners.end(), [&](std::int32_t v) { return ring.place_of(v) < ring.size(); });
    const bool is_done =
        (has_goal && goal.is_edge() && span_ring(t_, ring, corners[0], corners[1], goal, new_vertices)) ||
        (has_goal && remove_ring_edge(t_, ring, corners, goal, new_vertices)) || remove_ring_edge(t_, ring, kept, goal);
    has_changed_ = has_changed_ || is_done;
    return is_done;
}

// Whether one of the cells next to vertex k is in the ring of an edge above.
bool NestedEdgeRemoval::is_at_ring_above(const EdgeRing& ring, std::size_t k) const {
    const std::array cells = {ring.cells[k], ring.cells[(k + ring.size() - 1) % ring.size()]};
    return std::any_of(above_.begin(), above_.end(), [&](const UndirectedEdge& edge) {
        return has_edge(t_.vertices(cells[0]), edge) || has_edge(t_.vertices(cells[1]), edge);
    });
}

// Whether a ring has cells of rings above, beside the two cells at the face between an edge and the one for which it is
// removed.
bool NestedEdgeRemoval::overlaps_rings_above(const EdgeRing& ring) const {
    int common = 0;
    for (const CellId cell : ring.cells)
        for (const UndirectedEdge& edge : above_) common += has_edge(t_.vertices(cell), edge);
    return common > 2;
}

// Flips a face at the edge; false if none can be flipped.
bool NestedEdgeRemoval::flip_face(const EdgeRing& ring) {
    const auto& p = t_.points();
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Spoke at = spoke(ring, k);
        if (at.has_ghost() || orientation(p[ring.a], p[ring.b], p[at.before], p[at.after]) <= 0 ||
            is_at_ring_above(ring, k))
            continue;
        const CellId cell = ring.cells[k];
        if (replace_face_by_edge(t_, cell_face(cell, index_of(t_.vertices(cell), at.after)), limits_.goal))
            return has_changed_ = true;
    }
    return false;
}

// Removes a reflex edge of the ring; false if none could be removed. The ring is as before then, though its cells may
// have other numbers.
bool NestedEdgeRemoval::remove_reflex_edge(EdgeRing& ring) {
    if (count_of(above_) >= limits_.depth) return false;
    const UndirectedEdge edge = undirected(ring.a, ring.b);
    const std::vector<std::int32_t> vertices = ring.ring;
    for (const std::int32_t vertex : vertices) {
        const std::size_t k = ring.place_of(vertex);
        const std::int32_t end = k < ring.size() ? reflex_end(ring, k) : SpatialTriangulation::none;
        if (end == SpatialTriangulation::none) continue;
        const Spoke at = spoke(ring, k);
        above_.push_back(edge);
        const bool is_removed = remove(ring.cells[k], undirected(end, vertex), std::array{at.before, at.after});
        above_.pop_back();
        if (is_removed) return true;
        const CellId cell = cell_with(edge, ring);
        if (!cell.is_valid()) return true;
        ring = ring_around(t_, cell, edge[0], edge[1]);
    }
    return false;
}

// Returns the end of a ring's edge from which the edge to vertex k of the ring is reflex; none if there is none, or if
// the cells there must stay.
std::int32_t NestedEdgeRemoval::reflex_end(const EdgeRing& ring, std::size_t k) const {
    const Spoke at = spoke(ring, k);
    if (at.has_ghost() || is_at_ring_above(ring, k)) return SpatialTriangulation::none;
    const auto& p = t_.points();
    if (orientation(p[ring.b], p[at.at], p[at.before], p[at.after]) <= 0) return ring.b;
    if (orientation(p[at.at], p[ring.a], p[at.before], p[at.after]) <= 0) return ring.a;
    return SpatialTriangulation::none;
}

// Returns one of the cells around an edge, most often one of those that it had; none if the edge is gone.
CellId NestedEdgeRemoval::cell_with(const UndirectedEdge& edge, const EdgeRing& before) {
    for (const CellId cell : before.cells)
        if (cell.value() < t_.cell_count() && has_edge(t_.vertices(cell), edge)) return cell;
    t_.find_star(t_.cell_at(edge[0]), edge[0], star_);
    const auto found =
        std::find_if(star_.begin(), star_.end(), [&](CellId cell) { return has_edge(t_.vertices(cell), edge); });
    return found == star_.end() ? CellId::none() : *found;
}

}  // namespace kerf
