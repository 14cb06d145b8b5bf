// Facets that are there more than once: copies, and sheets that are folded upon themselves.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Facets to be left out because they are copies, both lists ascending.
struct SurplusCopies {
    std::vector<std::int32_t> copies;  ///< superfluous ones, of which another in the same place stays
    std::vector<std::int32_t> folds;   ///< all copies of facets without which the surface around them closes
};

/// Finds the facets to be left out among copies, which have the same three vertices: the first of them stays. None
/// stays of a sheet of copies that are turned against each other where most edges of its rim have an even number of
/// facets without it: such a fold bounds nothing, and, if `with_walls`, neither does a sheet between two bodies, which
/// has no free edge. Sheets of copies that are all turned alike bound the same body twice. Copies belong to one sheet
/// if edges of two facets lead from one to the other. Of a body that is there twice, and of a sheet with nothing around
/// it, one stays. Requires numbers in range and no facet with a repeated vertex. O(#F log #F); exact, as only numbers
/// of vertices are compared.
SurplusCopies find_surplus_copies(const std::vector<Triangle>& facets, bool with_walls);

}  // namespace kerf
