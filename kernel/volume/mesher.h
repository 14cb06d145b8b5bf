// From a closed surface to the tetrahedra inside.
#pragma once

#include <string>

#include "mesh/tet_mesh.h"
#include "size/size_field.h"
#include "surface/surface.h"

namespace kerf {

enum class MesherKind { tetgen };

struct MesherOptions {
    MesherKind kind = MesherKind::tetgen;
    SizeField size = {};       ///< of tetrahedra. TetGen leaves a few larger ones: next to coarse facets, and where it
                               ///< improved the shape afterwards
    double radius_edge = 1.4;  ///< upper bound of circumradius over shortest edge; > 1, 0: no refinement
    double tolerance = 0;      ///< relative, for points that count as coplanar; 0: the mesher's own
    std::string tetgen_switches;  ///< expert: replaces the bounds above; a volume in it is in units of the input cubed

    template <class Archive>
    void archive(Archive& a) {
        a(kind, size, radius_edge, tolerance, tetgen_switches);
    }
};

/// Throws Error(usage), naming the option, for values out of range and switches that cannot be used.
void check_mesher_options(const MesherOptions& options);

/// Fills the closed surface, which must be well-formed, with tetrahedra; every facet of it is kept and none is added.
///
/// The result's boundary vertices are those of the surface, bit for bit and in its order. `vertex_order_seed` 0 hands
/// the vertices over as they are, any other value in a fixed shuffle: the usual cure when TetGen fails. Throws
/// Error(subdomain) with TetGen's reason, Error(memory) if that is memory, Error(usage) for options out of range.
/// TetGen may also abort, hang or exhaust memory, so call it in a process of its own, and it is not thread-safe.
/// Deterministic.
TetMesh mesh_volume(const SurfaceArrays& surface, const MesherOptions& options, std::uint32_t vertex_order_seed = 0);

/// One point inside every void shell (a shell that encloses negative volume) of a closed surface.
/// Each point is proven to lie in its void by ray parity. Throws Error(subdomain) where none is found.
std::vector<Vec3> hole_points(const SurfaceArrays& surface);

}  // namespace kerf
