// The cells of a soup, and which regions they are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "surface/cells.h"
#include "surface/soup.h"

namespace kerf {

/// The facets of a soup, each once.
struct SingleFacets {
    std::vector<Triangle> facets;
    std::vector<std::int32_t> first;      ///< the facet of the soup that stands for it: the first one
    std::vector<std::int32_t> single_of;  ///< per facet of the soup; -1: it has a repeated vertex
    std::vector<char> is_turned;          ///< per facet of the soup, against the first one
};

/// O(#F log #F).
SingleFacets single_facets(const std::vector<Triangle>& facets);

struct DividedSpace {
    SingleFacets single;
    Cells cells;                               ///< of the single facets
    std::vector<std::int32_t> region_of_cell;  ///< a number of `names`; -1: none
    std::vector<std::string> names;

    std::int32_t region_of(std::int32_t cell) const { return cell < 0 ? -1 : region_of_cell[cell]; }
};

/// No cell is a region yet. Nothing is returned without facets, for coordinates that are not finite or beyond 1e50, and
/// where find_cells() finds nothing, or no bounded cell. Requires numbers in range and a welded soup. Cost as
/// find_cells().
std::optional<DividedSpace> divide_space(const Soup& soup);

/// Sets Soup::sides and Soup::region_names, leaves out the facets that are no wall, and notes that. Regions without a
/// cell are left out, the others keep their order; each facet has the smaller number behind it. Patches are named as
/// name_walls() does. O(#F log n) for n patches.
void give_sides(Soup& soup, DividedSpace space);

}  // namespace kerf
