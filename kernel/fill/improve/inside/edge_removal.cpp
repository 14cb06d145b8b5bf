#include "fill/improve/inside/edge_removal.h"

namespace kerf {

bool EdgeRemoval::find(const ImprovedMesh& mesh, const EdgeRing& ring, double limit) {
    const double excess = mesh.most_excess(ring.cells);
    std::array<Vec3, ImprovedMesh::most_cells_of_a_ring> points;
    for (std::size_t i = 0; i < ring.size(); ++i) points[i] = mesh.point(ring.ring[i]);
    const Vec3 &a = mesh.point(ring.a), &b = mesh.point(ring.b);
    const auto badness_of = [&](std::size_t i, std::size_t j, std::size_t k, double best) {
        const double below = mesh.badness_of(a, points[i], points[j], points[k], excess);
        return below < best ? std::max(below, mesh.badness_of(points[i], points[j], points[k], b, excess)) : below;
    };
    if (!polygon_.find(ring.size(), limit, badness_of)) return false;
    cells_.clear();
    polygon_.for_each_triangle([&](std::size_t i, std::size_t j, std::size_t k) {
        const std::int32_t p = ring.ring[i], q = ring.ring[j], r = ring.ring[k];
        cells_.insert(cells_.end(), {{ring.a, p, q, r}, {p, q, r, ring.b}});
    });
    return std::all_of(cells_.begin(), cells_.end(), [&](const Tetrahedron& cell) { return mesh.is_positive(cell); });
}

}  // namespace kerf
