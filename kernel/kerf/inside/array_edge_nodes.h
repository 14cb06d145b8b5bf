// The nodes on edges of a mesh of arrays.
#pragma once

#include <algorithm>

#include "files/part/part.h"
#include "kerf/kerf.h"

namespace kerf {

/// Gives a part, whose tetrahedra are these rows of the arrays in their order, the nodes on its edges; for order 1
/// there are none.
template <class Rows>
void take_edge_nodes(const MeshArrays& mesh, const Rows& rows, Part& part) {
    if (mesh.quadratic_tets.empty()) return;
    EdgeNodes& nodes = part.edge_nodes;
    nodes.edges = EdgeTable(part.mesh.tets, part.mesh.vertices.size());
    nodes.global_id.resize(nodes.edges.size());
    nodes.points.resize(nodes.edges.size());
    for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
        const auto& row = mesh.quadratic_tets[rows[t]];
        for (std::size_t e = 0; e < tet_edges.size(); ++e) {
            const auto& [i, j] = tet_edges[e];
            const std::int32_t edge = nodes.edges.find(undirected(part.mesh.tets[t][i], part.mesh.tets[t][j]));
            const auto& [x, y, z] = mesh.vertices[row[4 + e]];
            nodes.global_id[edge] = row[4 + e];
            nodes.points[edge] = Vec3(x, y, z);
        }
    }
}

/// Returns the number of vertices, without the nodes on edges.
inline std::int64_t vertex_count_of(const MeshArrays& mesh) { return std::ssize(mesh.vertices) - mesh.edge_nodes; }

}  // namespace kerf
