#include "delaunay/triangulation.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/check.h"
#include "core/error.h"
#include "geometry/predicates.h"

namespace kerf {

namespace {

constexpr std::size_t cells_a_vertex = 7;  // a little more than there are among random points

// The two vertices of a cell that are neither i nor j, so that (i, j, first, second) is an even permutation.
constexpr std::array<std::array<std::array<int, 2>, 4>, 4> other_two = {{{{{0, 0}, {2, 3}, {3, 1}, {1, 2}}},
                                                                         {{{3, 2}, {0, 0}, {0, 3}, {2, 0}}},
                                                                         {{{1, 3}, {3, 0}, {0, 0}, {0, 1}}},
                                                                         {{{2, 1}, {0, 2}, {1, 0}, {0, 0}}}}};

}  // namespace

Triangulation::Triangulation(const std::array<Vec3, 4>& corners, std::int32_t most)
    : points_(corners.begin(), corners.end()), cell_at_vertex_(4, 0), most_(most) {
    KERF_CHECK(most <= most_cells);
    star_edges_.set_vertex_count(points_.size());
    KERF_CHECK(orientation(corners[0], corners[1], corners[2], corners[3]) > 0);
    cells_.push_back({{0, 1, 2, 3}, {}});
    for (int i = 0; i < 4; ++i) {
        // Seen from the ghost, which took the place of vertex i, the others turn the other way.
        Tetrahedron ghost_cell = {0, 1, 2, 3};
        ghost_cell[i] = ghost;
        std::swap(ghost_cell[i], ghost_cell[3]);
        if (i == 3) std::swap(ghost_cell[0], ghost_cell[1]);
        cells_.push_back({ghost_cell, {}});
    }
    for (std::int32_t cell = 1; cell <= 4; ++cell)
        for (int i = 0; i < 4; ++i) {
            // The four ghost cells lie around one tetrahedron: ghost cell 1 + v is the one without vertex v.
            const std::int32_t missing = cells_[cell].vertex[i];
            const std::int32_t other = missing == ghost ? 0 : 1 + missing;
            cells_[cell].link[i] = cell_face(other, index_of(other, cell - 1));
            if (missing == ghost) cells_[0].link[cell - 1] = cell_face(cell, i);
        }
}

void Triangulation::reserve(std::size_t vertices) {
    points_.reserve(vertices);
    cell_at_vertex_.reserve(vertices);
    cells_.reserve(cells_a_vertex * vertices);
    star_edges_.reserve_vertices(vertices);
}

Triangle Triangulation::face_vertices(CellFace face) const {
    constexpr std::array<std::array<int, 3>, 4> others = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const Tetrahedron& corners = cells_[cell_of(face)].vertex;
    const auto& [i, j, k] = others[index_in_cell(face)];
    return {corners[i], corners[j], corners[k]};
}

int Triangulation::index_of(std::int32_t cell, std::int32_t vertex) const {
    const Tetrahedron& corners = cells_[cell].vertex;
    return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

std::vector<std::int32_t> Triangulation::cells_around_vertex(std::int32_t vertex) {
    std::vector<std::int32_t> cells = {cell_at_vertex_[vertex]};
    const auto corners = [&](std::int32_t cell) {
        Cell copy = cells_[cell];
        copy.flip_mark();  // which all in the list have
        return copy.vertex;
    };
    cells_[cells[0]].flip_mark();
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const Tetrahedron of_cell = corners(cells[k]);
        for (int i = 0; i < 4; ++i) {
            const std::int32_t next = neighbour(cells[k], i);
            if (of_cell[i] == vertex || cells_[next].is_marked()) continue;
            cells_[next].flip_mark();
            cells.push_back(next);
        }
    }
    for (std::int32_t cell : cells) cells_[cell].flip_mark();
    return cells;
}

std::vector<std::int32_t> Triangulation::cells_around_edge(std::int32_t cell, int i, int j) const {
    const std::int32_t from = cells_[cell].vertex[i], to = cells_[cell].vertex[j];
    std::vector<std::int32_t> cells;
    std::int32_t current = cell;
    do {
        cells.push_back(current);
        current = neighbour(current, other_two[index_of(current, from)][index_of(current, to)][0]);
    } while (current != cell);
    return cells;
}

void Triangulation::constrain(CellFace face) {
    link(mirror(face)) |= constraint;
    link(face) |= constraint;
    has_constraints_ = true;
}

void Triangulation::set_region(std::int32_t cell, std::uint8_t region) {
    regions_.resize(cells_.size());
    regions_[cell] = region;
}

// --- Where a point is ---

// Of the tetrahedron with p in place of its vertex i.
int Triangulation::orientation_with(const Tetrahedron& vertex, int i, const Vec3& p) const {
    std::array<const Vec3*, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = k == i ? &p : &points_[vertex[k]];
    return orientation(*corners[0], *corners[1], *corners[2], *corners[3]);
}

// A face of the cell that the point is beyond; 4 if there is none. The face through which the walk came is not asked.
int Triangulation::face_towards(const Vec3& p, std::int32_t cell, int came_from, int first) const {
    for (int k = 0; k < 4; ++k) {
        const int i = (first + k) & 3;
        if (i != came_from && orientation_with(cells_[cell].vertex, i, p) < 0) return i;
    }
    return 4;
}

// Among Delaunay cells every walk ends (edelsbrunner1990); with constrained faces one that always asks the faces in the
// same order may turn in circles.
template <bool stops_at_constraints>
std::int32_t Triangulation::walk(const Vec3& p, std::int32_t hint) const {
    std::int32_t cell = is_ghost(hint) ? neighbour(hint, 3) : hint;
    std::uint32_t random = 1;
    int came_from = 4;
    while (!is_ghost(cell)) {
        random = random * 1664525 + 1013904223;
        const int i = face_towards(p, cell, came_from, static_cast<int>(random >> 30));
        if (i == 4) break;
        if (stops_at_constraints && is_constrained(cell_face(cell, i))) return none;
        const CellFace behind = mirror(cell_face(cell, i));
        cell = cell_of(behind);
        came_from = index_in_cell(behind);
    }
    return stops_at_constraints && is_ghost(cell) ? none : cell;
}

std::int32_t Triangulation::locate(const Vec3& p, std::int32_t hint) const { return walk<false>(p, hint); }

std::int32_t Triangulation::locate_in_sight(const Vec3& p, std::int32_t hint) const { return walk<true>(p, hint); }

std::int32_t Triangulation::vertex_at(const Vec3& p, std::int32_t cell) const {
    for (std::int32_t v : cells_[cell].vertex)
        if (v >= 0 && points_[v] == p) return v;
    return none;
}

// --- The cells that a point removes ---

bool Triangulation::sphere_contains(std::int32_t cell, const Vec3& p) const {
    const Tetrahedron& v = cells_[cell].vertex;
    return in_sphere(points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]], p);
}

