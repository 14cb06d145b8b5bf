// The material of a tetrahedron, as solvers take it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/part/part.h"

namespace kerf {

/// The material of a tetrahedron is its region where the mesh has several, else its body (files/part/bodies.h).
/// Materials are numbered from 0; files count from 1.
class Materials {
 public:
    /// Takes the parts, which must outlive this. Bodies are found when they are first asked for, which may throw
    /// Error(io).
    explicit Materials(const PartSource& parts) : parts_(&parts) {}

    bool are_regions() const { return !names().empty(); }
    std::int32_t count() const;
    /// Returns the names of the regions; empty for bodies, which have none.
    const std::vector<std::string>& names() const { return parts_->outline().region_names; }
    /// Returns the number of tetrahedra of each material. Loads the cells of all parts where there are several regions.
    /// Throws Error(io).
    std::vector<std::int64_t> sizes() const;
    /// Returns the material of each tetrahedron of a part, which is loaded with PartContent::cells or all. O(#T).
    std::vector<std::int32_t> of_tets(PartIndex index, const Part& part) const;

 private:
    const PartSource* parts_;
};

}  // namespace kerf
