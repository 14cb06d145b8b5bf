// The orientation of a tetrahedron of a file.
#pragma once

#include <algorithm>
#include <vector>

#include "base/core/types.h"
#include "base/geometry/predicates.h"

namespace kerf {

/// Returns the sign of det[b-a, c-a, d-a], exactly; 0, too, where a corner is not finite, since files are not checked
/// before they are read.
inline int tet_sign(const std::vector<Vec3>& vertices, const Tetrahedron& tet) {
    const auto is_finite = [&](std::int32_t v) { return vertices[v].allFinite(); };
    if (!std::all_of(tet.begin(), tet.end(), is_finite)) return 0;
    return orientation(vertices[tet[0]], vertices[tet[1]], vertices[tet[2]], vertices[tet[3]]);
}

}  // namespace kerf