// The sphere of a ghost cell is the half-space beyond its face. In its plane, it is the disk of the face, which the
// sphere behind it has, too, with the same decision of ties: heights in a plane say nothing about those outside of it.
bool Triangulation::conflicts(std::int32_t cell, const Vec3& p) const {
    if (!is_ghost(cell)) return sphere_contains(cell, p);
    const Tetrahedron& v = cells_[cell].vertex;
    const int side = orientation(points_[v[0]], points_[v[1]], points_[v[2]], p);
    if (side != 0) return side > 0;
    const std::int32_t inside = neighbour(cell, 3);
    return cells_[inside].is_marked() || sphere_contains(inside, p);
}

bool Triangulation::may_be_removed(std::int32_t cell, const Vec3& p) const {
    if (has_constraints_)
        if (is_ghost(cell) || std::find(refused_.begin(), refused_.end(), cell) != refused_.end()) return false;
    return conflicts(cell, p);
}

void Triangulation::grow_cavity(const Vec3& p, std::int32_t start) {
    cavity_faces_.clear();
    cavity_.assign(1, start);
    cells_[start].flip_mark();
    for (std::size_t k = 0; k < cavity_.size(); ++k) {
        const std::int32_t cell = cavity_[k];
        for (int i = 0; i < 4; ++i) {
            const CellFace behind = cells_[cell].link[i];
            const bool is_free = (behind & constraint) == 0;
            const std::int32_t next = cell_of(behind & ~constraint);
            if (is_free && cells_[next].is_marked()) continue;
            if (is_free && may_be_removed(next, p)) {
                for (const CellFace beyond : cells_[next].link) prefetch(cell_of(beyond & ~constraint));
                cells_[next].flip_mark();
                cavity_.push_back(next);
            } else {
                cavity_faces_.push_back({cell_face(cell, i), behind});
            }
        }
    }
}

void Triangulation::release_cavity() {
    for (std::int32_t cell : cavity_) cells_[cell].flip_mark();
}

// False if the point sees all faces of the cavity from inside.
bool Triangulation::refuse_unseen_cells(const Vec3& p) {
    const std::size_t refused_before = refused_.size();
    for (const CavityFace& face : cavity_faces_)
        if (orientation_with(vertices(cell_of(face.inside)), index_in_cell(face.inside), p) <= 0)
            refused_.push_back(cell_of(face.inside));
    return refused_.size() > refused_before;
}

