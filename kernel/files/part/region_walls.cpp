#include "files/part/region_walls.h"

#include <algorithm>
#include <set>

namespace kerf {

namespace {

template <class T>
Array<RegionIndex, std::vector<T>> ascending(const Array<RegionIndex, std::set<T>>& sets) {
    Array<RegionIndex, std::vector<T>> lists;
    for (const std::set<T>& set : sets) lists.emplace_back(set.begin(), set.end());
    return lists;
}

}  // namespace

RegionWalls::RegionWalls(const PartSource& parts) {
    const std::size_t count = parts.outline().region_names.size();
    if (count == 0) return;
    Array<RegionIndex, std::set<RegionIndex>> neighbours(count);
    Array<RegionIndex, std::set<std::int32_t>> outer(count);
    for (const PartIndex index : parts.outline().parts.ids()) {
        const Part part = parts.load_only(index, PartContent::surface);
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            const RegionIndex region = region_behind(part, f);
            if (part.is_on_outer_boundary(f) && part.patch[f] >= 0) outer.at(region.value()).insert(part.patch[f]);
            if (!part.is_wall(f)) continue;
            auto& [first, second] = sides_at_.try_emplace(part.facet[f], region, region).first->second;
            first = std::min(first, region);
            second = std::max(second, region);
        }
    }
    for (const auto& [facet, sides] : sides_at_) {
        if (sides.first == sides.second) continue;  // the other part is none of these
        neighbours[sides.first].insert(sides.second);
        neighbours[sides.second].insert(sides.first);
    }
    neighbours_ = ascending(neighbours);
    outer_patches_ = ascending(outer);
}

bool RegionWalls::is_first(const Part& part, std::size_t f) const {
    return sides_at_.at(part.facet[f]).first == region_behind(part, f);
}

RegionIndex RegionWalls::beyond(const Part& part, std::size_t f) const {
    const auto& [first, second] = sides_at_.at(part.facet[f]);
    return first == region_behind(part, f) ? second : first;
}

RegionIndex region_behind(const Part& part, std::size_t f) {
    return part.region_of(part.mesh.tets.empty() ? 0 : part.tet_at_facet[f]);
}

}  // namespace kerf
