// Bodies that overlap or touch, as regions that share walls.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "surface/diagnosis/given_bodies.h"
#include "surface/repair/repair_report.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Returns the bodies of a soup whose closed shells point out of the space that they enclose: its patches, if there are
/// several and each is closed by itself, else the pieces that hang together over edges, called "body_1", "body_2", ...
/// A void belongs to the smallest body around it. `check_cancelled` may throw. O(#F log #F) and, for each void,
/// questions to the bodies around it.
GivenBodies find_bodies(const Soup& soup, const std::function<void()>& check_cancelled);

/// The bodies that became regions, their overlaps, and the bodies that were left out, as repair actions.
struct BodyRegions {
    RepairAction made{"body made a region", "bodies made regions"};
    RepairAction overlaps{"overlap given to the smaller body", "overlaps given to the smaller body", "volume"};
    RepairAction hidden{"body left out, since smaller ones have all of it",
                        "bodies left out, since smaller ones have all of them"};
};

/// Makes each body a region: sets Soup::sides and Soup::region_names, leaves out facets that are no walls, and names
/// walls (surface/soup/region_patches.h). Space that several bodies enclose belongs to the smallest of them, as in
/// find_touching_bodies(). Whether a body encloses a cell is told by winding numbers at the largest facets of the cell,
/// so that bodies need not be quite closed. Where only one region comes of it, the soup gets no sides.
///
/// `bodies`: the body of each facet of the soup, which must be an arrangement (surface/arrange/arrangement.h). Returns
/// nothing, and changes nothing, where the facets do not conform or close nothing. `check_cancelled` may throw. O(#F
/// log #F) and questions to each body around a cell. Deterministic.
std::optional<BodyRegions> make_regions(Soup& soup, const GivenBodies& bodies,
                                        const std::function<void()>& check_cancelled);

}  // namespace kerf
