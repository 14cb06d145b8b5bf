// The laws that the mesh of one subdomain must obey.
#pragma once

#include "mesh/tet_mesh.h"
#include "surface/surface.h"

namespace kerf {

/// Counts of broken laws; all zero for a correct mesh. Together with positive orientation and the volume they prove
/// that the tetrahedra fill the subdomain exactly once: they map the inside onto itself with degree one.
struct MeshLaws {
    std::int64_t inverted_tets = 0;          ///< exact orientation not positive
    std::int64_t missing_facets = 0;         ///< facets of the surface that are no boundary face
    std::int64_t extra_boundary_faces = 0;   ///< boundary faces that are no facet of the surface
    std::int64_t mismatched_neighbours = 0;  ///< sides of faces not named back over the same corners, turned round
    std::int64_t moved_vertices = 0;         ///< boundary vertices whose coordinates are not those of the surface
    double volume = 0;                       ///< sum over the tetrahedra
    double surface_volume = 0;               ///< enclosed by the surface

    /// True if every count is zero and the volumes agree to 1e-10 relative.
    bool hold() const;
    template <class Archive>
    void archive(Archive& a) {
        a(inverted_tets, missing_facets, extra_boundary_faces, mismatched_neighbours, moved_vertices, volume,
          surface_volume);
    }
};

/// How the faces of a mesh without neighbours are told to be those of the surface.
enum class FaceProof {
    sum,       ///< wrong with a probability of 3e-18 (mesh/boundary_chain.h); 20 ns a cell and no memory
    matching,  ///< never wrong; 100 ns a cell, and as much memory as the cells
};

/// Compares facet by facet and face by face. Requires vertex indices in range, in the mesh and in the surface, and
/// neighbours (#T), which may be anything, or none. Exact but for the volumes, and for the faces as `proof` says; where
/// something is broken, and where there are neighbours, faces are matched in any case, and counted. O(#T + #F).
MeshLaws verify_mesh(const TetMesh& mesh, const SurfaceArrays& surface, FaceProof proof = FaceProof::matching);

/// For each triangle of the boundary, seen from outside, the tetrahedron behind it, -1 if there is none. Corners of
/// the triangles must be vertices of the boundary. Does not ask for neighbours and coordinates. O(#T + #F).
std::vector<std::int32_t> tets_at_facets(const TetMesh& mesh, const std::vector<Triangle>& facets);

}  // namespace kerf
