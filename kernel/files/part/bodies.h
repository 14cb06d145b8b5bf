// The bodies of a mesh, which do not depend on how it is cut into parts.
#pragma once

#include <cstdint>
#include <vector>

#include "files/part/part.h"

namespace kerf {

/// Bodies are the pieces of the whole mesh that hang together through tetrahedra: a connected component of the input, a
/// solid of a CAD file. They are numbered from 0 in the order of their first facets in the input, and so are the same
/// for any number of parts and any cuts.
class Bodies {
 public:
    /// Reads the surfaces of all parts, and the cells of parts whose surface is in several pieces. Memory: the largest
    /// of these parts, and 16 bytes for each vertex that a part has on an interface. Throws Error(io).
    explicit Bodies(const PartSource& parts);

    std::int32_t count() const { return std::ssize(sizes_); }
    /// Returns the number of tetrahedra of each body.
    const std::vector<std::int64_t>& sizes() const { return sizes_; }
    /// Returns the number of triangles on each patch that bound a body: walls between two regions lie inside of one.
    const std::vector<std::int64_t>& boundary_sizes() const { return boundary_sizes_; }
    /// Returns the body of each tetrahedron of a part, which is loaded with PartContent::cells or all. O(#T).
    std::vector<std::int32_t> of_tets(PartIndex index, const Part& part) const;

 private:
    Array<PartIndex, std::vector<std::int32_t>> of_pieces_;  // the bodies of the pieces that hang together in the part
    std::vector<std::int64_t> sizes_, boundary_sizes_;
};

}  // namespace kerf
