// All changes are replace(): old cells go, new ones take their places in the arrays, and links are made by matching
// faces. `open_` holds faces of which one side is known, by their ascending vertices: first the outer faces of the old
// cells, with the sides behind them, then each face of a new cell either finds its other side there or waits in it. At
// the end nothing may wait. The list is searched from end to end, which is quickest for the few faces that a change
// has. Links of the cells behind are corrected as faces meet, so that only cells next to the change are touched.
//
// Cells are marked by complementing vertex 0 while they are looked for; every search takes its marks back. take_mesh()
// uses the same place for new numbers. Cells made of points stay without gaps, as the last ones move into the places of
// removed ones; cells made of a mesh keep their numbers, and removed ones leave gaps (`keeps_numbers_`).
#include "fill/mesh/editable_tets.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "fill/mesh/adjacency.h"

namespace kerf {

namespace {

Triangle ascending_face(const Tetrahedron& vertices, int i) {
    Triangle face = {vertices[i ^ 1], vertices[i ^ 2], vertices[i ^ 3]};
    std::sort(face.begin(), face.end());
    return face;
}

}  // namespace

EditableTets::EditableTets(std::vector<Vec3> points, std::int32_t most)
    : points_(std::move(points)), cell_at_vertex_(points_.size(), CellId::none()), most_(most) {
    KERF_CHECK(most <= most_cells);
}

EditableTets::EditableTets(TetMesh mesh, std::int32_t most)
    : cell_at_vertex_(mesh.vertices.size(), CellId::none()), most_(most), keeps_numbers_(true) {
    KERF_CHECK(most <= most_cells);
    require_room(mesh.tets.size());
    if (mesh.neighbours.empty()) connect_tets(mesh);
    cells_.reserve(mesh.tets.size());
    for (const CellId cell : mesh.tets.ids()) {
        Cell& made = cells_.emplace_back(Cell{mesh.tets[cell], {none, none, none, none}});
        for (int i = 0; i < 4; ++i) {
            cell_at_vertex_[made.vertex[i]] = cell;
            if (const CellId other = mesh.neighbours[cell][i]; other.is_valid())
                made.link[i] = cell_face(other, index_of(mesh.neighbours[other], cell));
        }
    }
    points_ = std::move(mesh.vertices);
}

TetMesh EditableTets::take_mesh(bool with_neighbours) {
    TetMesh mesh;
    const auto is_taken = [&](CellId cell) { return cells_[cell].vertex[0] >= 0; };
    std::size_t count = 0;
    for (const CellId cell : cells()) count += is_taken(cell);
    mesh.tets.reserve(count);
    for (const CellId cell : cells())
        if (is_taken(cell)) {
            mesh.tets.push_back(cells_[cell].vertex);
            cells_[cell].vertex[0] = count_of(mesh.tets) - 1;  // its new number
        } else {
            cells_[cell].vertex[0] = none;
        }
    if (with_neighbours) mesh.neighbours.reserve(count);
    for (const CellId cell : ids<CellId>(with_neighbours ? cell_count() : 0)) {
        if (cells_[cell].vertex[0] == none) continue;
        auto& neighbours = mesh.neighbours.emplace_back();
        for (int i = 0; i < 4; ++i)
            neighbours[i] =
                is_constrained(cell_face(cell, i)) ? CellId::none() : CellId(cells_[neighbour(cell, i)].vertex[0]);
    }
    mesh.vertices = std::move(points_);
    *this = EditableTets();
    return mesh;
}

std::vector<CellId> EditableTets::cells_around_vertex(std::int32_t vertex) {
    std::vector<CellId> cells;
    find_star(cell_at_vertex_[vertex], vertex, cells);
    return cells;
}

void EditableTets::find_star(CellId cell, std::int32_t vertex, std::vector<CellId>& star) {
    star.assign(1, cell);
    cells_[cell].flip_mark();
    for (std::size_t k = 0; k < star.size(); ++k) {
        Cell at = cells_[star[k]];
        at.flip_mark();  // all cells of the star have it
        for (int i = 0; i < 4; ++i) {
            const CellId next = cell_of(at.link[i] & ~constraint);
            if (at.vertex[i] == vertex || cells_[next].is_marked()) continue;
            cells_[next].flip_mark();
            star.push_back(next);
        }
    }
    for (const CellId found : star) cells_[found].flip_mark();
}

void EditableTets::constrain(CellFace face) {
    link(mirror(face)) |= constraint;
    link(face) |= constraint;
    is_altered_ = true;
}

// Throws Error(memory) if so many more cells cannot be numbered; called before anything is changed.
void EditableTets::require_room(std::size_t more_cells) const {
    const std::size_t cells = cells_.size() + more_cells;
    if (std::cmp_greater(cells, most_))
        throw Error(ErrorCode::memory, fmt::format("A mesh of {} points has {} tetrahedra; more than {} cannot be "
                                                   "numbered. Divide the surface into more parts.",
                                                   cell_at_vertex_.size(), cells, most_));
}

std::span<const CellId> EditableTets::replace(std::span<const CellId> cells, std::span<const Tetrahedron> by) {
    if (const std::size_t reused = cells.size() + gaps_.size(); by.size() > reused) require_room(by.size() - reused);
    is_altered_ = true;
    open_.clear();
    for (const CellId cell : cells) cells_[cell].flip_mark();
    for (const CellId cell : cells) {
        Cell old = cells_[cell];
        old.flip_mark();
        for (int i = 0; i < 4; ++i)
            if (old.link[i] < 0 || !cells_[cell_of(old.link[i] & ~constraint)].is_marked())
                open_.push_back({ascending_face(old.vertex, i), old.link[i]});
    }
    places_.assign(cells.begin(), cells.end());
    for (; places_.size() < by.size() && !gaps_.empty(); gaps_.pop_back()) places_.push_back(gaps_.back());
    for (; places_.size() < by.size(); cells_.emplace_back()) places_.push_back(CellId(cell_count()));
    for (std::size_t k = 0; k < by.size(); ++k) {
        cells_[places_[k]].vertex = by[k];
        for (int i = 0; i < 4; ++i) {
            if (by[k][i] >= 0) cell_at_vertex_[by[k][i]] = places_[k];
            const CellFace face = cell_face(places_[k], i);
            const Triangle key = ascending_face(by[k], i);
            const auto other = std::find_if(open_.begin(), open_.end(),
                                            [&](const OpenFace& open_face) { return open_face.vertices == key; });
            if (other == open_.end()) {
                open_.push_back({key, face});
                continue;
            }
            link(face) = other->side;
            if (other->side >= 0) link(other->side & ~constraint) = face | (other->side & constraint);
            *other = open_.back();
            open_.pop_back();
        }
    }
    KERF_CHECK(open_.empty());
    const std::span made = std::span(places_).first(by.size()), left = std::span(places_).subspan(by.size());
    for (const CellId cell : left) cells_[cell].vertex[0] = none;
    if (keeps_numbers_)
        gaps_.insert(gaps_.end(), left.rbegin(), left.rend());
    else if (!left.empty())
        remove_cells(left, made);
    return made;
}

void EditableTets::remove_cells(std::span<const CellId> cells, std::span<CellId> followed) {
    std::vector<CellId> descending(cells.begin(), cells.end());
    std::sort(descending.begin(), descending.end(), std::greater<>());
    for (const CellId to : descending) {
        const CellId from(cell_count() - 1);
        if (to != from) {
            cells_[to] = cells_[from];
            for (int i = 0; i < 4; ++i) {
                const CellFace behind = cells_[to].link[i];
                if (behind >= 0) link(behind & ~constraint) = cell_face(to, i) | (behind & constraint);
            }
            for (const std::int32_t v : cells_[to].vertex)
                if (v >= 0) cell_at_vertex_[v] = to;
            std::replace(followed.begin(), followed.end(), from, to);
        }
        cells_.pop_back();
    }
}

void EditableTets::keep_cells(const std::vector<bool>& is_kept) {
    Array<CellId, CellId> number(cells_.size(), CellId::none());
    std::int32_t count = 0;
    for (const CellId cell : cells())
        if (is_kept[cell.value()]) number[cell] = CellId(count++);
    std::fill(cell_at_vertex_.begin(), cell_at_vertex_.end(), CellId::none());
    for (const CellId cell : cells()) {
        if (!is_kept[cell.value()]) continue;
        Cell& kept = cells_[number[cell]] = cells_[cell];
        for (CellFace& behind : kept.link) {
            if (behind < 0) continue;
            const CellFace face = behind & ~constraint;
            const CellId other = number[cell_of(face)];
            behind = other.is_valid() ? cell_face(other, index_in_cell(face)) | (behind & constraint) : none;
        }
        for (const std::int32_t v : kept.vertex) cell_at_vertex_[v] = number[cell];
    }
    cells_.resize(count);
    gaps_.clear();
}

void EditableTets::add_cells(std::span<const Tetrahedron> cells) {
    require_room(cells.size());
    for (const Tetrahedron& cell : cells) {
        for (const std::int32_t v : cell) cell_at_vertex_[v] = CellId(cell_count());
        cells_.push_back({cell, {none, none, none, none}});
    }
    open_.clear();
    for (const CellId cell : cells_.ids())
        for (int i = 0; i < 4; ++i)
            if (cells_[cell].link[i] < 0) open_.push_back({ascending_face(cells_[cell].vertex, i), cell_face(cell, i)});
    std::sort(open_.begin(), open_.end(), [](const OpenFace& f, const OpenFace& g) { return f.vertices < g.vertices; });
    for (std::size_t k = 1; k < open_.size(); ++k)
        if (open_[k - 1].vertices == open_[k].vertices) {
            link(open_[k - 1].side) = open_[k].side;
            link(open_[k].side) = open_[k - 1].side;
        }
}

std::int32_t EditableTets::add_vertex(const Vec3& p) {
    points_.push_back(p);
    cell_at_vertex_.push_back(CellId::none());
    return count_of(points_) - 1;
}

void EditableTets::remove_unused_vertices(std::size_t count) {
    for (std::size_t v = count; v < points_.size(); ++v) KERF_CHECK(!cell_at_vertex_[v].is_valid());
    points_.resize(count);
    cell_at_vertex_.resize(count);
}

std::size_t EdgeRing::place_of(std::int32_t vertex) const {
    return std::find(ring.begin(), ring.end(), vertex) - ring.begin();
}

bool find_ring(const EditableTets& tets, CellId cell, int i, int j, EdgeRing& ring, std::size_t most) {
    ring.a = tets.vertices(cell)[i];
    ring.b = tets.vertices(cell)[j];
    ring.cells.clear();
    ring.ring.clear();
    auto [behind, ahead] = other_two[i][j];
    CellId at = cell;
    do {
        if (ring.cells.size() == most) return false;
        ring.cells.push_back(at);
        ring.ring.push_back(tets.vertices(at)[behind]);
        const std::int32_t front = tets.vertices(at)[ahead];
        const CellFace next = tets.mirror(cell_face(at, behind));
        if (next < 0) return false;
        at = cell_of(next);
        ahead = index_in_cell(next);
        behind = index_of(tets.vertices(at), front);
    } while (at != cell);
    return true;
}

bool is_spoke_constrained(const EditableTets& tets, const EdgeRing& ring, std::size_t k) {
    const CellId cell = ring.cells[k];
    return tets.is_constrained(cell_face(cell, index_of(tets.vertices(cell), ring.ring[(k + 1) % ring.size()])));
}

}  // namespace kerf
