// The share of each rank of a program in a finished run: whole parts, joined into one mesh. No rank has all of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace kerf {

/// The vertices and triangles between the parts of a rank and those of another one, in the same order on both.
struct RankNeighbour {
    std::int32_t rank = 0;
    std::vector<std::int64_t> vertices;  ///< vertices of both, rows of RankMesh::vertices; ascending by global number
    /// Faces between a tetrahedron of each, rows of RankMesh::vertices, seen from outside of the own one; ascending by
    /// the sorted global numbers of their corners.
    std::vector<std::array<std::int64_t, 3>> triangles;
    std::vector<std::int64_t> tet_behind;  ///< #triangles; a row of RankMesh::tets
};

struct RankMesh {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::int64_t> global_vertices;      ///< #vertices; rows of MeshArrays::vertices
    std::vector<std::int32_t> owner;                ///< #vertices; the first of the ranks that have it
    std::vector<std::array<std::int64_t, 4>> tets;  ///< corners as rows of `vertices`, turned as those of MeshArrays
    std::int64_t first_tet = 0;        ///< row of the first of `tets` in MeshArrays::tets, where the others follow
    std::vector<std::int32_t> part;    ///< #tets; as of MeshArrays
    std::vector<std::int32_t> region;  ///< #tets; likewise
    /// Triangles on patches, rows of `vertices`, seen from outside of the tetrahedron behind. Walls between regions are
    /// there once, and on both ranks where they lie between two.
    std::vector<std::array<std::int64_t, 3>> triangles;
    std::vector<std::int64_t> tet_behind;            ///< #triangles; a row of `tets`
    std::vector<std::int32_t> patch;                 ///< #triangles; an index into patch_names
    std::vector<std::array<std::int32_t, 2>> sides;  ///< #triangles; regions behind and in front, -1: outside
    std::vector<std::int32_t> triangle_owner;        ///< #triangles; the rank that counts it where both have it
    std::vector<RankNeighbour> neighbours;           ///< ascending by rank
    std::int64_t all_vertices = 0, all_tets = 0;     ///< numbers in the whole mesh
    std::vector<std::string> patch_names;
    std::vector<std::string> region_names;  ///< empty if there is one region
};

/// Returns the share of rank `rank` of `ranks` in a finished run: neighbours in the tree of cuts, each rank with about
/// as many parts; with more ranks than parts some have none. Throws Error(io). Not collective. Cost: reads the surfaces
/// of all parts and the cells of its own, of which one part is in memory beside the result.
RankMesh mesh_of_rank(const std::string& folder, int rank, int ranks);

}  // namespace kerf
