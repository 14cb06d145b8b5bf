// What the numbers of a part file may be: a file may be whole and still name what is not there.
#pragma once

#include <string>

#include "part/part.h"

namespace kerf {

/// Throws Error(verification), naming the file and the number, unless points are finite, every triangle on a patch of
/// the user's has one with a name, neighbours are leaves or none, and global numbers are none below zero. O(size).
void require_ranges(const Part& part, const std::string& path);

/// Throws Error(verification) unless the names that the part has are those of the outline. O(names of the part).
void require_names(const Part& part, const MeshOutline& outline, const std::string& path);

/// Where a part of a run stands in the whole.
struct PartStanding {
    const MeshOutline& outline;
    PartIndex index;
    std::int64_t boundary_vertices = 0;  ///< distinct ones of all parts: their numbers come first
    std::int64_t first_interior_id = 0;  ///< of this part
};

/// The same, and that it is this part of the whole, with as many vertices and tetrahedra as the outline has of what was
/// loaded (`content`), that neighbours are other parts, that names are those of the outline, that no two vertices have
/// one number, and that vertices of the boundary and of the inside have those that are for them. O(n log n) in the
/// boundary.
void require_ranges(const Part& part, PartContent content, const PartStanding& standing, const std::string& path);

/// Of order 2, a part of that: the nodes on its edges have numbers behind those of all vertices, each once.
void require_edge_numbers(const Part& part, const MeshOutline& outline, const std::string& path);

}  // namespace kerf
