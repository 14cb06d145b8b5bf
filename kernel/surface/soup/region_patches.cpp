#include "surface/soup/region_patches.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "base/core/ids.h"
#include "base/core/unique_name.h"

namespace kerf {

namespace {

// The patches of the file that keep some of their facets.
class PatchesOfFile {
 public:
    explicit PatchesOfFile(const Soup& soup)
        : soup_(soup), regions_(soup.region_names.begin(), soup.region_names.end()) {
        has_outer_.assign(soup.patch_names.size(), 0);
        for (std::size_t f = 0; f < soup.facets.size(); ++f)
            if (!soup.sides[f].is_wall()) has_outer_[patch_of(f)] = 1;
        for (const std::string& name : soup.patch_names) is_region_.push_back(regions_.contains(name) ? 1 : 0);
    }
    bool keeps(std::size_t facet) const {
        const std::int32_t patch = patch_of(facet);
        return is_region_[patch] == 0 && !(soup_.sides[facet].is_wall() && has_outer_[patch] != 0);
    }
    // The names of regions, and of patches that keep a facet.
    std::set<std::string> taken_names() const {
        std::set<std::string> taken = regions_;
        for (std::size_t f = 0; f < soup_.facets.size(); ++f)
            if (keeps(f)) taken.insert(soup_.patch_names[patch_of(f)]);
        return taken;
    }

 private:
    std::int32_t patch_of(std::size_t facet) const { return soup_.patch[facet]; }

    const Soup& soup_;
    std::set<std::string> regions_;
    std::vector<char> has_outer_, is_region_;
};

}  // namespace

std::string wall_name(const std::vector<std::string>& region_names, FacetSides sides) {
    const auto [first, second] = std::minmax(sides.front, sides.back);
    return region_names[first.value()] + "_to_" + region_names[second.value()];
}

void name_walls(Soup& soup) {
    if (soup.sides.empty()) return;
    const PatchesOfFile of_file(soup);
    std::vector<std::size_t> others;  // facets
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        if (!of_file.keeps(f)) others.push_back(f);
    std::set<std::string> taken = of_file.taken_names();
    std::map<std::pair<RegionIndex, RegionIndex>, std::int32_t> patch_between;
    std::vector<std::int32_t> patch = soup.patch;
    for (const std::size_t f : others) {
        const FacetSides sides = soup.sides[f];
        const auto next = count_of(soup.patch_names);
        const auto [found, is_new] = patch_between.try_emplace(std::minmax(sides.front, sides.back), next);
        patch[f] = found->second;
        if (!is_new) continue;
        const RegionIndex region = std::max(sides.front, sides.back);
        soup.patch_names.push_back(unique_name(
            sides.is_wall() ? wall_name(soup.region_names, sides) : soup.region_names[region.value()] + "_outer",
            taken));
        if (!soup.patch_colours.empty()) soup.patch_colours.push_back(soup.patch_colours[soup.patch[f]]);
    }
    soup.patch = std::move(patch);
    drop_unused_patches(soup);
}

void drop_unused_patches(Soup& soup) {
    std::vector<std::int32_t> number(soup.patch_names.size(), -1);
    std::vector<std::string> names;
    auto colours = std::exchange(soup.patch_colours, {});
    for (std::int32_t& patch : soup.patch) {
        const std::int32_t old = patch;
        if (number[old] < 0) {
            number[old] = count_of(names);
            names.push_back(std::move(soup.patch_names[old]));
            if (!colours.empty()) soup.patch_colours.push_back(colours[old]);
        }
        patch = number[old];
    }
    soup.patch_names = std::move(names);
}

}  // namespace kerf
