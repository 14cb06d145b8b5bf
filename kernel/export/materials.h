// What solvers take for the material of a tetrahedron.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "part/part.h"

namespace kerf {

/// Its region where the mesh has several, else its body (part/bodies.h). Numbered from 0; files count from 1.
class Materials {
 public:
    /// `parts` must outlive this. Bodies are found when they are first asked for: Error(io).
    explicit Materials(const PartSource& parts) : parts_(&parts) {}

    bool are_regions() const { return !names().empty(); }
    std::int32_t count() const;
    /// Those of the regions; empty for bodies, which have none.
    const std::vector<std::string>& names() const { return parts_->outline().region_names; }
    /// Tetrahedra of each. Loads the cells of all parts where there are several regions. Throws Error(io).
    std::vector<std::int64_t> sizes() const;
    /// The material of each tetrahedron of a part, with PartContent::cells or all. O(#T).
    std::vector<std::int32_t> of_tets(PartIndex index, const Part& part) const;

 private:
    const PartSource* parts_;
};

}  // namespace kerf
