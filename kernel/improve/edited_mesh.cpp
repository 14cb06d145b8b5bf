#include "improve/edited_mesh.h"

#include <fmt/format.h>

#include "core/check.h"
#include "core/error.h"
#include "geometry/predicates.h"
#include "mesh/faces.h"

namespace kerf {

namespace {

constexpr std::int32_t removed = -1;

// Corners i, j and the two others, in an even permutation.
constexpr std::array<int, 2> others_of(int i, int j) {
    constexpr std::array<std::array<std::array<int, 2>, 4>, 4> others = {{{{{0, 0}, {2, 3}, {3, 1}, {1, 2}}},
                                                                          {{{3, 2}, {0, 0}, {0, 3}, {2, 0}}},
                                                                          {{{1, 3}, {3, 0}, {0, 0}, {0, 1}}},
                                                                          {{{2, 1}, {0, 2}, {1, 0}, {0, 0}}}}};
    return others[i][j];
}

int index_of(const Tetrahedron& corners, std::int32_t vertex) {
    return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

}  // namespace

EditedMesh::EditedMesh(TetMesh& mesh, std::int64_t frozen_cells, SizeField max_size,
                       const std::function<void(const CellShape&)>& visit, std::size_t most)
    : mesh_(&mesh),
      max_size_(std::move(max_size)),
      frozen_cells_(frozen_cells),
      most_(most),
      had_neighbours_(!mesh.neighbours.empty()) {
    KERF_CHECK(most <= most_cells);
    require_room(mesh.tets.size());
    constexpr double infinity = std::numeric_limits<double>::infinity();
    least_bound_six_ = max_size_.is_empty() ? infinity : 6 * max_size_.reference_volume();
    links_.resize(mesh.tets.size(), {none, none, none, none});
    had_neighbours_ ? copy_links() : find_links();
    find_limits(visit);
}

void EditedMesh::require_room(std::size_t cells) const {
    if (cells > most_)
        throw Error(
            ErrorCode::memory,
            fmt::format("The mesh of a part has {} tetrahedra; no more than {} can be improved. Use more parts.", cells,
                        most_));
}

void EditedMesh::find_links() {
    const auto join = [&](FaceSide a, FaceSide b) {
        links_[a.tet()][a.corner()] = 4 * b.tet() + static_cast<std::int32_t>(b.corner());
        links_[b.tet()][b.corner()] = 4 * a.tet() + static_cast<std::int32_t>(a.corner());
    };
    match_faces(*mesh_, join, [](FaceSide) {});
}

void EditedMesh::copy_links() {
    const TetNeighbours& neighbours = mesh_->neighbours;
    for (std::int32_t cell = 0; cell < cell_count(); ++cell)
        for (int i = 0; i < 4; ++i) {
            const std::int32_t other = neighbours[cell][i];
            if (other >= 0) links_[cell][i] = 4 * other + index_of(neighbours[other], cell);
        }
    TetNeighbours().swap(mesh_->neighbours);
}

// The shapes of all cells, the worst there are, and which vertices must not move.
void EditedMesh::find_limits(const std::function<void(const CellShape&)>& visit) {
    is_fixed_.assign(mesh_->vertices.size(), 0);
    std::fill_n(is_fixed_.begin(), mesh_->boundary_vertex_count, 1);
    badness_.resize(mesh_->tets.size());
    seen_.assign(mesh_->tets.size(), 0);
    most_sharp_ = most_flat_ = -std::numeric_limits<double>::infinity();
    for (std::int32_t cell = 0; cell < cell_count(); ++cell) {
        const CellShape shape_of_cell = shape(corners(cell));
        visit(shape_of_cell);
        badness_[cell] = shape_of_cell.badness();
        most_sharp_ = std::max(most_sharp_, shape_of_cell.sharpest);
        most_flat_ = std::max(most_flat_, shape_of_cell.flattest);
        if (is_frozen(cell))
            for (const std::int32_t v : corners(cell)) is_fixed_[v] = 1;
        for (int i = 0; i < 4; ++i)
            if (links_[cell][i] < 0)
                for (const int corner : tet_faces[i]) is_fixed_[corners(cell)[corner]] = 1;
    }
}

bool EditedMesh::find_ring(std::int32_t cell, int i, int j, EdgeRing& ring) const {
    ring.a = corners(cell)[i];
    ring.b = corners(cell)[j];
    ring.size = 0;
    auto [behind, ahead] = others_of(i, j);
    std::int32_t at = cell;
    do {
        if (ring.size == EdgeRing::most_cells || is_frozen(at)) return false;
        ring.cells[ring.size] = at;
        ring.ring[ring.size++] = corners(at)[behind];
        const std::int32_t front = corners(at)[ahead], link = links_[at][behind];
        if (link < 0) return false;
        at = link >> 2;
        ahead = link & 3;
        behind = index_of(corners(at), front);
    } while (at != cell);
    return ring.size >= 3;
}

bool EditedMesh::find_star(std::int32_t cell, int i, std::vector<std::int32_t>& star) {
    const std::int32_t vertex = corners(cell)[i];
    if (is_fixed_[vertex]) return false;
    star.assign(1, cell);
    seen_[cell] = ++search_;
    for (std::size_t next = 0; next < star.size(); ++next) {
        const std::int32_t at = star[next];
        for (int k = 0; k < 4; ++k) {
            if (corners(at)[k] == vertex) continue;
            const std::int32_t other = links_[at][k] >> 2;
            if (seen_[other] == search_) continue;
            seen_[other] = search_;
            star.push_back(other);
        }
    }
    return true;
}

double EditedMesh::excess_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double six_volumes) const {
    return six_volumes / (6 * max_size_.max_volume_at((a + b + c + d) / 4));
}

double EditedMesh::excess_of(std::int32_t cell) const {
    const auto [a, b, c, d] = corners(cell);
    const double six_volumes = (point(b) - point(a)).cross(point(c) - point(a)).dot(point(d) - point(a));
    if (six_volumes <= least_bound_six_) return 1;
    return excess_of(point(a), point(b), point(c), point(d), six_volumes);
}

double EditedMesh::most_excess(std::span<const std::int32_t> cells) const {
    double excess = 1;
    if (!max_size_.is_empty())
        for (const std::int32_t cell : cells) excess = std::max(excess, excess_of(cell));
    return excess;
}

double EditedMesh::badness_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double excess) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ++looks_;
    const CellShape shape_of_cell = cell_shape(a, b, c, d);
    if (shape_of_cell.sharpest > most_sharp_ || shape_of_cell.flattest > most_flat_) return infinity;
    if (shape_of_cell.six_volumes > least_bound_six_ && excess_of(a, b, c, d, shape_of_cell.six_volumes) > excess)
        return infinity;
    return shape_of_cell.badness();
}

