#include "files/export/inside/cell_groups.h"

#include <fmt/format.h>

#include "files/export/inside/by_patch.h"
#include "files/export/inside/materials.h"

namespace kerf {

namespace groups {

std::vector<std::string> material_names(const Materials& materials) {
    if (materials.are_regions()) return materials.names();
    if (materials.count() == 1) return {"volume"};
    std::vector<std::string> names;
    for (std::int32_t body = 1; body <= materials.count(); ++body) names.push_back(fmt::format("body_{}", body));
    return names;
}

std::vector<CellGroup> numbered(const std::vector<std::string>& names, std::span<const std::int64_t> sizes,
                                std::int64_t first) {
    std::vector<CellGroup> groups;
    for (std::size_t i = 0; i < names.size(); ++i) {
        groups.push_back({names[i], first, sizes[i]});
        first += sizes[i];
    }
    return groups;
}

std::vector<std::int64_t> sizes_of(const std::vector<CellGroup>& groups) {
    std::vector<std::int64_t> sizes;
    for (const CellGroup& group : groups) sizes.push_back(group.count);
    return sizes;
}

// Returns what gives cells that come in the order of their groups to `take`.
auto numbering(const std::vector<CellGroup>& groups, const TakeCells& take) {
    return [&groups, &take, number = groups.empty() ? 0 : groups.front().first](
               std::int32_t group, std::span<const GroupCell> cells) mutable {
        take(groups[group], number, cells);
        number += cells.size();
    };
}

}  // namespace groups

CellGroups cell_groups(const PartSource& parts, WordRules rules) {
    const MeshOutline& outline = parts.outline();
    const Materials materials(parts);
    const std::vector<std::string> patches = word_names(outline.patch_names, rules);
    rules.taken.insert(rules.taken.end(), patches.begin(), patches.end());
    rules.kind = "region";
    return {groups::numbered(word_names(groups::material_names(materials), rules), materials.sizes(), 0),
            groups::numbered(patches, patch_sizes(parts), outline.tets())};
}

void for_each_tet_by_material(const PartSource& parts, const CellGroups& groups, const TakeCells& take) {
    const Materials materials(parts);
    const auto visit = [&](const auto& add) {
        for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
            const std::vector<std::int32_t> of_tets = materials.of_tets(index, part);
            for (std::size_t t = 0; t < of_tets.size(); ++t) add({of_tets[t], nodes_of_tet(part, t)});
        });
    };
    for_each_by_patch<GroupCell>(groups::sizes_of(groups.materials), visit, groups::numbering(groups.materials, take));
}

void for_each_triangle_by_patch(const PartSource& parts, const CellGroups& groups, const TakeCells& take) {
    const auto visit = [&](const auto& add) {
        for_each_part(parts, patch_content(parts.outline()), [&](PartIndex, const Part& part) {
            for_each_listed_facet(part, [&](std::size_t f) { add({part.patch[f], nodes_of_facet(part, f)}); });
        });
    };
    for_each_by_patch<GroupCell>(groups::sizes_of(groups.patches), visit, groups::numbering(groups.patches, take));
}

}  // namespace kerf
