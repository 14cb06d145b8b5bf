// All facets, each once, divide space into cells (divided_space.h), and each cell gets a region. Either points tell the
// region of a cell, or a walk from cell to cell (cell_walk.h) does: crossing a facet leads into the bodies that have it
// in that direction, and out of those that have it in the opposite one. `Windings` counts how often each body is around
// a cell; they are well defined only if all bodies are closed, because a cell may be reached over several facets.
#include "surface/regions/region_finder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/name_pattern.h"
#include "base/core/number_text.h"
#include "surface/complex/mass_properties.h"
#include "surface/regions/cell_walk.h"
#include "surface/regions/cells.h"
#include "surface/regions/divided_space.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/region_patches.h"

namespace kerf {

namespace {

// The number of times that each body is around a cell, by ascending bodies, without bodies that are 0 times around it.
using Windings = std::vector<std::pair<std::int32_t, std::int32_t>>;

void add_winding(Windings& windings, std::int32_t body, std::int32_t times) {
    const auto place = std::lower_bound(windings.begin(), windings.end(), std::pair(body, std::int32_t{-1 << 30}));
    if (place == windings.end() || place->first != body)
        windings.insert(place, {body, times});
    else if ((place->second += times) == 0)
        windings.erase(place);
}

// The windings of all cells, if there are any: each body is closed then. `body`: per facet of the soup.
std::optional<std::vector<Windings>> find_windings(const DividedSpace& space, const std::vector<std::int32_t>& body) {
    const SingleFacets& single = space.single;
    std::vector<Windings> beyond(single.facets.size());  // of those behind a facet, less those in front of it
    for (std::size_t f = 0; f < body.size(); ++f)
        if (single.single_of[f] >= 0) add_winding(beyond[single.single_of[f]], body[f], single.is_turned[f] ? -1 : 1);
    const auto across = [&](Windings windings, std::int32_t facet, int sign) {
        for (const auto& [b, times] : beyond[facet]) add_winding(windings, b, sign * times);
        return windings;
    };
    std::vector<Windings> of(space.cells.count + 1);
    CellWalk(space.cells).run([&](std::int32_t from, std::int32_t facet, std::int32_t to) {
        of[to + 1] = across(of[from + 1], facet, space.cells.sides[facet].front == from ? 1 : -1);
    });
    for (std::int32_t u = 0; u < count_of(single.facets); ++u)
        if (const auto [front, back] = space.cells.sides[u]; across(of[front + 1], u, 1) != of[back + 1])
            return std::nullopt;
    of.erase(of.begin());
    return of;
}

// Whether a facet ends within a cell and the format does not allow that: a wall with a hole parts no regions.
bool has_open_wall(const Soup& soup, const DividedSpace& space) {
    bool is_open = false;
    if (!soup.may_end_inside)
        EdgeCorners(space.single.facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
            is_open |= corners.size() == 1;
        });
    return is_open;
}

bool has_wall(const DividedSpace& space) {
    return std::any_of(space.cells.sides.begin(), space.cells.sides.end(), [&](const CellSides& cells) {
        const FacetSides sides = {space.region_of(cells.front), space.region_of(cells.back)};
        return sides.is_wall() && sides.front != sides.back;
    });
}

// Whether a facet is there in several patches.
bool patches_have_wall(const Soup& soup, const SingleFacets& single) {
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        if (const std::int32_t u = single.single_of[f]; u >= 0 && soup.patch[single.first[u]] != soup.patch[f])
            return true;
    return false;
}

// Whether the normals of all patches point out, or all of them in.
bool are_turned_alike(const Soup& soup) {
    std::vector<std::vector<Triangle>> facets(soup.patch_names.size());
    for (std::size_t f = 0; f < soup.facets.size(); ++f) facets[soup.patch[f]].push_back(soup.facets[f]);
    bool is_any_out = false, is_any_in = false;
    for (const auto& own : facets) {
        const double volume = own.empty() ? 0 : enclosed_volume(soup.vertices, own);
        is_any_out |= volume > 0;
        is_any_in |= volume < 0;
    }
    return !is_any_out || !is_any_in;
}

// Whether each body is there, closed, and everywhere the right way round or everywhere inside out; two or more.
bool name_by_bodies(const Soup& soup, const std::vector<std::int32_t>& body_of_patch,
                    const std::vector<std::string>& names, DividedSpace& space) {
    Array<RegionIndex, std::vector<Triangle>> facets(names.size());
    std::vector<std::int32_t> body;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        body.push_back(body_of_patch[soup.patch[f]]);
        if (space.single.single_of[f] >= 0) facets[body[f]].push_back(soup.facets[f]);
    }
    if (std::count_if(facets.begin(), facets.end(), [](const auto& own) { return !own.empty(); }) < 2) return false;
    const auto windings = find_windings(space, body);
    if (!windings) return false;
    Array<RegionIndex, double> volume;
    for (const auto& own : facets) volume.push_back(own.empty() ? 0 : enclosed_volume(soup.vertices, own));
    space.region_of_cell.assign(space.cells.count, RegionIndex::none());
    for (std::int32_t c = 0; c < space.cells.count; ++c)
        for (const auto& [b, times] : (*windings)[c]) {
            const RegionIndex own(b);
            if (times != (volume[own] < 0 ? -1 : 1)) return false;
            RegionIndex& region = space.region_of_cell[c];
            if (!region.is_valid() || std::abs(volume[own]) < std::abs(volume[region])) region = own;
        }
    Array<RegionIndex, char> is_seen(facets.size(), 0);
    for (const RegionIndex region : space.region_of_cell)
        if (region.is_valid()) is_seen[region] = 1;
    for (const RegionIndex b : facets.ids())  // one that others hide is a mistake
        if (!facets[b].empty() && is_seen[b] == 0) return false;
    space.names = names;
    const auto& sides = space.cells.sides;
    return std::none_of(sides.begin(), sides.end(), [&](const CellSides& s) {
        return space.region_of(s.front) == space.region_of(s.back);  // what was one body may be several
    });
}

