// Forces on the nodes of an element that come from its inside.
#pragma once

#include <array>

#include "solve/space/tet_element.h"

namespace kerf {

using NodalForces = std::array<Vec3, most_element_nodes>;

/// Calls take(place, weight, shapes) for the points of a rule; weights add up to the volume. In straight elements it is
/// exact for products of a shape function and a density of degree 3 or less.
template <class Take>
void for_points_of(const TetElement& element, Take take) {
    for (const TetPoint& at : quadrature::fourteen_points)
        take(element.position_of(at.place), element.point(at).weight, TetElement::shapes_at(element.order(), at.place));
}

/// Returns the nodal forces of a force per volume, density(place).
template <class Density>
NodalForces body_forces(const TetElement& element, Density density) {
    NodalForces forces;
    forces.fill(Vec3::Zero());
    for_points_of(element, [&](const Vec3& place, double weight, const TetElement::Shapes& shapes) {
        const Vec3 force = weight * density(place);
        for (int n = 0; n < element.node_count(); ++n) forces[n] += shapes[n] * force;
    });
    return forces;
}

/// Returns the nodal forces that would stretch the element, if nothing held it, by `strain` in all directions. They add
/// up to 0.
NodalForces thermal_forces(const TetElement& element, const Material& material, double strain);

}  // namespace kerf
