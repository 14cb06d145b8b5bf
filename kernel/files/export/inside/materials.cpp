#include "files/export/inside/materials.h"

#include <algorithm>

#include "files/export/whole_mesh.h"
#include "files/part/bodies.h"

namespace kerf {

namespace {

std::vector<std::int32_t> regions_of_tets(const Part& part) {
    std::vector<std::int32_t> regions(part.mesh.tets.size());
    for (const RegionRun& run : part.regions)
        std::fill(regions.begin() + run.first_tet, regions.end(), run.region.value());
    return regions;
}

}  // namespace

std::int32_t Materials::count() const { return are_regions() ? std::ssize(names()) : parts_->bodies().count(); }

std::vector<std::int64_t> Materials::sizes() const {
    if (!are_regions()) return parts_->bodies().sizes();
    std::vector<std::int64_t> sizes(names().size(), 0);
    for_each_part(*parts_, PartContent::cells, [&](PartIndex, const Part& part) {
        for (std::size_t r = 0; r < part.regions.size(); ++r) {
            const bool is_last = r + 1 == part.regions.size();
            const std::int64_t end = is_last ? part.tet_count() : part.regions[r + 1].first_tet;
            sizes[part.regions[r].region.value()] += end - part.regions[r].first_tet;
        }
    });
    return sizes;
}

std::vector<std::int32_t> Materials::of_tets(PartIndex index, const Part& part) const {
    return are_regions() ? regions_of_tets(part) : parts_->bodies().of_tets(index, part);
}

}  // namespace kerf