bool name_by_patches(const Soup& soup, DividedSpace& space) {
    std::vector<std::int32_t> own(soup.patch_names.size());
    std::iota(own.begin(), own.end(), 0);
    return name_by_bodies(soup, own, soup.patch_names, space);
}

void name_in_order(DividedSpace& space, const std::vector<char>& is_region, const char* prefix) {
    space.names.clear();
    for (std::int32_t c = 0; c < space.cells.count; ++c) {
        space.region_of_cell[c] = is_region[c] ? RegionIndex(space.names.size()) : RegionIndex::none();
        if (is_region[c]) space.names.push_back(fmt::format("{}_{}", prefix, space.names.size() + 1));
    }
}

// Whether all facets together enclose each cell so many times, and those that are there twice are so in both
// directions.
bool name_by_directions(DividedSpace& space) {
    const SingleFacets& single = space.single;
    std::vector<int> there(single.facets.size(), 0), excess(single.facets.size(), 0);
    for (std::size_t f = 0; f < single.single_of.size(); ++f) {
        if (single.single_of[f] < 0) continue;
        ++there[single.single_of[f]];
        excess[single.single_of[f]] += single.is_turned[f] ? -1 : 1;
    }
    for (std::size_t u = 0; u < there.size(); ++u)
        if (there[u] > 2 || (there[u] == 2 && excess[u] != 0)) return false;
    if (*std::max_element(there.begin(), there.end()) == 1) return false;
    const auto windings = find_windings(space, std::vector<std::int32_t>(single.single_of.size(), 0));
    if (!windings) return false;
    std::vector<char> is_region;
    for (const Windings& own : *windings) {
        if (!own.empty() && own[0].second < 0) return false;
        is_region.push_back(!own.empty());
    }
    name_in_order(space, is_region, "region");
    return has_wall(space);
}

// Whether every facet is there once, and is a wall between different cells or lies within one. Facets that close with
// their directions bound a body that touches itself, and are refused here.
bool name_between_walls(Soup& soup, DividedSpace& space) {
    if (space.single.facets.size() != soup.facets.size() || has_open_wall(soup, space)) return false;
    const auto& sides = space.cells.sides;
    const auto is_outside = [](const CellSides& s) { return s.front < 0 && s.back < 0; };
    if (std::any_of(sides.begin(), sides.end(), is_outside)) return false;
    name_in_order(space, std::vector<char>(space.cells.count, 1), "region");
    if (!has_wall(space) || !has_edge_of_many(soup.facets)) return false;
    if (find_windings(space, std::vector<std::int32_t>(soup.facets.size(), 0))) return false;
    soup.notes.push_back(fmt::format(
        "The facets are walls of {} regions, called region_1 to region_{}. Name them by points: --region NAME=x,y,z.",
        space.names.size(), space.names.size()));
    return true;
}

