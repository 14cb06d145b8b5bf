// The ranges of the numbers in a part file: a file may be complete and still name a vertex or part that is not there.
#pragma once

#include <string>

#include "files/part/part.h"

namespace kerf {

/// Throws Error(verification), naming the file and the number, unless points are finite, every triangle is on a patch
/// with a name or on an interface, neighbours are leaves or none, and no global number is below zero. O(size).
void require_ranges(const Part& part, const std::string& path);

/// Throws Error(verification) unless the names that the part has are those of the outline. O(names of the part).
void require_names(const Part& part, const MeshOutline& outline, const std::string& path);

/// The place of a part of a run in the whole.
struct PartStanding {
    const MeshOutline& outline;
    PartIndex index;
    std::int64_t boundary_vertices = 0;  ///< distinct boundary vertices of all parts, which are numbered first
    std::int64_t first_interior_id = 0;  ///< first number of an interior vertex of this part
};

/// Throws as require_ranges(), and unless it is this part of the whole, with as many vertices and tetrahedra as the
/// outline says of the loaded `content`, neighbours are other parts, names are those of the outline, no two vertices
/// have one number, and vertices of the boundary and of the inside have numbers from their ranges. O(n log n) in the
/// boundary.
void require_ranges(const Part& part, PartContent content, const PartStanding& standing, const std::string& path);

/// Throws Error(verification) unless the nodes on edges have numbers behind those of all vertices, each once. The check
/// of a part in its place includes this one.
void require_edge_numbers(const Part& part, const MeshOutline& outline, const std::string& path);

}  // namespace kerf
