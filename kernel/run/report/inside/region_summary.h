// The regions of a surface, as values and text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// The wall that a region has in common with another one.
struct CommonWall {
    std::string region;  ///< name of the other region
    double area = 0;
    std::int32_t number = 0;  ///< number of the other region
};

struct RegionSummary {
    std::string name;
    double volume = 0;
    std::int64_t shells = 0;
    double outer_area = 0;          ///< area of the facets with nothing on their other side
    std::vector<CommonWall> walls;  ///< its walls, in the order of the other regions
};

/// Returns the regions of a soup that has been repaired, in the order of Soup::region_names; none if it has no sides.
/// O(#F log #F).
std::vector<RegionSummary> summarize_regions(const Soup& soup);

/// Returns a table with a line for each region, and one with a line for each wall; names are last.
std::string region_tables(const std::vector<RegionSummary>& regions);

/// Returns a line a region, with its volume, shells and walls; at most 50 lines.
std::string to_text(const std::vector<RegionSummary>& regions);

}  // namespace kerf