[[noreturn]] void refuse_point(const RegionSeed& seed, const std::string& what) {
    throw Error(ErrorCode::input,
                fmt::format("The point {} of the region '{}' {}", place_text(seed.point), seed.name, what));
}

// The regions in the order of their first points.
void place_seeds(const Soup& soup, const CellLocator& locator, DividedSpace& space) {
    std::vector<std::int32_t> seed_of(space.cells.count, -1);
    std::map<std::string, RegionIndex> number;
    for (std::int32_t s = 0; s < count_of(soup.seeds); ++s) {
        const RegionSeed& seed = soup.seeds[s];
        const std::optional<std::int32_t> cell = locator.find(seed.point);
        if (!cell) refuse_point(seed, "lies on a facet. Move it into the region.");
        if (*cell < 0)
            refuse_point(seed, "lies outside: no facets close around it. Move it into the region, or close its walls.");
        const auto [found, is_new] = number.try_emplace(seed.name, RegionIndex(space.names.size()));
        if (is_new) space.names.push_back(seed.name);
        if (seed_of[*cell] >= 0 && soup.seeds[seed_of[*cell]].name != seed.name)
            refuse_point(seed,
                         fmt::format("lies in one cell with the point {} of the region '{}': no facets are between "
                                     "them. Leave one of the points out, give both one name, or close the wall.",
                                     place_text(soup.seeds[seed_of[*cell]].point), soup.seeds[seed_of[*cell]].name));
        seed_of[*cell] = s;
        space.region_of_cell[*cell] = found->second;
    }
}

// Cells of holes stay empty; all others get names.
void name_other_cells(Soup& soup, const CellLocator& locator, DividedSpace& space) {
    std::vector<char> is_hole(space.cells.count, 0);
    for (const Vec3& hole : soup.holes) {
        const std::int32_t cell = locator.find(hole).value_or(-1);
        if (cell < 0) continue;
        is_hole[cell] = 1;
        if (const RegionIndex region = space.region_of_cell[cell]; region.is_valid())
            throw Error(ErrorCode::input,
                        fmt::format("The point {} of a hole lies in the region '{}': no facets are between it and the "
                                    "point of the region. Leave one of them out, or close the wall.",
                                    place_text(hole), space.names[region.value()]));
    }
    const std::set<std::string> taken(space.names.begin(), space.names.end());
    std::vector<std::string> added;
    int number = 0;
    for (std::int32_t c = 0; c < space.cells.count; ++c) {
        if (is_hole[c] || space.region_of_cell[c].is_valid()) continue;
        do ++number;
        while (taken.contains(fmt::format("cell_{}", number)));
        added.push_back(fmt::format("cell_{}", number));
        space.region_of_cell[c] = RegionIndex(space.names.size());
        space.names.push_back(added.back());
    }
    if (added.empty()) return;
    soup.notes.push_back(fmt::format("{} without a point of a region: {}.",
                                     added.size() == 1 ? "1 cell is" : fmt::format("{} cells are", added.size()),
                                     added.size() == 1 ? added[0] : added.front() + " to " + added.back()));
}

// The regions of walls in the order in which they are named; none is the outside.
std::vector<std::array<RegionIndex, 2>> number_walls(const std::vector<NamedWall>& walls,
                                                     std::vector<std::string>& names) {
    std::vector<std::array<RegionIndex, 2>> numbers;
    for (const NamedWall& wall : walls) {
        std::array<RegionIndex, 2>& own = numbers.emplace_back(std::array{RegionIndex::none(), RegionIndex::none()});
        for (std::size_t side = 0; side < 2; ++side) {
            if (wall.regions[side].empty()) continue;
            const auto found = std::find(names.begin(), names.end(), wall.regions[side]);
            own[side] = RegionIndex(found - names.begin());
            if (found == names.end()) names.push_back(wall.regions[side]);
        }
    }
    return numbers;
}

std::string quoted_region(const std::string& name) { return name.empty() ? "the outside" : fmt::format("'{}'", name); }

[[noreturn]] void refuse_wall(const NamedWall& wall, const Vec3& place, const std::string& what) {
    throw Error(ErrorCode::input,
                fmt::format("The patch '{}' is to lie between {} and {}, but at {} {}", wall.patch,
                            quoted_region(wall.regions[0]), quoted_region(wall.regions[1]), place_text(place), what));
}

