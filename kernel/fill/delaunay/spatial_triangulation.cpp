// Points are inserted by the method of Bowyer and Watson (bowyer1981, watson1981): walk to the cell of the point
// (Devillers, Pion and Teillaud 2002, devillers2002), remove the cavity, which is all cells in whose spheres the point
// lies, and join the point with the faces around it. Both predicates are exact (Shewchuk 1997, shewchuk1997), and
// in_sphere() decides ties by a perturbation (Devillers and Teillaud 2011, devillers2011), so that the cavity is always
// star-shaped and the cells depend on the points alone. Ghost cells stand outside of the hull: the sphere of one is the
// half-space beyond its face.
//
// Once faces are constrained or cells were replaced, spheres no longer tell everything. Then the cavity grows only
// through faces that the point sees, and shrinks until it sees all faces around it; faces are "unseen" if the point is
// behind them or in their plane. Cells of the cavity are marked (EditableTets::Cell), and every way out of the search
// takes the marks back. New cells take the places of old ones, and find each other by a square table of edges
// (fill/delaunay/inside/star_edges.h), or by sorting where a star is too large for it.
#include "fill/delaunay/spatial_triangulation.h"

#include <algorithm>

#include "base/core/check.h"
#include "base/geometry/predicates.h"

namespace kerf {

namespace {

constexpr std::size_t cells_a_vertex = 7;  // a little more than the mean among random points

// Returns the orientation of a cell with p in place of its vertex i.
int orientation_with(const EditableTets& tets, CellId cell, int i, const Vec3& p) {
    const Tetrahedron& vertex = tets.vertices(cell);
    std::array<const Vec3*, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = k == i ? &p : &tets.points()[vertex[k]];
    return orientation(*corners[0], *corners[1], *corners[2], *corners[3]);
}

// Returns a face of the cell beyond which the point lies; 4 if there is none. The face through which the walk came is
// not asked.
int face_towards(const EditableTets& tets, const Vec3& p, CellId cell, int came_from, int first) {
    for (int k = 0; k < 4; ++k) {
        const int i = (first + k) & 3;
        if (i != came_from && orientation_with(tets, cell, i, p) < 0) return i;
    }
    return 4;
}

// Walks from cell to cell towards a point. Among Delaunay cells every walk ends (Edelsbrunner 1990, edelsbrunner1990);
// with constrained faces, one that always asks faces in the same order may turn in circles, so the first one is random.
template <bool stops_at_constraints>
CellId walk(const EditableTets& tets, const Vec3& p, CellId hint) {
    CellId cell = tets.is_ghost(hint) ? tets.neighbour(hint, 3) : hint;
    std::uint32_t random = 1;
    int came_from = 4;
    while (!tets.is_ghost(cell)) {
        random = random * 1664525 + 1013904223;
        const int i = face_towards(tets, p, cell, came_from, random >> 30);
        if (i == 4) break;
        if (stops_at_constraints && tets.is_constrained(cell_face(cell, i))) return CellId::none();
        const CellFace behind = tets.mirror(cell_face(cell, i));
        cell = cell_of(behind);
        came_from = index_in_cell(behind);
    }
    return stops_at_constraints && tets.is_ghost(cell) ? CellId::none() : cell;
}

std::int32_t vertex_at(const EditableTets& tets, const Vec3& p, CellId cell) {
    for (const std::int32_t v : tets.vertices(cell))
        if (v >= 0 && tets.points()[v] == p) return v;
    return EditableTets::none;
}

inline bool sphere_contains(const EditableTets& tets, CellId cell, const Vec3& p) {
    const Tetrahedron& v = tets.vertices(cell);
    const std::vector<Vec3>& points = tets.points();
    return in_sphere(points[v[0]], points[v[1]], points[v[2]], points[v[3]], p);
}

}  // namespace

SpatialTriangulation::SpatialTriangulation(const std::array<Vec3, 4>& corners, std::int32_t most)
    : EditableTets({corners.begin(), corners.end()}, most) {
    KERF_CHECK(orientation(corners[0], corners[1], corners[2], corners[3]) > 0);
    cell_at_vertex_.assign(4, CellId(0));
    cells_.push_back({{0, 1, 2, 3}, {}});
    for (int i = 0; i < 4; ++i) {
        // Seen from the ghost, which took the place of vertex i, the others turn the other way.
        Tetrahedron ghost_cell = {0, 1, 2, 3};
        ghost_cell[i] = ghost;
        std::swap(ghost_cell[i], ghost_cell[3]);
        if (i == 3) std::swap(ghost_cell[0], ghost_cell[1]);
        cells_.push_back({ghost_cell, {}});
    }
    for (std::int32_t v = 0; v < 4; ++v)
        for (int i = 0; i < 4; ++i) {
            // The four ghost cells lie around one tetrahedron: ghost cell 1 + v is the one without vertex v.
            const CellId cell(1 + v);
            const std::int32_t missing = cells_[cell].vertex[i];
            const CellId other(missing == ghost ? 0 : 1 + missing);
            cells_[cell].link[i] = cell_face(other, index_of(vertices(other), v));
            if (missing == ghost) cells_[CellId(0)].link[v] = cell_face(cell, i);
        }
}

void SpatialTriangulation::reserve(std::size_t vertices) {
    points_.reserve(vertices);
    cell_at_vertex_.reserve(vertices);
    cells_.reserve(cells_a_vertex * vertices);
    star_edges_.reserve_vertices(vertices);
}

// --- the place of a point ---

CellId SpatialTriangulation::locate(const Vec3& p, CellId hint) const { return walk<false>(*this, p, hint); }

CellId SpatialTriangulation::locate_in_sight(const Vec3& p, CellId hint) const { return walk<true>(*this, p, hint); }

// Returns the cell of a point. Without a hint the walk begins at the last cell made; where others have been replaced,
// that may be gone, and any other one will do.
CellId SpatialTriangulation::start_of(const Vec3& p, CellId hint) const {
    return locate(p, hint.is_valid() ? hint : std::min(last_cell_, CellId(cell_count() - 1)));
}

// --- The cells that a point removes ---

// The sphere of a ghost cell is the half-space beyond its face. In its plane, it is the disk of the face, which the
// sphere behind it has, too, with the same decision of ties: heights in a plane say nothing about those outside of it.
bool SpatialTriangulation::ghost_conflicts(CellId cell, const Vec3& p) const {
    const Tetrahedron& v = cells_[cell].vertex;
    const int side = orientation(points_[v[0]], points_[v[1]], points_[v[2]], p);
    if (side != 0) return side > 0;
    const CellId inside = neighbour(cell, 3);
    return cells_[inside].is_marked() || sphere_contains(*this, inside, p);
}

inline bool SpatialTriangulation::conflicts(CellId cell, const Vec3& p) const {
    return is_ghost(cell) ? ghost_conflicts(cell, p) : sphere_contains(*this, cell, p);
}

void SpatialTriangulation::unmark_cavity() {
    for (const CellId cell : cavity_) cells_[cell].flip_mark();
}

void SpatialTriangulation::grow_cavity(const Vec3& p, CellId start) {
    cavity_.assign(1, start);
    cells_[start].flip_mark();
    for (std::size_t k = 0; k < cavity_.size(); ++k) {
        const CellId cell = cavity_[k];
        for (int i = 0; i < 4; ++i) {
            const CellFace behind = cells_[cell].link[i];
            const CellId next = cell_of(behind);
            if (cells_[next].is_marked()) continue;
            if (conflicts(next, p)) {
                for (const CellFace beyond : cells_[next].link) __builtin_prefetch(&cells_[cell_of(beyond)]);
                cells_[next].flip_mark();
                cavity_.push_back(next);
            } else {
                cavity_faces_.push_back({cell_face(cell, i), behind});
            }
        }
    }
    unmark_cavity();
}

// Returns the vertices of a face of a marked cell.
Triangle SpatialTriangulation::cavity_face_vertices(CellFace face) const {
    Cell cell = cells_[cell_of(face)];
    cell.flip_mark();
    const auto& [i, j, k] = tet_faces[index_in_cell(face)];
    return {cell.vertex[i], cell.vertex[j], cell.vertex[k]};
}

// Returns 1 where p sees a face of a marked cell from inside of the cell, 0 where p lies in its plane.
int SpatialTriangulation::side_of(const Vec3& p, CellFace face) const {
    const auto [a, b, c] = cavity_face_vertices(face);
    return orientation(p, points()[a], points()[b], points()[c]);
}

// Grows the cavity by steps through faces that the point sees, or on which it lies. So all cells are found that it sees
// through others with spheres around it, and few that it does not see. Returns false if a face keeps the point off.
bool SpatialTriangulation::grow_cavity_in_sight(const Vec3& p, CellId start, const InsertionConditions& conditions) {
    unseen_.clear();
    cavity_.assign(1, start);
    cells_[start].flip_mark();
    for (std::size_t k = 0; k < cavity_.size(); ++k)
        for (int i = 0; i < 4; ++i) {
            const CellFace face = cell_face(cavity_[k], i), behind = link(face);
            const bool is_free = (behind & constraint) == 0;
            const CellId next = cell_of(behind & ~constraint);
            if (is_free && cells_[next].is_marked()) continue;
            const int side = side_of(p, face);
            if (side <= 0) unseen_.push_back(face);
            if (side < 0) continue;
            if (!is_free) {
                if (conditions.is_kept_off_by && conditions.is_kept_off_by(cavity_face_vertices(face))) return false;
            } else if (cavity_.size() < conditions.most_removed && !is_ghost(next) && sphere_contains(*this, next, p)) {
                cells_[next].flip_mark();
                cavity_.push_back(next);
            }
        }
    return true;
}

// Leaves the largest part of the cavity all of whose faces the point sees, in whatever order cells are taken away.
void SpatialTriangulation::shrink_cavity(const Vec3& p) {
    while (!unseen_.empty()) {
        const CellFace face = unseen_.back();
        unseen_.pop_back();
        const CellId cell = cell_of(face);
        if (!cells_[cell].is_marked() || is_inside_cavity(link(face))) continue;
        cells_[cell].flip_mark();
        has_left_cells_ = true;
        for (const CellFace behind : cells_[cell].link)
            if (is_inside_cavity(behind) && side_of(p, behind) <= 0) unseen_.push_back(behind);
    }
    if (has_left_cells_) std::erase_if(cavity_, [&](CellId cell) { return !cells_[cell].is_marked(); });
    for (const CellId cell : cavity_)
        for (int i = 0; i < 4; ++i)
            if (const CellFace face = cell_face(cell, i); !is_inside_cavity(link(face)))
                cavity_faces_.push_back({face, link(face)});
}

// Finds the cavity; returns false if the point may not be inserted. Among Delaunay cells the point sees all of its
// cavity. No vertex is lost: the cell behind it, seen from the point, has the point outside of its sphere.
bool SpatialTriangulation::find_cavity(const Vec3& p, CellId start, const InsertionConditions& conditions) {
    cavity_faces_.clear();
    has_left_cells_ = false;
    if (!is_altered_) {
        grow_cavity(p, start);
        return true;
    }
    if (is_ghost(start)) return false;
    const bool is_free = grow_cavity_in_sight(p, start, conditions);
    if (is_free) shrink_cavity(p);
    unmark_cavity();
    return is_free && !cavity_.empty();
}

// --- The cells that it brings ---

// New cells take the places of old ones first, of those with the lowest numbers: then none of them moves when the
// others are removed.
void SpatialTriangulation::place_cells() {
    star_edges_.set_vertex_count(points_.size());
    star_edges_.clear();
    new_cells_.resize(cavity_faces_.size());
    made_.resize(cavity_faces_.size());
    if (const std::size_t count = cavity_faces_.size(); count < cavity_.size())
        std::nth_element(cavity_.begin(), cavity_.begin() + count, cavity_.end());
    std::int32_t next_cell = cell_count();
    for (std::size_t k = 0; k < cavity_faces_.size(); ++k) {
        const auto [inside, outside] = cavity_faces_[k];
        const CellId cell = made_[k] = k < cavity_.size() ? cavity_[k] : CellId(next_cell++);
        const int i = index_in_cell(inside);
        NewCell& made = new_cells_[k];
        made.vertex = vertices(cell_of(inside));
        made.face = cell_face(cell, i);
        made.outside = outside;
        for (int j = 0; j < 3; ++j) {
            const std::int32_t v = made.vertex[tet_faces[i][j]];
            bool is_new = false;
            made.place[j] = star_edges_.place(v, is_new);
            if (is_new) cell_at_vertex_[v] = cell;
        }
    }
    cells_.resize(next_cell);
}

// Sets vertices and outer links of the new cells; their links to each other follow.
void SpatialTriangulation::set_cells(std::int32_t vertex) {
    for (const NewCell& made : new_cells_) {
        const int i = index_in_cell(made.face);
        Cell& cell = cells_[cell_of(made.face)];
        cell.vertex = made.vertex;
        cell.vertex[i] = vertex;
        cell.link[i] = made.outside;
        if (made.outside >= 0) link(made.outside & ~constraint) = made.face | (made.outside & constraint);
    }
}

// The face of a new cell opposite to the vertex tet_faces[i][k] has the edge between the other two.
void SpatialTriangulation::join_cells() {
    star_edges_.make_table();
    for (const NewCell& made : new_cells_) {
        const auto& [p, q, r] = made.place;
        const auto& [i, j, k] = tet_faces[index_in_cell(made.face)];
        const CellFace first = made.face & ~3;
        star_edges_.at(q, r) = first + i;
        star_edges_.at(r, p) = first + j;
        star_edges_.at(p, q) = first + k;
    }
    for (const NewCell& made : new_cells_) {
        const auto& [p, q, r] = made.place;
        const auto& [i, j, k] = tet_faces[index_in_cell(made.face)];
        auto& link = cells_[cell_of(made.face)].link;
        link[i] = star_edges_.at(r, q);
        link[j] = star_edges_.at(p, r);
        link[k] = star_edges_.at(q, p);
    }
}

void SpatialTriangulation::join_cells_of_large_star() {
    struct Edge {
        UndirectedEdge ends;
        CellFace face;
    };
    std::vector<Edge> edges;
    for (const NewCell& made : new_cells_)
        for (int k = 1; k < 4; ++k) {
            const auto [a, b] = other_two[index_in_cell(made.face)][index_in_cell(made.face) ^ k];
            edges.push_back({undirected(made.vertex[a], made.vertex[b]), made.face ^ k});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.ends < f.ends; });
    for (std::size_t k = 0; k < edges.size(); k += 2) {
        link(edges[k].face) = edges[k + 1].face;
        link(edges[k + 1].face) = edges[k].face;
    }
}

