// The space between a surface and a body inside of it, filled with tetrahedra.
#pragma once

#include <vector>

#include "fill/mesh/tet_mesh.h"
#include "fill/shell/facet_recovery_counts.h"
#include "fill/shell/inside/refinement.h"
#include "surface/complex/surface.h"

namespace kerf {

/// The part of the body that is filled already: its boundary, and points around it that belong to the shell.
struct ShellCore {
    std::vector<Vec3> points;
    std::vector<Triangle> faces;  ///< triangles over `points`, counter-clockwise seen from the shell
    std::vector<Vec3> free_points;
};

struct FilledShell {
    TetMesh mesh;  ///< mesh with neighbours; its vertices are those of the surface, of the core, and others; the first
                   ///< two are its boundary
    FacetRecoveryCounts recovery;
    std::int64_t refining_points = 0;
};

/// Fills the space between the surface, which must be well-formed and closed, and the core with Delaunay tetrahedra,
/// with points added for the bounds. Every facet of either is kept, and none is added. Throws Error(subdomain) where
/// facets are missing and cannot be recovered. Deterministic. 3 us a point, 10 us a point that is added.
FilledShell fill_shell(const SurfaceArrays& surface, ShellCore core, const RefinementBounds& bounds);

}  // namespace kerf
