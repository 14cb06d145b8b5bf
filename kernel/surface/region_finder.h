// What lies on the sides of facets, where the file does not say it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/soup.h"

namespace kerf {

/// What a patch lies between; an empty name: the outside.
struct NamedWall {
    std::string patch;
    std::array<std::string, 2> regions;
};

// All of these set Soup::sides and Soup::region_names. Facets of different regions have the smaller number behind them;
// a facet that is there several times is kept once, the first one; those with the same on both sides, and those with a
// repeated vertex, are left out, and a note counts them. They return false, and leave the soup as it is, if it has
// sides already, facets that do not conform, see find_cells(), or a wall with a hole: an edge of one facet, unless
// Soup::may_end_inside. Whether facets intersect is not asked: what
// diagnose() finds in the result says that. Requires numbers in range and a welded soup. Cost as find_cells().

/// By points: a cell with one of Soup::seeds is a region with its name, and cells with one name are one region. Cells
/// with a point of Soup::holes are empty. Other bounded cells are called "cell_1", "cell_2", ..., and a note says so.
/// Where one region is all that there is, its facets are turned outwards, and there are no sides. Throws Error(input),
/// naming points and places, for a point outside of all cells or on a facet, for two of different names in one cell,
/// and for one in a cell with a hole.
bool find_seeded_regions(Soup& soup);

/// By what lies between: from the outside on, each facet leads from one region of its patch into the other, so that
/// neither normals nor the order of two names count. `walls`: for every patch, in their order. Throws Error(input),
/// naming patch, regions and place, where a facet has one cell on both sides or a side that is none of its two regions,
/// and for a region that is nowhere.
bool find_walled_regions(Soup& soup, const std::vector<NamedWall>& walls);

/// Without points, in this order; false if none of them holds:
/// - All patches are closed by themselves, with normals that all point out or all point in, and some have a facet in
///   common: each is a body, whose region has its name. What is inside of several is the region of the smallest.
/// - Facets that are there twice, once in each direction, are walls, and all facets together enclose each point of
///   space so many times: the cells that are enclosed are the regions "region_1", "region_2", ...
/// - The facets are walls, each once, and none has outside on both sides: all bounded cells are regions, and a note
///   says how to name them.
/// All of them need a wall: bodies that touch along edges alone are not told from one that does so.
bool find_touching_bodies(Soup& soup);

/// Bodies that the caller knows, by the first of these, but they need not touch: by patches, or else each of all
/// patches with one number of `body_of_patch`, by the names of these.
bool find_given_bodies(Soup& soup, const std::vector<std::int32_t>& body_of_patch,
                       const std::vector<std::string>& names);

/// Bodies that are turned alike, as GivenBodies has them, one inside of another: the inner one is cut out of the outer
/// one. False, too, if none lies in another one.
bool find_nested_bodies(Soup& soup, const std::vector<std::int32_t>& body_of_facet,
                        const std::vector<std::string>& names);

/// Those of Soup::holes around which no facets close, so that they make no void. Empty where facets do not conform.
std::vector<Vec3> holes_outside(const Soup& soup);

/// Makes bounded cells that are no region regions, called "void_1", "void_2", ... A soup without sides must be closed;
/// what is inside of an odd number of its shells becomes the region "body" then, or "body_1", ...
bool fill_voids(Soup& soup);

}  // namespace kerf
