// From facets to cells to walls. Copies of a facet, whichever way they are turned, are found by sorting facets by their
// sorted corners; the first stands for all of them, because find_cells() takes no copies. Once the cells have regions,
// a facet is a wall if these differ on its sides; it is turned so that the smaller number, and never the outside, is
// behind it. All other facets and all copies are dropped and counted in notes.
#include "surface/regions/divided_space.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "surface/soup/region_patches.h"

namespace kerf {

namespace {

bool have_one_direction(Triangle a, Triangle b) {
    std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
    std::rotate(b.begin(), std::min_element(b.begin(), b.end()), b.end());
    return a == b;
}

// Regions with a cell keep their order.
void drop_empty_regions(DividedSpace& space) {
    Array<RegionIndex, RegionIndex> number(space.names.size(), RegionIndex::none());
    for (const RegionIndex region : space.region_of_cell)
        if (region.is_valid()) number[region] = RegionIndex(0);
    std::vector<std::string> names;
    for (const RegionIndex r : number.ids()) {
        if (!number[r].is_valid()) continue;
        number[r] = RegionIndex(names.size());
        names.push_back(space.names[r.value()]);
    }
    space.names = std::move(names);
    for (RegionIndex& region : space.region_of_cell)
        if (region.is_valid()) region = number[region];
}

void note_count(Soup& soup, std::int64_t count, const char* one, const char* many) {
    if (count > 0) soup.notes.push_back(fmt::format("{} {}.", count, count == 1 ? one : many));
}

}  // namespace

SingleFacets single_facets(const std::vector<Triangle>& facets) {
    SingleFacets single;
    single.single_of.assign(facets.size(), -1);
    single.is_turned.assign(facets.size(), 0);
    std::vector<std::pair<Triangle, std::int32_t>> sorted;
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        if (has_repeated_vertex(facets[f])) continue;
        sorted.emplace_back(facets[f], f);
        std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::int32_t> first_of(facets.size(), -1);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const std::int32_t f = sorted[i].second;
        const bool is_first = i == 0 || sorted[i].first != sorted[i - 1].first;
        first_of[f] = is_first ? f : first_of[sorted[i - 1].second];
        single.is_turned[f] = !have_one_direction(facets[f], facets[first_of[f]]);
    }
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        if (first_of[f] < 0) continue;
        if (first_of[f] == f) {
            single.single_of[f] = count_of(single.facets);
            single.facets.push_back(facets[f]);
            single.first.push_back(f);
        }
        single.single_of[f] = single.single_of[first_of[f]];
    }
    return single;
}

std::optional<DividedSpace> divide_space(const Soup& soup) {
    constexpr double largest_magnitude_of_rays = 1e50;  // what is larger is a defect anyway
    const auto is_usable = [](const Vec3& p) {
        return p.allFinite() && p.cwiseAbs().maxCoeff() <= largest_magnitude_of_rays;
    };
    if (soup.facets.empty() || !std::all_of(soup.vertices.begin(), soup.vertices.end(), is_usable)) return {};
    DividedSpace space{single_facets(soup.facets), {}, {}, {}};
    auto cells = find_cells(soup.vertices, space.single.facets);
    if (!cells || cells->count == 0) return {};
    space.cells = std::move(*cells);
    space.region_of_cell.assign(space.cells.count, RegionIndex::none());
    return space;
}

void give_sides(Soup& soup, DividedSpace space) {
    drop_empty_regions(space);
    std::vector<char> drop(soup.facets.size(), 1);
    soup.sides.assign(soup.facets.size(), FacetSides{});
    std::int64_t copies = 0, internal = 0;
    for (std::size_t u = 0; u < space.single.facets.size(); ++u) {
        const std::int32_t f = space.single.first[u];
        const auto [front, back] = space.cells.sides[u];
        FacetSides sides = {space.region_of(front), space.region_of(back)};
        internal += sides.front == sides.back;
        if (sides.front == sides.back) continue;
        if (!sides.back.is_valid() || (sides.front.is_valid() && sides.front < sides.back)) {
            sides = sides.turned();
            std::swap(soup.facets[f][1], soup.facets[f][2]);
        }
        soup.sides[f] = sides;
        drop[f] = 0;
    }
    for (std::int32_t f = 0; f < count_of(soup.facets); ++f) {
        const std::int32_t u = space.single.single_of[f];
        copies += u >= 0 && space.single.first[u] != f;
    }
    drop_facets(soup, drop);
    soup.region_names = std::move(space.names);
    name_walls(soup);
    note_count(soup, copies, "facet is there more than once, and is kept once",
               "facets are there more than once, and are kept once");
    note_count(soup, internal, "facet with the same on both sides is left out",
               "facets with the same on both sides are left out");
}

}  // namespace kerf
