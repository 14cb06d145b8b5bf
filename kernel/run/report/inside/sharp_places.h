// The places of the sharpest cells: what is bad, where, why, and what helps.
#pragma once

#include <string>
#include <vector>

#include "run/report/report.h"

namespace kerf {

/// The cells below WorstCells::bound_deg that have one cause, in all parts.
struct SharpPlace {
    SharpnessCause cause = SharpnessCause::unknown;
    SharpCells cells;
    NodeId part = root_node;   ///< part of the worst cell
    std::string region;        ///< its region; empty: there is one
    std::string patch;         ///< the patch of the facet that is to blame; empty: none, or there is one
    std::string way_out = {};  ///< a sentence on the options that help
};

/// Returns a place for each cause that has cells, the worst first.
std::vector<SharpPlace> sharp_places(const RunReport& report);

/// Returns the name of a cause in JSON.
const char* name_of(SharpnessCause cause);

/// Returns why cells are sharp there, as "a facet there has an angle of 0.03 degrees".
std::string why(const SharpPlace& place);

/// Returns "12 cells below 5 degrees, the worst of 0.02 at (1, 2, 3) in part 9, at patch lid: a facet there ...".
std::string sharp_text(const SharpPlace& place);

}  // namespace kerf
