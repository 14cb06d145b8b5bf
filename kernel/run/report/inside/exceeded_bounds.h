// Cells beyond the bounds that were asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/report/report.h"

namespace kerf {

/// A bound of cells, and how far it was missed. The surface may leave no room to hold it: facets and interfaces stay as
/// they are, and cells that replace sharp ones have the better angles, not the smaller bound.
struct ExceededBound {
    const char* option;  ///< name of the option as users write it, without "--"
    double bound = 0;  ///< value of the option: of --max-volume in units of the surface, of --radius-edge a pure number
    /// Number of cells beyond the bound. Cells in the bin of Distribution in which the bound lies are not counted.
    std::int64_t cells = 0;
    double largest = 0;  ///< largest value of all cells, exactly
};

/// Returns the bounds for the whole mesh that some cells exceed.
std::vector<ExceededBound> exceeded_bounds(const RunReport& report);

/// Returns such bounds as "12 cells beyond --max-volume 0.01, up to 1.3 times; ..."; empty if there are none.
std::string exceeded_text(const std::vector<ExceededBound>& bounds);

}  // namespace kerf