// Cells of the cavity are not marked any more. False if the point may not be inserted. Among Delaunay cells the point
// sees all of its cavity. No vertex is lost: the cell behind it, seen from the point, has the point outside of its
// sphere.
bool Triangulation::find_cavity(const Vec3& p, std::int32_t start) {
    refused_.clear();
    if (has_constraints_ && is_ghost(start)) return false;
    do {
        if (std::find(refused_.begin(), refused_.end(), start) != refused_.end()) return false;
        grow_cavity(p, start);
        release_cavity();
    } while (has_constraints_ && refuse_unseen_cells(p));
    return true;
}

// --- The cells that it brings ---

// New cells take the places of old ones first.
void Triangulation::place_cells() {
    star_edges_.clear();
    new_cells_.clear();
    std::int32_t next_cell = cell_count();
    for (const auto& [inside, outside] : cavity_faces_) {
        const std::size_t k = new_cells_.size();
        const std::int32_t cell = k < cavity_.size() ? cavity_[k] : next_cell++;
        const int i = index_in_cell(inside);
        NewCell& made = new_cells_.emplace_back();
        made.vertex = vertices(cell_of(inside));
        made.face = cell_face(cell, i);
        made.outside = outside;
        for (int j = 1; j < 4; ++j) {
            bool is_new = false;
            made.place[i ^ j] = star_edges_.place(made.vertex[i ^ j], is_new);
            if (is_new) cell_at_vertex_[made.vertex[i ^ j]] = cell;
        }
    }
    cells_.resize(static_cast<std::size_t>(next_cell));
    if (!regions_.empty()) regions_.resize(cells_.size(), regions_[cavity_[0]]);
}

void Triangulation::set_cell(const NewCell& made, std::int32_t vertex) {
    const int i = index_in_cell(made.face);
    Cell& cell = cells_[cell_of(made.face)];
    cell.vertex = made.vertex;
    cell.vertex[i] = vertex;
    cell.link[i] = made.outside;
    link(made.outside & ~constraint) = made.face | (made.outside & constraint);
}

void Triangulation::join_cells() {
    star_edges_.make_table();
    for (const NewCell& made : new_cells_)
        for (int k = 1; k < 4; ++k) {
            const auto [a, b] = other_two[index_in_cell(made.face)][index_in_cell(made.face) ^ k];
            star_edges_.at(made.place[a], made.place[b]) = made.face ^ k;
        }
    for (const NewCell& made : new_cells_)
        for (int k = 1; k < 4; ++k) {
            const auto [a, b] = other_two[index_in_cell(made.face)][index_in_cell(made.face) ^ k];
            link(made.face ^ k) = star_edges_.at(made.place[b], made.place[a]);
        }
}

