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
    std::vector<std::string> patch_names;
    Surface surface;
};

/// Reads, welds vertices with equal coordinates, diagnoses and orients. What was repaired is counted. Throws Error(io)
/// or Error(input), naming the file, the first offenders and what to do.
Input read_input(const std::string& path);

}  // namespace kerf