// Gives each cell its region: a facet leads from one of its patch's two regions into the other. Throws where that
// fails.
void place_walls(const Soup& soup, const std::vector<NamedWall>& walls, DividedSpace& space) {
    const std::vector<std::array<RegionIndex, 2>> numbers = number_walls(walls, space.names);
    const auto place_of = [&](std::int32_t facet) {
        const auto& [a, b, c] = space.single.facets[facet];
        return Vec3((soup.vertices[a] + soup.vertices[b] + soup.vertices[c]) / 3);
    };
    const auto patch_of = [&](std::int32_t facet) { return soup.patch[space.single.first[facet]]; };
    const auto refuse_side = [&](std::int32_t facet, RegionIndex region) {
        refuse_wall(walls[patch_of(facet)], place_of(facet),
                    fmt::format("{} lies on one of its sides. Correct the regions of the patch, or of those around it.",
                                quoted_region(region.is_valid() ? space.names[region.value()] : std::string())));
    };
    const auto count = count_of(space.single.facets);
    for (std::int32_t f = 0; f < count; ++f)
        if (space.cells.sides[f].front == space.cells.sides[f].back)
            refuse_wall(walls[patch_of(f)], place_of(f),
                        "no facets part them: the same cell is on both sides. Close the walls around it.");
    CellWalk(space.cells).run([&](std::int32_t from, std::int32_t facet, std::int32_t to) {
        const auto& [one, other] = numbers[patch_of(facet)];
        const RegionIndex region = space.region_of(from);
        if (region != one && region != other) refuse_side(facet, region);
        space.region_of_cell[to] = region == one ? other : one;
    });
    for (std::int32_t f = 0; f < count; ++f) {
        const auto& [one, other] = numbers[patch_of(f)];
        const RegionIndex front = space.region_of(space.cells.sides[f].front),
                          back = space.region_of(space.cells.sides[f].back);
        for (const RegionIndex side : {front, back})
            if (side != one && side != other) refuse_side(f, side);
        if (front == back) refuse_side(f, front);
    }
    for (const RegionIndex r : ids<RegionIndex>(space.names.size()))
        if (std::find(space.region_of_cell.begin(), space.region_of_cell.end(), r) == space.region_of_cell.end())
            throw Error(ErrorCode::input, fmt::format("The region '{}' is nowhere: no facets of its patches close "
                                                      "around it. Correct the regions of patches.",
                                                      space.names[r.value()]));
}

// One region needs no sides.
void leave_out_single_region(Soup& soup) {
    if (soup.region_names.size() > 1) return;
    soup.sides.clear();
    soup.region_names.clear();
}

// Walls between an empty region and others are faces of the hole now.
void call_walls_by_holes(Soup& soup, const std::vector<std::string>& regions, const std::vector<char>& is_empty) {
    for (std::size_t hole = 0; hole < regions.size(); ++hole) {
        if (is_empty[hole] == 0) continue;
        std::vector<std::size_t> walls;
        for (std::size_t p = 0; p < soup.patch_names.size(); ++p)
            for (std::size_t other = 0; other < regions.size(); ++other)
                if (is_empty[other] == 0 &&
                    soup.patch_names[p] == wall_name(regions, {RegionIndex(hole), RegionIndex(other)}))
                    walls.push_back(p);
        const std::vector<std::string>& names = soup.patch_names;
        if (walls.size() == 1 && std::find(names.begin(), names.end(), regions[hole]) == names.end())
            soup.patch_names[walls[0]] = regions[hole];
    }
}

}  // namespace

bool find_walled_regions(Soup& soup, const std::vector<NamedWall>& walls) {
    if (!soup.sides.empty()) return false;
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space) return false;
    place_walls(soup, walls, *space);
    give_sides(soup, std::move(*space));
    leave_out_single_region(soup);
    return true;
}

bool find_seeded_regions(Soup& soup) {
    if (!soup.sides.empty() || soup.seeds.empty()) return false;
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space || has_open_wall(soup, *space)) return false;
    const CellLocator locator(soup.vertices, space->single.facets, space->cells);
    place_seeds(soup, locator, *space);
    name_other_cells(soup, locator, *space);
    give_sides(soup, std::move(*space));
    leave_out_single_region(soup);
    return true;
}