void Triangulation::join_cells_of_large_star() {
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

void Triangulation::fill_cavity(std::int32_t vertex) {
    place_cells();
    for (const NewCell& made : new_cells_) set_cell(made, vertex);
    star_edges_.is_large() ? join_cells_of_large_star() : join_cells();
    last_cell_ = cell_at_vertex_[vertex] = cell_of(new_cells_[0].face);
    const std::size_t reused = std::min(cavity_.size(), new_cells_.size());
    if (reused < cavity_.size()) remove_cells({cavity_.begin() + static_cast<std::ptrdiff_t>(reused), cavity_.end()});
}

// The last cells move to where the removed ones were.
void Triangulation::remove_cells(std::vector<std::int32_t> cells) {
    std::sort(cells.begin(), cells.end(), std::greater<>());
    for (std::int32_t cell : cells) {
        if (cell != cell_count() - 1) move_cell(cell_count() - 1, cell);
        cells_.pop_back();
        if (!regions_.empty()) regions_.pop_back();
    }
}

void Triangulation::move_cell(std::int32_t from, std::int32_t to) {
    cells_[to] = cells_[from];
    if (!regions_.empty()) regions_[to] = regions_[from];
    for (int i = 0; i < 4; ++i) {
        const CellFace behind = cells_[to].link[i];
        link(behind & ~constraint) = cell_face(to, i) | (behind & constraint);
    }
    for (std::int32_t v : cells_[to].vertex)
        if (v >= 0) cell_at_vertex_[v] = to;
    if (last_cell_ == from) last_cell_ = to;
}

std::int32_t Triangulation::insert(const Vec3& p, std::int32_t hint) {
    const std::int32_t start = locate(p, hint == none ? last_cell_ : hint);
    if (const std::int32_t same = vertex_at(p, start); same != none) return same;
    return find_cavity(p, start) ? insert_in_cavity(p) : none;
}

std::int32_t Triangulation::insert_if(const Vec3& p, std::int32_t hint,
                                      const std::function<bool(const Star&)>& accepts) {
    const std::int32_t start = locate(p, hint == none ? last_cell_ : hint);
    if (const std::int32_t same = vertex_at(p, start); same != none) return same;
    if (!find_cavity(p, start)) return none;
    star_.faces.clear();
    for (const CavityFace& face : cavity_faces_)
        star_.faces.push_back({face_vertices(face.inside), (face.outside & constraint) != 0});
    star_.removed = cavity_;
    return accepts(star_) ? insert_in_cavity(p) : none;
}

// Before anything is changed.
void Triangulation::require_room(std::size_t more_cells) const {
    if (cells_.size() + more_cells > static_cast<std::size_t>(most_))
        throw Error(ErrorCode::memory, fmt::format("A triangulation of {} points has {} cells; more than {} cannot be "
                                                   "numbered. Divide the surface into more parts.",
                                                   points_.size(), cell_count(), most_));
}

std::int32_t Triangulation::insert_in_cavity(const Vec3& p) {
    require_room(cavity_faces_.size());
    const std::int32_t vertex = add_vertex(p);
    fill_cavity(vertex);
    return vertex;
}

// --- Cells in place of others ---

std::int32_t Triangulation::add_vertex(const Vec3& p) {
    points_.push_back(p);
    cell_at_vertex_.push_back(none);
    star_edges_.set_vertex_count(points_.size());
    return static_cast<std::int32_t>(points_.size()) - 1;
}

void Triangulation::remove_unused_vertices(std::size_t count) {
    for (std::size_t v = count; v < points_.size(); ++v) KERF_CHECK(cell_at_vertex_[v] == none);
    points_.resize(count);
    cell_at_vertex_.resize(count);
    star_edges_.set_vertex_count(count);
}

void Triangulation::replace(std::span<const std::int32_t> cells, std::span<const Tetrahedron> by) {
    struct OpenFace {
        Triangle vertices;  // ascending
        CellFace side;      // and `constraint` for those that stay
    };
    const auto key_of = [&](CellFace face) {
        Triangle key = face_vertices(face);
        std::sort(key.begin(), key.end());
        return key;
    };
    if (by.size() > cells.size()) require_room(by.size() - cells.size());
    std::vector<std::int32_t> old(cells.begin(), cells.end());
    std::vector<OpenFace> open;
    for (const std::int32_t cell : old) cells_[cell].flip_mark();
    for (const std::int32_t cell : old)
        for (int i = 0; i < 4; ++i) {
            const CellFace behind = cells_[cell].link[i];
            if (cells_[cell_of(behind & ~constraint)].is_marked()) continue;
            open.push_back({key_of(behind & ~constraint), behind});
        }
    for (const std::int32_t cell : old) cells_[cell].flip_mark();
    const std::uint8_t region = this->region(old[0]);
    while (old.size() < by.size()) {
        old.push_back(cell_count());
        cells_.emplace_back();
        if (!regions_.empty()) regions_.push_back(region);
    }
    for (std::size_t k = 0; k < by.size(); ++k) {
        cells_[old[k]].vertex = by[k];
        for (int i = 0; i < 4; ++i) {
            if (by[k][i] >= 0) cell_at_vertex_[by[k][i]] = old[k];
            const CellFace face = cell_face(old[k], i);
            const Triangle key = key_of(face);
            const auto other = std::find_if(open.begin(), open.end(),
                                            [&](const OpenFace& open_face) { return open_face.vertices == key; });
            if (other == open.end()) {
                open.push_back({key, face});
                continue;
            }
            link(face) = other->side;
            link(other->side & ~constraint) = face | (other->side & constraint);
            open.erase(other);
        }
    }
    KERF_CHECK(open.empty());
    last_cell_ = old[0];
    if (by.size() < old.size()) remove_cells({old.begin() + static_cast<std::ptrdiff_t>(by.size()), old.end()});
}

void Triangulation::renumber(const std::vector<std::int32_t>& number, std::vector<Vec3> points) {
    std::vector<std::int32_t> cell_at_vertex(points.size(), none);
    for (std::size_t v = 0; v < number.size(); ++v) cell_at_vertex[number[v]] = cell_at_vertex_[v];
    for (Cell& cell : cells_)
        for (std::int32_t& v : cell.vertex)
            if (v >= 0) v = number[v];
    cell_at_vertex_ = std::move(cell_at_vertex);
    points_ = std::move(points);
    star_edges_.set_vertex_count(points_.size());
}

}  // namespace kerf
