#include "export/wall_sides.h"

#include <algorithm>

#include "export/whole_mesh.h"

namespace kerf {

WallSides::WallSides(const PartSource& parts) {
    if (parts.outline().region_names.empty()) return;
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (!part.is_wall(f)) continue;
            const RegionIndex region = region_behind(part, f);
            RegionIndex& first = first_at_.try_emplace(part.facet[f], region).first->second;
            first = std::min(first, region);
        }
    });
}

bool WallSides::is_first(const Part& part, std::size_t f) const {
    return first_at_.at(part.facet[f]) == region_behind(part, f);
}

RegionIndex region_behind(const Part& part, std::size_t f) {
    return part.region_of(part.mesh.tets.empty() ? 0 : part.tet_at_facet[f]);
}

}  // namespace kerf
