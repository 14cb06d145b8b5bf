#include "solve/equations/inside/body_forces.h"

namespace kerf {

NodalForces thermal_forces(const TetElement& element, const Material& material, double strain) {
    const double pressure = (3 * material.lambda() + 2 * material.mu()) * strain;
    NodalForces forces;
    forces.fill(Vec3::Zero());
    for (const TetPoint& at : element.rule()) {
        const TetElement::Point point = element.point(at);
        for (int n = 0; n < element.node_count(); ++n) forces[n] += pressure * point.weight * point.gradients[n];
    }
    return forces;
}

}  // namespace kerf
