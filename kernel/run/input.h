// From a surface file to the closed surface that is cut.
#pragma once

#include <string>
#include <vector>

#include "surface/orientation.h"
#include "surface/surface.h"

namespace kerf {

/// A surface ready to be cut, and what was learnt about it.
struct Input {
    std::string path;
    std::int64_t vertices = 0;
    std::int64_t facets = 0;
    std::int64_t components = 0;
    std::int64_t genus = 0;  ///< sum over the components
    double volume = 0;
    double area = 0;
    double diagonal = 0;               ///< of the bounding box
    std::int64_t welded_vertices = 0;  ///< merged because their coordinates are equal
    std::int64_t unused_vertices = 0;  ///< dropped because no facet uses them
    OrientationReport orientation;
    std::int64_t moved_vertices = 0;  ///< by the optimisation of the surface
    double largest_move = 0;          ///< of a vertex by that
    std::vector<std::string> patch_names;
    Surface surface;
};

/// Reads, welds vertices with equal coordinates, diagnoses and orients. What was repaired is counted. Throws Error(io)
/// or Error(input), naming the file, the first offenders and what to do.
///
/// With `optimisation_sweeps` > 0 vertices off the feature edges then slide to better places (surface/optimisation.h):
/// that surface takes the place of the file's in all that follows. Throws Error(usage) if it would intersect itself.
Input read_input(const std::string& path, std::int32_t optimisation_sweeps = 0);

}  // namespace kerf
