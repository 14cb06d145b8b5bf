#include "improve/smoothing.h"

namespace kerf {

bool Smoothing::move(EditedMesh& mesh, std::int32_t vertex, std::span<const std::int32_t> star, double least_gain) {
    places_.clear();
    double worst = -std::numeric_limits<double>::infinity();
    for (const std::int32_t cell : star) {
        const Tetrahedron& corners = mesh.corners(cell);
        std::size_t i = 0;
        while (corners[i] != vertex) ++i;
        const auto& [a, b, c] = tet_faces[i];
        places_.add({mesh.point(corners[a]), mesh.point(corners[b]), mesh.point(corners[c])});
        worst = std::max(worst, mesh.badness(cell));
    }
    const BestPlace::Place best = places_.search(mesh, {mesh.point(vertex), worst}, mesh.most_excess(star), vertex);
    return best.badness < worst - least_gain * (1 + std::abs(worst)) && mesh.move(vertex, best.at, star);
}

}  // namespace kerf