bool find_touching_bodies(Soup& soup) {
    if (!soup.sides.empty()) return false;
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space || space->cells.count < 2) return false;
    bool is_found = patches_have_wall(soup, space->single) && name_by_patches(soup, *space);
    if (!is_found) {
        space->region_of_cell.assign(space->cells.count, RegionIndex::none());
        is_found = name_by_directions(*space) || name_between_walls(soup, *space);
    }
    if (is_found) give_sides(soup, std::move(*space));
    return is_found;
}

bool find_given_bodies(Soup& soup, const std::vector<std::int32_t>& body_of_patch,
                       const std::vector<std::string>& names) {
    if (!soup.sides.empty()) return false;
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space) return false;
    if (!name_by_patches(soup, *space) && !name_by_bodies(soup, body_of_patch, names, *space)) return false;
    give_sides(soup, std::move(*space));
    return true;
}

bool find_nested_bodies(Soup& soup, const std::vector<std::int32_t>& body_of_facet,
                        const std::vector<std::string>& names) {
    if (!soup.sides.empty()) return false;
    Soup bodies = soup;
    bodies.patch = body_of_facet;
    bodies.patch_names = names;
    std::optional<DividedSpace> space = divide_space(bodies);
    if (!space || !name_by_patches(bodies, *space) || !has_wall(*space) || !are_turned_alike(bodies)) return false;
    give_sides(soup, std::move(*space));
    return true;
}

void leave_regions_empty(Soup& soup, const std::vector<std::string>& patterns) {
    const std::vector<std::string> names = soup.region_names;
    std::vector<char> is_empty(names.size(), 0);
    for (const std::string& pattern : patterns)
        for (const std::int32_t region : matching_names("--hole", "region", pattern, names)) is_empty[region] = 1;
    Array<RegionIndex, RegionIndex> number(names.size(), RegionIndex::none());
    soup.region_names.clear();
    for (std::size_t r = 0; r < names.size(); ++r) {
        if (is_empty[r] != 0) continue;
        number[RegionIndex(r)] = RegionIndex(soup.region_names.size());
        soup.region_names.push_back(names[r]);
    }
    if (soup.region_names.empty())
        throw Error(ErrorCode::usage, "--hole leaves no region to be meshed. Name only those that are to be empty.");
    call_walls_by_holes(soup, names, is_empty);
    std::vector<char> drop(soup.facets.size(), 0);
    const auto new_number = [&](RegionIndex region) { return region.is_valid() ? number[region] : region; };
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        FacetSides& sides = soup.sides[f];
        sides = {new_number(sides.front), new_number(sides.back)};
        drop[f] = sides.front == sides.back ? 1 : 0;
        if (sides.back.is_valid()) continue;
        sides = sides.turned();
        std::swap(soup.facets[f][1], soup.facets[f][2]);
    }
    drop_facets(soup, drop);
    drop_unused_patches(soup);
    drop_unused_vertices(soup);
    leave_out_single_region(soup);
}

std::vector<Vec3> holes_outside(const Soup& soup) {
    if (soup.holes.empty()) return {};
    const std::optional<DividedSpace> space = divide_space(soup);
    if (!space) return {};
    const CellLocator locator(soup.vertices, space->single.facets, space->cells);
    std::vector<Vec3> outside;
    for (const Vec3& hole : soup.holes)
        if (locator.find(hole).value_or(0) < 0) outside.push_back(hole);
    return outside;
}

bool fill_voids(Soup& soup) {
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space) return false;
    std::vector<RegionIndex>& region = space->region_of_cell;
    if (soup.sides.empty()) {
        std::vector<char> is_inside(space->cells.count, 0);
        CellWalk(space->cells).run([&](std::int32_t from, std::int32_t, std::int32_t to) {
            is_inside[to] = from < 0 || !is_inside[from];
        });
        name_in_order(*space, is_inside, "body");
        if (space->names.size() == 1) space->names[0] = "body";
    } else {
        space->names = soup.region_names;
        for (std::size_t u = 0; u < space->single.facets.size(); ++u) {
            const CellSides& cells = space->cells.sides[u];
            const FacetSides& sides = soup.sides[space->single.first[u]];
            if (cells.front >= 0) region[cells.front] = sides.front;
            if (cells.back >= 0) region[cells.back] = sides.back;
        }
    }
    std::int32_t voids = 0;
    for (RegionIndex& own : region) {
        if (own.is_valid()) continue;
        own = RegionIndex(space->names.size());
        space->names.push_back(fmt::format("void_{}", ++voids));
    }
    if (voids == 0) return false;
    give_sides(soup, std::move(*space));
    return true;
}

}  // namespace kerf
