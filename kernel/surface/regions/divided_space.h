// The cells of a soup, and the regions that they belong to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/core/ids.h"
#include "surface/regions/cells.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The facets of a soup, each once.
struct SingleFacets {
    std::vector<Triangle> facets;
    std::vector<std::int32_t> first;      ///< the facet of the soup that stands for it: the first copy
    std::vector<std::int32_t> single_of;  ///< per facet of the soup; -1 if it has a repeated vertex
    std::vector<char> is_turned;          ///< per facet of the soup, whether it is turned against the first copy
};

/// Keeps the first copy of each facet without a repeated vertex. O(#F log #F).
SingleFacets single_facets(const std::vector<Triangle>& facets);

struct DividedSpace {
    SingleFacets single;
    Cells cells;                              ///< of the single facets
    std::vector<RegionIndex> region_of_cell;  ///< index into `names`; none: no region
    std::vector<std::string> names;

    RegionIndex region_of(std::int32_t cell) const { return cell < 0 ? RegionIndex::none() : region_of_cell[cell]; }
};

/// Divides space into the cells of the soup's facets, no cell being a region yet. Returns nothing without facets, for
/// coordinates that are not finite or beyond 1e50, where find_cells() returns nothing, and where no cell is bounded.
/// Requires numbers in range and a welded soup. Cost as find_cells().
std::optional<DividedSpace> divide_space(const Soup& soup);

/// Sets Soup::sides and Soup::region_names, leaves out the facets that are no wall, and adds a note that counts them.
/// Regions without a cell are left out and the others keep their order; of the two regions at a facet that with the
/// smaller number is behind it. Patches are named as name_walls() does. O(#F log n) for n patches.
void give_sides(Soup& soup, DividedSpace space);

}  // namespace kerf
