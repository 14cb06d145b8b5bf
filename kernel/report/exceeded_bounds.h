// Cells beyond the bounds that were asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/report.h"

namespace kerf {

/// A bound of cells, and how far it was missed. The surface may leave no room to hold it: facets and interfaces stay as
/// they are, and cells that replace sharp ones have the better angles, not the smaller bound.
struct ExceededBound {
    const char* option;      ///< as users write it, without "--"
    double bound = 0;        ///< of --max-volume in units of the surface, of --radius-edge a pure number
    std::int64_t cells = 0;  ///< beyond it, to the width of a bin of Distribution, which those are not counted in
    double largest = 0;      ///< of all cells, exactly
};

/// Those that cells exceed, of bounds for the whole mesh.
std::vector<ExceededBound> exceeded_bounds(const RunReport& report);

/// "12 cells beyond --max-volume 0.01, up to 1.3 times; ..."; empty if there are none.
std::string exceeded_text(const std::vector<ExceededBound>& bounds);

}  // namespace kerf
