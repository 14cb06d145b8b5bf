// Bodies that overlap or touch, as regions that share walls.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "repair/repair_report.h"
#include "surface/given_bodies.h"
#include "surface/soup.h"

namespace kerf {

/// The bodies of a soup whose closed shells point out of what they enclose: its patches, if there are several and each
/// is closed by itself, else what hangs together over edges, called "body_1", "body_2", ... A void belongs to the
/// smallest body around it. `poll` may throw. O(#F log #F) and, for each void, questions to the bodies around it.
GivenBodies find_bodies(const Soup& soup, const std::function<void()>& poll);

/// What became of bodies.
struct BodyRegions {
    RepairAction made{"body made a region", "bodies made regions"};
    RepairAction overlaps{"overlap given to the smaller body", "overlaps given to the smaller body", "volume"};
    RepairAction hidden{"body left out, since smaller ones have all of it",
                        "bodies left out, since smaller ones have all of them"};
};

/// Makes each body a region: sets Soup::sides and Soup::region_names, leaves out what is no wall, and names walls
/// (surface/region_patches.h). What several bodies enclose belongs to the smallest of them, as in
/// find_touching_bodies(). Whether a body encloses a cell is told by winding numbers at the largest facets of the cell,
/// so that bodies need not be quite closed. Where one region is all that there is, there are no sides.
///
/// `bodies`: of the facets of the soup, which must be an arrangement (repair/arrangement.h). Nothing is done, and
/// nothing returned, where they do not conform or close nothing. `poll` may throw. O(#F log #F) and questions to each
/// body around a cell. Deterministic.
std::optional<BodyRegions> make_regions(Soup& soup, const GivenBodies& bodies, const std::function<void()>& poll);

}  // namespace kerf
