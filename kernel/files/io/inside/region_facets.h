// Facets with the regions on their sides, for surfaces of several regions.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/core/ids.h"
#include "files/io/inside/tet_skin.h"
#include "surface/soup/soup.h"

namespace kerf {

/// The number of a volume in a file: a group, 0 if there is none, and an entity in it.
using VolumeKey = std::pair<std::int64_t, std::int64_t>;

/// The regions that the volumes of a file are: volumes of one name are one region.
struct VolumeRegions {
    std::vector<RegionIndex> region_of_volume;  ///< one per volume
    std::vector<std::string> names;             ///< names of the regions, each once, in the order of the keys
};

/// Makes regions of volumes by their names, in the order of the keys. `number_of_volume`: from 0 on, without gaps;
/// `name(key)`: the name of a volume, cut after 255 bytes. O(n log n).
template <class Name>
VolumeRegions regions_of(const std::map<VolumeKey, std::int32_t>& number_of_volume, const Name& name) {
    constexpr std::size_t longest_name = 255;  // bytes that are kept, as of patches
    VolumeRegions regions{std::vector<RegionIndex>(number_of_volume.size()), {}};
    std::map<std::string, RegionIndex> region_of_name;
    for (const auto& [key, volume] : number_of_volume) {
        const RegionIndex next(regions.names.size());
        const auto [region, is_new] = region_of_name.try_emplace(std::string(name(key)).substr(0, longest_name), next);
        if (is_new) regions.names.push_back(region->first);
        regions.region_of_volume[volume] = region->second;
    }
    return regions;
}

/// The numbers of polygons and patches in the file of a soup.
struct FileFacets {
    std::int32_t polygon_count;       ///< faces of the file
    std::int32_t unnamed_patch = -1;  ///< patch of the facets to which the file gives none; -1: all have one
};

/// Makes the faces of tetrahedra the facets of a soup: first the faces that were facets before, in their order and
/// patch, then the others, in patches of their own: "outer", or "A_to_B" between the regions A and B. All are turned as
/// the faces are. Facets that are no such face, and copies, are left out, which Soup::notes says. With a single region
/// Soup::sides stay empty, and its patch is "surface". Throws Error(input) with `path` for three tetrahedra at one
/// face. O(n log n) for n facets and faces, deterministic.
void take_region_faces(Soup& soup, const std::vector<RegionFace>& faces, const std::vector<std::string>& region_names,
                       const FileFacets& file, const std::string& path);

/// Gives the facets of a soup these sides (#F), and turns them so that the smaller region, or the only one, is behind.
/// Facets with the same on both sides are left out, which Soup::notes says. O(#F).
void take_region_sides(Soup& soup, std::vector<FacetSides> sides, const std::vector<std::string>& region_names);

/// Throws Error(input), because tetrahedra of the two regions at this face overlap.
[[noreturn]] void refuse_overlap(const Soup& soup, const RegionFace& face, const std::vector<std::string>& region_names,
                                 const std::string& path);

}  // namespace kerf