bool EditedMesh::is_positive(const Tetrahedron& corners) const {
    return orientation(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3])) > 0;
}

std::int32_t EditedMesh::take_cell() {
    if (!free_.empty()) {
        const std::int32_t cell = free_.back();
        free_.pop_back();
        return cell;
    }
    mesh_->tets.emplace_back();
    links_.emplace_back();
    badness_.emplace_back();
    seen_.emplace_back();
    return cell_count() - 1;
}

Triangle EditedMesh::face_key(std::int32_t cell, int i) const {
    Triangle key = face(cell, i);
    std::sort(key.begin(), key.end());
    return key;
}

// Those around the cells, seen from outside.
void EditedMesh::open_faces(std::span<const std::int32_t> cells) {
    ++search_;
    for (const std::int32_t cell : cells) seen_[cell] = search_;
    open_.clear();
    for (const std::int32_t cell : cells)
        for (int i = 0; i < 4; ++i) {
            const std::int32_t link = links_[cell][i];
            if (link < 0 || seen_[link >> 2] != search_) open_.push_back({face_key(cell, i), link});
        }
}

// Joins a new side with the other one of its face, or keeps it until that comes.
void EditedMesh::close_face(std::int32_t side) {
    const std::int32_t cell = side >> 2;
    const Triangle key = face_key(cell, side & 3);
    const auto other = std::find_if(open_.begin(), open_.end(), [&](const OpenFace& f) { return f.vertices == key; });
    if (other == open_.end()) {
        open_.push_back({key, side});
        return;
    }
    links_[cell][side & 3] = other->side;
    if (other->side >= 0) links_[other->side >> 2][other->side & 3] = side;
    *other = open_.back();
    open_.pop_back();
}

void EditedMesh::replace(std::span<const std::int32_t> cells, std::span<const Tetrahedron> by,
                         std::vector<std::int32_t>& made) {
    if (const std::size_t reused = free_.size() + cells.size(); by.size() > reused)
        require_room(mesh_->tets.size() + by.size() - reused);
    open_faces(cells);
    for (const std::int32_t cell : cells) mesh_->tets[cell][0] = removed;
    free_.insert(free_.end(), cells.rbegin(), cells.rend());
    for (const Tetrahedron& tet : by) {
        const std::int32_t cell = take_cell();
        mesh_->tets[cell] = tet;
        badness_[cell] = shape(tet).badness();
        made.push_back(cell);
        for (int i = 0; i < 4; ++i) close_face(4 * cell + i);
    }
    KERF_CHECK(open_.empty());
}

bool EditedMesh::move(std::int32_t vertex, const Vec3& to, std::span<const std::int32_t> star) {
    const Vec3 from = point(vertex);
    mesh_->vertices[vertex] = to;
    for (const std::int32_t cell : star)
        if (!is_positive(corners(cell))) {
            mesh_->vertices[vertex] = from;
            return false;
        }
    for (const std::int32_t cell : star) badness_[cell] = shape(corners(cell)).badness();
    return true;
}

std::int32_t EditedMesh::add_vertex(const Vec3& p) {
    mesh_->vertices.push_back(p);
    is_fixed_.push_back(0);
    return static_cast<std::int32_t>(mesh_->vertices.size()) - 1;
}

void EditedMesh::remove_last_vertex() {
    mesh_->vertices.pop_back();
    is_fixed_.pop_back();
}

void EditedMesh::finish() {
    if (had_neighbours_) restore_neighbours();
    std::erase_if(mesh_->tets, [](const Tetrahedron& tet) { return tet[0] == removed; });
}

void EditedMesh::restore_neighbours() {
    std::vector<std::int32_t> number(mesh_->tets.size());
    std::int32_t count = 0;
    for (std::int32_t cell = 0; cell < cell_count(); ++cell) number[cell] = is_removed(cell) ? none : count++;
    mesh_->neighbours.reserve(count);
    for (std::int32_t cell = 0; cell < cell_count(); ++cell) {
        if (is_removed(cell)) continue;
        std::array<std::int32_t, 4>& neighbours = mesh_->neighbours.emplace_back();
        for (int i = 0; i < 4; ++i) neighbours[i] = links_[cell][i] < 0 ? none : number[links_[cell][i] >> 2];
    }
}

}  // namespace kerf
