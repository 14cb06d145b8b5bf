// Facets that are too wide for a layer between walls.
#pragma once

#include <vector>

#include "prepare/labelled_facets.h"

namespace kerf {

/// Whether the cell behind a facet, on one of its sides, has an angle below 10 degrees whatever is done inside: the
/// region is not as deep there as the facet is wide (mesh/forced_cells.h has the bound). Per facet; empty for a single
/// region, whose walls are thin all over or nowhere. O(#F log #F).
std::vector<char> facets_on_thin_layers(const LabelledFacets& facets);

}  // namespace kerf
