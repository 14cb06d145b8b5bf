// The bodies of a mesh, which know nothing of parts.
#pragma once

#include <cstdint>
#include <vector>

#include "part/part.h"

namespace kerf {

/// What hangs together through tetrahedra, in all parts: a connected component of the input, a solid of a CAD file.
/// Numbered from 0 in the order of their first facets in the input, so that bodies are the same for any number of
/// parts and any cuts.
class Bodies {
 public:
    /// Reads the surfaces of all parts, and the cells of those whose surface is in several pieces. Memory: the largest
    /// of them, and 16 bytes for each vertex that a part has on an interface. Throws Error(io).
    explicit Bodies(const PartSource& parts);

    std::int32_t count() const { return std::ssize(sizes_); }
    /// Tetrahedra of each body.
    const std::vector<std::int64_t>& sizes() const { return sizes_; }
    /// Triangles of each patch that bound a body: a wall between two regions lies inside of one.
    const std::vector<std::int64_t>& boundary_sizes() const { return boundary_sizes_; }
    /// The body of each tetrahedron of a part, with PartContent::cells or all. O(#T).
    std::vector<std::int32_t> of_tets(PartIndex index, const Part& part) const;

 private:
    Array<PartIndex, std::vector<std::int32_t>> of_pieces_;  // the bodies of what hangs together in the part
    std::vector<std::int64_t> sizes_, boundary_sizes_;
};

}  // namespace kerf
