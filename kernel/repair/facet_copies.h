// Facets that are there more than once: copies, and sheets that are folded upon themselves.
#pragma once

#include <vector>

#include "core/types.h"

namespace kerf {

/// What is left out of copies; facets of both, ascending.
struct SurplusCopies {
    std::vector<std::int32_t> copies;  ///< of facets of which one stays
    std::vector<std::int32_t> folds;   ///< all copies of facets without which the surface around them closes
};

/// Of facets with three equal vertices one stays, the first. None stays of a sheet of copies that are turned against
/// each other where most edges of its rim have an even number of facets without it: a fold bounds nothing, and, `with_
/// walls`, neither does what lies between two bodies, without a free edge. Sheets of copies that are all turned alike
/// bound the same twice. Sheets of copies go together over edges of two. Of a body that is there twice, and of a sheet
/// with nothing around it, one stays. Requires numbers in range and no facet with a repeated vertex. O(#F log #F);
/// exact, as only numbers of vertices are compared.
SurplusCopies find_surplus_copies(const std::vector<Triangle>& facets, bool with_walls);

}  // namespace kerf
