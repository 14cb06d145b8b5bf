// The laws that the mesh of one subdomain must obey.
#pragma once

#include <array>

#include "fill/mesh/tet_mesh.h"
#include "surface/complex/surface.h"

namespace kerf {

/// Counts of broken laws; all zero for a correct mesh. Together with positive orientation and the volume they prove
/// that the tetrahedra fill the subdomain exactly once: they map the inside onto itself with degree one.
struct MeshLaws {
    std::int64_t inverted_tets = 0;          ///< tetrahedra whose exact orientation is not positive
    std::int64_t missing_facets = 0;         ///< facets of the surface that are no boundary face
    std::int64_t extra_boundary_faces = 0;   ///< boundary faces that are no facet of the surface
    std::int64_t mismatched_neighbours = 0;  ///< sides of faces not named back over the same corners, turned round
    std::int64_t moved_vertices = 0;         ///< boundary vertices whose coordinates are not those of the surface
    double volume = 0;                       ///< sum of the volumes of the tetrahedra
    double surface_volume = 0;               ///< volume enclosed by the surface
    double volume_error = 0;                 ///< bound of the rounding in the difference of these volumes
    /// Tetrahedra whose orientation is positive, and whose volume as doubles have it is not, in some order of their
    /// corners. As fillings they break no law, but a mesh that somebody computes with must have none.
    std::int64_t tets_without_volume = 0;

    /// Returns whether every count of mesh_laws is zero and the volumes differ by no more than rounding can make of two
    /// that are the same.
    bool hold() const;
    template <class Archive>
    void archive(Archive& a);
};

/// One law of a mesh: a count that must be zero.
struct MeshLaw {
    std::int64_t MeshLaws::*count;
    const char* broken;  ///< words for people, behind the count
};
/// The laws that are counts. A new one is a count of MeshLaws and a row here; verify_mesh() counts.
inline constexpr std::array mesh_laws =
    std::to_array<MeshLaw>({{&MeshLaws::inverted_tets, "inverted tetrahedra"},
                            {&MeshLaws::missing_facets, "facets of the surface missing"},
                            {&MeshLaws::extra_boundary_faces, "boundary faces that are no facets"},
                            {&MeshLaws::mismatched_neighbours, "faces with mismatched neighbours"},
                            {&MeshLaws::moved_vertices, "moved surface vertices"}});

template <class Archive>
void MeshLaws::archive(Archive& a) {
    for (const MeshLaw& law : mesh_laws) a(this->*law.count);
    a(volume, surface_volume, volume_error, tets_without_volume);
}

/// The proof by which the faces of a mesh without neighbours are told to be those of the surface.
enum class FaceProof {
    sum,       ///< wrong with a probability of 3e-18 (fill/mesh/inside/boundary_chain.h); 20 ns a cell and no memory
    matching,  ///< never wrong; 100 ns a cell, and as much memory as the cells
};

/// Checks the laws of a mesh against the surface of its subdomain, face by face. Requires vertex indices in range, in
/// the mesh and in the surface, and neighbours (#T), which may be anything, or none. Exact but for the volumes, and for
/// the faces as `proof` says; where something is broken, and where there are neighbours, faces are matched in any case,
/// and counted. O(#T + #F).
///
/// The bound of rounding is that of the surface (bounded_volume()), and for each cell 48 e times the product of the
/// largest components of its three edges, e = 2^-53, for the determinant, and (n e)^2 of the same for the compensated
/// sum of n.
MeshLaws verify_mesh(const TetMesh& mesh, const SurfaceArrays& surface, FaceProof proof = FaceProof::matching);

/// Returns for each triangle of the boundary, seen from outside, the tetrahedron behind it, -1 if there is none.
/// Corners of the triangles must be vertices of the boundary. Does not ask for neighbours and coordinates. O(#T + #F).
std::vector<std::int32_t> tets_at_facets(const TetMesh& mesh, const std::vector<Triangle>& facets);

}  // namespace kerf
