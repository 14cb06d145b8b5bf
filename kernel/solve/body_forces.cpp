#include "solve/body_forces.h"

namespace kerf {

const std::array<WeightedPoint, 14>& quintic_points() {
    static const std::array<WeightedPoint, 14> all = [] {
        std::array<WeightedPoint, 14> points;
        std::size_t next = 0;
        for (const auto& [x, weight] : {std::pair{0.31088591926330060980, 0.11268792571801585080},
                                        std::pair{0.09273525031089122640, 0.07349304311636194954}})
            for (std::size_t i = 0; i < 4; ++i) {
                points[next] = {{x, x, x, x}, weight};
                points[next++].place[i] = 1 - 3 * x;
            }
        constexpr double x = 0.04550370412564964949;
        for (const auto& [i, j] : tet_edges) {
            points[next] = {{x, x, x, x}, 0.04254602077708146644};
            points[next].place[static_cast<std::size_t>(i)] = points[next].place[static_cast<std::size_t>(j)] = 0.5 - x;
            ++next;
        }
        return points;
    }();
    return all;
}

NodalForces thermal_forces(const TetElement& element, const Material& material, double strain) {
    const double pressure = (3 * material.lambda() + 2 * material.mu()) * strain;
    const std::size_t points = element.order() == 1 ? 1 : quadrature_points.size();
    const double weight = pressure * element.volume() / static_cast<double>(points);
    NodalForces forces;
    forces.fill(Vec3::Zero());
    for (std::size_t q = 0; q < points; ++q) {
        const TetElement::Gradients gradients = element.gradients_at(quadrature_points[q]);
        for (int n = 0; n < element.node_count(); ++n) forces[n] += weight * gradients[n];
    }
    return forces;
}

}  // namespace kerf
