// Finds the regions on the sides of facets where the file does not say them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// The two regions that a patch lies between; an empty name means the outside.
struct NamedWall {
    std::string patch;
    std::array<std::string, 2> regions;
};

// All functions that return bool set Soup::sides and Soup::region_names. A facet between two regions has that with the
// smaller number behind it; of copies of a facet the first is kept; facets with the same on both sides, and those with
// a repeated vertex, are left out, and a note counts them. The functions that find regions return false, and leave the
// soup as it is, if it has sides already or facets that do not conform (see find_cells()), and all but
// find_walled_regions() also if it has a wall with a hole: an edge of one facet, unless Soup::may_end_inside. They do
// not look for intersecting facets, which diagnose() finds in the result. They require numbers in range and a welded
// soup. Cost as find_cells().

/// Finds regions by points: a cell with one of Soup::seeds is a region with the seed's name, and cells with one name
/// are one region. Cells with a point of Soup::holes are empty. Other bounded cells are called "cell_1", "cell_2", ...,
/// and a note says so. A single region gets facets turned outwards, and no sides. Throws Error(input), naming points
/// and places, for a point outside of all cells or on a facet, for two points of different names in one cell, and for a
/// point in a cell with a hole.
bool find_seeded_regions(Soup& soup);

/// Finds regions by the two names of each patch: from the outside on, each facet leads from one region of its patch
/// into the other, so that neither normals nor the order of the two names count. `walls` has an entry for every patch,
/// in their order. Throws Error(input), naming patch, regions and place, if a facet has one cell on both sides or a
/// side that is neither of its two regions, and for a region without cells.
bool find_walled_regions(Soup& soup, const std::vector<NamedWall>& walls);

/// Finds regions without points, by the first of these rules that holds; false if none does:
/// - All patches are closed by themselves, each with normals that all point out or all point in, and some have a facet
///   in common: each is a body, whose region has its name. A cell inside of several is in the region of the smallest.
/// - Facets that are there twice, once in each direction, are walls, and the number of times that all facets together
///   wind around a cell is defined and never negative: the cells with a positive number are the regions "region_1",
///   "region_2", ...
/// - The facets are walls, each once, and none has outside on both sides: all bounded cells are regions, and a note
///   says how to name them.
/// All rules need a wall: bodies that touch along edges alone are not told from one body that touches itself.
bool find_touching_bodies(Soup& soup);

/// Finds regions of bodies that the caller knows, by the first rule of find_touching_bodies(), but the bodies need not
/// touch. First each patch is taken as a body; where that fails, all patches p with one number body_of_patch[p], an
/// index into `names`, are one.
bool find_given_bodies(Soup& soup, const std::vector<std::int32_t>& body_of_patch,
                       const std::vector<std::string>& names);

/// Makes regions of bodies turned alike, as in GivenBodies, of which one lies inside of another: the inner one is cut
/// out of the outer one. Also false if no body lies inside of another.
bool find_nested_bodies(Soup& soup, const std::vector<std::int32_t>& body_of_facet,
                        const std::vector<std::string>& names);

/// Returns the points of Soup::holes that no facets enclose, so that they make no void. Empty if facets do not conform.
std::vector<Vec3> holes_outside(const Soup& soup);

/// Leaves the regions empty whose names match one of the patterns, in which '*' stands for any characters: a facet
/// between one of them and another region bounds that alone, and facets that bound nothing else go. A wall A_to_B of an
/// empty region B is called B, if nothing else is. A single region that is left has no sides. Throws Error(usage) for a
/// pattern that matches no region, and if no region is left. O(#F).
void leave_regions_empty(Soup& soup, const std::vector<std::string>& patterns);

/// Makes regions of bounded cells that are none, called "void_1", "void_2", ... A soup without sides must be closed;
/// the cells inside of an odd number of its shells then become the region "body", or "body_1", ...
bool fill_voids(Soup& soup);

}  // namespace kerf
