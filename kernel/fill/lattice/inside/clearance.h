// Removal of sites that leave no room for good cells between them and the surface.
#pragma once

#include <algorithm>

#include "fill/lattice/inside/sites_inside.h"

namespace kerf {

/// Returns the least distance of a core's sites from a facet: half the mean length of the facet's edges, and at least
/// 0.8 edges of the lattice, so that the spheres around its cells, whose radius is 0.56 edges, are without vertices of
/// the surface. Found by trial: with less, and with more, the cells between are worse.
constexpr double clearance(double mean_edge, double lattice_edge) {
    return std::max(0.5 * mean_edge, 0.8 * lattice_edge);
}

/// Removes the sites that are nearer to a facet than its clearance(). Independent of the order of facets and of that of
/// their corners. Linear in facets, and in blocks and sites left in the boxes around them: 0.2 to 2 us a facet where
/// the edges of facets are 0.1 to 3 edges of the lattice. A block that is near or far as a whole counts as one site.
void remove_sites_near(const SurfaceArrays& surface, const BccLattice& lattice, SiteSet& sites);

}  // namespace kerf
