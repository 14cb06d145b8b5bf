// Elastic supports on the surface: their stiffness and their forces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "solve/case/elastic_case.h"
#include "solve/space/fe_space.h"
#include "solve/space/surface_selection.h"

namespace kerf {

/// Boundary triangles of this rank that stand on springs.
struct SurfaceSprings {
    struct Facet {
        std::size_t spring = 0;  ///< index among `springs`
        std::size_t part = 0, facet = 0;
    };
    std::vector<Spring> springs;
    std::vector<Facet> facets;

    bool empty() const { return springs.empty(); }
};

/// The stiffness of a triangle on a spring: the integral of shape functions times stiffness per area, blocks for pairs
/// of its nodes (FeSpace::nodes_of_facet). Exact for flat triangles. With `order` 1 it is that of the flat triangle of
/// the corners.
using FacetStiffness = std::array<std::array<Eigen::Matrix3d, 6>, 6>;
FacetStiffness spring_stiffness(const FeSpace& space, const SurfaceSprings& springs, const SurfaceSprings::Facet& facet,
                                int order);

/// Returns the directions in which the spring at a triangle pushes back: three at most, none where the stiffness is 0.
std::vector<Vec3> spring_directions(const FeSpace& space, const SurfaceSprings& springs,
                                    const SurfaceSprings::Facet& facet);

}  // namespace kerf
