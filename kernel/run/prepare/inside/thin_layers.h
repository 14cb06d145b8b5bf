// Facets that are too wide for a layer between walls.
#pragma once

#include <vector>

#include "run/prepare/inside/labelled_facets.h"

namespace kerf {

/// Returns for each facet whether the cell behind it, on one of its sides, has an angle below 10 degrees whatever is
/// done inside: the region is not as deep there as the facet is wide (fill/mesh/inside/forced_cells.h has the bound).
/// Empty for a single region, whose walls are thin all over or nowhere. O(#F log #F).
std::vector<char> facets_on_thin_layers(const LabelledFacets& facets);

}  // namespace kerf