std::int32_t SpatialTriangulation::insert_in_cavity(const Vec3& p) {
    require_room(cavity_faces_.size());
    const std::int32_t vertex = add_vertex(p);
    place_cells();
    set_cells(vertex);
    star_edges_.is_large() ? join_cells_of_large_star() : join_cells();
    cell_at_vertex_[vertex] = made_[0];
    if (made_.size() < cavity_.size()) remove_cells(std::span(cavity_).subspan(made_.size()), {});
    last_cell_ = made_[0];
    return vertex;
}

std::int32_t SpatialTriangulation::insert(const Vec3& p, CellId hint) {
    const CellId start = start_of(p, hint);
    if (const std::int32_t same = vertex_at(*this, p, start); same != none) return same;
    return find_cavity(p, start, {}) ? insert_in_cavity(p) : none;
}

std::int32_t SpatialTriangulation::insert_if(const Vec3& p, CellId hint, const InsertionConditions& conditions) {
    const CellId start = start_of(p, hint);
    if (const std::int32_t same = vertex_at(*this, p, start); same != none) return same;
    if (!find_cavity(p, start, conditions)) return none;
    star_.faces.clear();
    for (const CavityFace& face : cavity_faces_)
        star_.faces.push_back({face_vertices(face.inside), (face.outside & constraint) != 0});
    star_.removed = cavity_;
    return conditions.accepts(star_) ? insert_in_cavity(p) : none;
}

void SpatialTriangulation::renumber(const std::vector<std::int32_t>& number, std::vector<Vec3> points) {
    std::vector<CellId> cell_at_vertex(points.size(), CellId::none());
    for (std::size_t v = 0; v < number.size(); ++v) cell_at_vertex[number[v]] = cell_at_vertex_[v];
    for (Cell& cell : cells_)
        for (std::int32_t& v : cell.vertex)
            if (v >= 0) v = number[v];
    cell_at_vertex_ = std::move(cell_at_vertex);
    points_ = std::move(points);
}

}  // namespace kerf
