#include "improve/edge_removal.h"

namespace kerf {

double EdgeRemoval::badness_of_triangle(const EditedMesh& mesh, const EdgeRing& ring, std::size_t i, std::size_t j,
                                        std::size_t k, double limit, double excess) const {
    const Vec3 &p = points_[i], &q = points_[j], &r = points_[k];
    const double below = mesh.badness_of(mesh.point(ring.a), p, q, r, excess);
    return below < limit ? std::max(below, mesh.badness_of(p, q, r, mesh.point(ring.b), excess)) : below;
}

bool EdgeRemoval::find(const EditedMesh& mesh, const EdgeRing& ring, double limit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double excess = mesh.most_excess(ring.cells);
    for (std::size_t i = 0; i < ring.size(); ++i) points_[i] = mesh.point(ring.ring[i]);
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) best_[i][i + 1] = -infinity;
    for (std::size_t width = 2; width < ring.size(); ++width)
        for (std::size_t i = 0, k = width; k < ring.size(); ++i, ++k) {
            double best = limit;
            for (std::size_t j = i + 1; j < k; ++j) {
                const double parts = std::max(best_[i][j], best_[j][k]);
                if (parts >= best) continue;
                const double all = std::max(parts, badness_of_triangle(mesh, ring, i, j, k, best, excess));
                if (all >= best) continue;
                best = all;
                middle_[i][k] = static_cast<std::uint8_t>(j);
            }
            best_[i][k] = best < limit ? best : infinity;
        }
    badness_ = best_[0][ring.size() - 1];
    if (badness_ == infinity) return false;
    cells_.clear();
    add_cells(ring, 0, ring.size() - 1);
    return std::all_of(cells_.begin(), cells_.end(), [&](const Tetrahedron& cell) { return mesh.is_positive(cell); });
}

void EdgeRemoval::add_cells(const EdgeRing& ring, std::size_t from, std::size_t to) {
    if (to - from < 2) return;
    const std::size_t middle = middle_[from][to];
    const std::int32_t p = ring.ring[from], q = ring.ring[middle], r = ring.ring[to];
    cells_.insert(cells_.end(), {{ring.a, p, q, r}, {p, q, r, ring.b}});
    add_cells(ring, from, middle);
    add_cells(ring, middle, to);
}

}  // namespace kerf
