// For each edge of the cell, the cells around it are a first cavity (Klingner and Shewchuk 2007, klingner2007). A side
// is a face of the cavity's boundary, with the cell of the cavity behind it; together with the vertex, each side makes
// a new cell, whose badness is that of the side. The vertex moves to its best place for the sides that there are; then
// the cavity grows, one cell at a time, across the worst side behind which the new sides would all be better. This goes
// on in turn, a few times, and the best of all places is kept with its cavity. A vertex that would come to lie inside
// of the cavity would be lost, so growth that does this is taken back. Cells are judged in doubles; only at the end
// their signs are checked exactly, and if one fails there is no vertex.
#include "fill/improve/inside/vertex_insertion.h"

#include "base/geometry/triangle.h"
#include "fill/mesh/faces.h"

namespace kerf {

namespace {
constexpr std::size_t most_cavity_cells = 40;
constexpr int most_moves = 4;
}  // namespace

bool VertexInsertion::contains(CellId cell) const {
    return std::find(cavity_.begin(), cavity_.end(), cell) != cavity_.end();
}

double VertexInsertion::badness_at(const ImprovedMesh& mesh, const Vec3& at, CellId cell, int i) const {
    const Triangle face = mesh.face(cell, i);
    return mesh.badness_of(at, mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2]), excess_);
}

void VertexInsertion::find_sides(const ImprovedMesh& mesh) {
    sides_.clear();
    for (const CellId cell : cavity_)
        for (int i = 0; i < 4; ++i)
            if (!contains(mesh.neighbour(cell, i))) sides_.push_back({cell, i, 0});
}

bool VertexInsertion::has_inner_vertex(const ImprovedMesh& mesh) const {
    for (const CellId cell : cavity_)
        for (const std::int32_t vertex : mesh.corners(cell))
            if (std::none_of(sides_.begin(), sides_.end(), [&](const Side& side) {
                    const Triangle face = mesh.face(side.cell, side.i);
                    return std::find(face.begin(), face.end(), vertex) != face.end();
                }))
                return true;
    return false;
}

// Adds the cell behind the worst side for which the sides behind that are better; false if there is none.
bool VertexInsertion::grow(const ImprovedMesh& mesh, const Vec3& at) {
    if (cavity_.size() == most_cavity_cells) return false;
    for (Side& side : sides_) side.badness = badness_at(mesh, at, side.cell, side.i);
    std::stable_sort(sides_.begin(), sides_.end(), [](const Side& p, const Side& q) { return p.badness > q.badness; });
    const std::vector<Side> candidates = sides_;
    for (const Side& side : candidates) {
        const CellId next = mesh.neighbour(side.cell, side.i);
        if (!next.is_valid() || mesh.is_frozen(next)) continue;
        double worst = -std::numeric_limits<double>::infinity();
        for (int i = 0; i < 4 && worst < side.badness; ++i)
            if (!contains(mesh.neighbour(next, i))) worst = std::max(worst, badness_at(mesh, at, next, i));
        if (!(worst < side.badness)) continue;
        cavity_.push_back(next);
        find_sides(mesh);
        if (!has_inner_vertex(mesh)) return true;
        cavity_.pop_back();
        find_sides(mesh);
    }
    return false;
}

double VertexInsertion::worst_at(const ImprovedMesh& mesh, const Vec3& at) const {
    double worst = -std::numeric_limits<double>::infinity();
    for (const Side& side : sides_) worst = std::max(worst, badness_at(mesh, at, side.cell, side.i));
    return worst;
}

// Moves the place and grows the cavity in turn, and keeps the best of both.
void VertexInsertion::grow_and_move(const ImprovedMesh& mesh, const Vec3& start) {
    cavity_ = ring_.cells;
    excess_ = mesh.most_excess(cavity_);
    find_sides(mesh);
    BestPlace::Place place = {start, 0};
    for (int moves = 0; moves < most_moves; ++moves) {
        places_.clear();
        for (const Side& side : sides_) {
            const Triangle face = mesh.face(side.cell, side.i);
            places_.add({mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2])});
        }
        place.badness = worst_at(mesh, place.at);
        place = places_.search(mesh, place, excess_, cavity_.front().value());
        if (place.badness < best_.badness) {
            best_ = place;
            best_cavity_ = cavity_;
        }
        const std::size_t before = cavity_.size();
        while (grow(mesh, place.at)) {
        }
        if (cavity_.size() == before) return;
    }
}

// Returns a direction of length 1, or zero where no face of the cell is at the boundary.
Vec3 VertexInsertion::away_from_boundary(const ImprovedMesh& mesh, CellId cell) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 4; ++i) {
        if (mesh.neighbour(cell, i).is_valid()) continue;
        const Triangle face = mesh.face(cell, i);
        sum -= doubled_area_vector(mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2])).normalized();
    }
    return sum.stableNormalized();
}

void VertexInsertion::try_all_edges(const ImprovedMesh& mesh, CellId cell, const Vec3& away) {
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            if (!mesh.find_ring(cell, i, j, ring_)) continue;
            const Vec3 &a = mesh.point(ring_.a), &b = mesh.point(ring_.b);
            grow_and_move(mesh, (a + b) / 2 + (b - a).norm() * away);
        }
}

std::span<const CellId> VertexInsertion::insert(ImprovedMesh& mesh, CellId cell, double limit,
                                                std::span<const double> depths) {
    best_ = {Vec3::Zero(), limit};
    best_cavity_.clear();
    try_all_edges(mesh, cell, Vec3::Zero());
    if (best_cavity_.empty() && !depths.empty())
        if (const Vec3 inwards = away_from_boundary(mesh, cell); inwards != Vec3::Zero())
            for (std::size_t i = 0; i < depths.size() && best_cavity_.empty(); ++i)
                try_all_edges(mesh, cell, depths[i] * inwards);
    if (best_cavity_.empty()) return {};
    cavity_ = best_cavity_;
    find_sides(mesh);
    const std::int32_t vertex = mesh.add_vertex(best_.at);
    cells_.clear();
    bool all_positive = true;
    for (const Side& side : sides_) {
        const Triangle face = mesh.face(side.cell, side.i);
        all_positive &= mesh.is_positive(cells_.emplace_back(Tetrahedron{vertex, face[0], face[1], face[2]}));
    }
    if (all_positive) return cavity_;
    mesh.remove_last_vertex();
    return {};
}

}  // namespace kerf
