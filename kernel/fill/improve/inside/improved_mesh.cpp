// Two bounds of a new cell come from the mesh as it was: its sharpest and its flattest angle, so that the extremes
// never get worse; and the bound of volumes, which cells may exceed as far as those that they replace did. A volume is
// first compared with the least bound of all, so that the size field is asked only for cells that could exceed theirs.
// Angles are compared in doubles as signed squares of cotangents (fill/improve/cell_shape.h), signs of volumes exactly.
// Fixed are the vertices of the boundary, of faces with a cell on one side only, and of frozen cells.
#include "fill/improve/inside/improved_mesh.h"

#include "base/geometry/predicates.h"

namespace kerf {

ImprovedMesh::ImprovedMesh(TetMesh mesh, std::int64_t frozen_cells, SizeField max_size,
                           const std::function<void(const CellShape&)>& visit, std::int32_t most)
    : max_size_(std::move(max_size)),
      frozen_cells_(frozen_cells),
      boundary_vertex_count_(mesh.boundary_vertex_count),
      had_neighbours_(!mesh.neighbours.empty()),
      tets_(std::move(mesh), most) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    least_bound_six_ = max_size_.is_empty() ? infinity : 6 * max_size_.reference_volume();
    find_limits(visit);
}

TetMesh ImprovedMesh::finish() {
    std::vector<double>().swap(badness_);
    TetMesh mesh = tets_.take_mesh(had_neighbours_);
    mesh.boundary_vertex_count = boundary_vertex_count_;
    return mesh;
}

// Finds the shapes of all cells, the worst angles, and the vertices that must not move.
void ImprovedMesh::find_limits(const std::function<void(const CellShape&)>& visit) {
    is_fixed_.assign(tets_.points().size(), 0);
    std::fill_n(is_fixed_.begin(), boundary_vertex_count_, 1);
    badness_.resize(cell_count());
    most_sharp_ = most_flat_ = -std::numeric_limits<double>::infinity();
    for (const CellId cell : cells()) {
        const CellShape shape_of_cell = shape(corners(cell));
        visit(shape_of_cell);
        badness_[cell] = shape_of_cell.badness();
        most_sharp_ = std::max(most_sharp_, shape_of_cell.sharpest);
        most_flat_ = std::max(most_flat_, shape_of_cell.flattest);
        if (is_frozen(cell))
            for (const std::int32_t v : corners(cell)) is_fixed_[v] = 1;
        for (int i = 0; i < 4; ++i)
            if (!neighbour(cell, i).is_valid())
                for (const std::int32_t v : face(cell, i)) is_fixed_[v] = 1;
    }
}

bool ImprovedMesh::find_ring(CellId cell, int i, int j, EdgeRing& ring) const {
    return kerf::find_ring(tets_, cell, i, j, ring, most_cells_of_a_ring) && ring.size() >= 3 &&
           std::none_of(ring.cells.begin(), ring.cells.end(), [&](CellId at) { return is_frozen(at); });
}

bool ImprovedMesh::find_star(CellId cell, int i, std::vector<CellId>& star) {
    const std::int32_t vertex = corners(cell)[i];
    if (is_fixed_[vertex]) return false;
    tets_.find_star(cell, vertex, star);
    return true;
}

double ImprovedMesh::excess_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double six_volumes) const {
    return six_volumes / (6 * max_size_.max_volume_at((a + b + c + d) / 4));
}

double ImprovedMesh::most_excess(std::span<const CellId> cells) const {
    double excess = 1;
    if (max_size_.is_empty()) return excess;
    for (const CellId cell : cells) {
        const auto [a, b, c, d] = corners(cell);
        const double six_volumes = (point(b) - point(a)).cross(point(c) - point(a)).dot(point(d) - point(a));
        if (six_volumes > least_bound_six_)
            excess = std::max(excess, excess_of(point(a), point(b), point(c), point(d), six_volumes));
    }
    return excess;
}

double ImprovedMesh::badness_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double excess) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ++evaluations_;
    const CellShape shape_of_cell = cell_shape(a, b, c, d);
    if (shape_of_cell.sharpest > most_sharp_ || shape_of_cell.flattest > most_flat_) return infinity;
    if (shape_of_cell.six_volumes > least_bound_six_ && excess_of(a, b, c, d, shape_of_cell.six_volumes) > excess)
        return infinity;
    return shape_of_cell.badness();
}

bool ImprovedMesh::is_positive(const Tetrahedron& corners) const {
    return orientation(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3])) > 0;
}

std::span<const CellId> ImprovedMesh::replace(std::span<const CellId> cells, std::span<const Tetrahedron> by) {
    const std::span<const CellId> made = tets_.replace(cells, by);
    badness_.resize(cell_count());
    for (const CellId cell : made) badness_[cell] = shape(corners(cell)).badness();
    return made;
}

bool ImprovedMesh::move(std::int32_t vertex, const Vec3& to, std::span<const CellId> star) {
    const Vec3 from = point(vertex);
    tets_.move_vertex(vertex, to);
    for (const CellId cell : star)
        if (!is_positive(corners(cell))) {
            tets_.move_vertex(vertex, from);
            return false;
        }
    for (const CellId cell : star) badness_[cell] = shape(corners(cell)).badness();
    return true;
}

std::int32_t ImprovedMesh::add_vertex(const Vec3& p) {
    is_fixed_.push_back(0);
    return tets_.add_vertex(p);
}

void ImprovedMesh::remove_last_vertex() {
    is_fixed_.pop_back();
    tets_.remove_unused_vertices(is_fixed_.size());
}

}  // namespace kerf
