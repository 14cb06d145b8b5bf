// The nodes of finite elements on the parts of a mesh, numbered over all ranks. In this folder nodes are always these.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/mpi/mpi_ranks.h"
#include "base/mpi/ownership.h"
#include "files/part/part.h"
#include "solve/space/inside/facet_element.h"
#include "solve/space/tet_element.h"

namespace kerf {

/// Returns the first part of each rank, then the number of parts: rank r has the whole parts from first_parts[r] to
/// before first_parts[r + 1] of the outline, about as many tetrahedra as each other rank. With more ranks than parts
/// some have none. O(K).
std::vector<PartIndex> first_parts_of_ranks(const MeshOutline& outline, int ranks);

/// The local nodes of the elements of a part on its rank.
struct PartFeNodes {
    std::vector<std::int32_t> of_vertex;                   ///< #V
    std::vector<std::int32_t> of_edge;                     ///< #E for order 2, in the order of EdgeTable
    std::vector<std::array<std::int32_t, 6>> of_tet_edge;  ///< #T for order 2, in the order of tet_edges
};

/// Finite elements on the parts of a rank. Rows of a system of equations, one for each node, are numbered part by part,
/// in the order of the tree: the same for any number of ranks. A node belongs to the first part that holds it; a part
/// numbers its own vertices in their order, then for order 2 its own edges, ascending. Local numbers: the rows of this
/// rank, then its ghosts, ascending by row.
class FeSpace {
 public:
    /// Numbers the nodes of `parts`, this rank's, which are those of `first_parts` in the outline. Collective. For
    /// order 2 the node of an edge is where the part has it (Part::edge_nodes), or in the middle of the edge. O(n log
    /// n) in the nodes on interfaces, and in the edges for order 2. Throws Error(usage), on all ranks alike, for more
    /// equations, three a row, than 32 bits number and for curved cells that are folded.
    FeSpace(MpiRanks& ranks, const MeshOutline& outline, const std::vector<PartIndex>& first_parts,
            std::vector<Part> parts, int order);

    MpiRanks& ranks() const { return *ranks_; }
    int order() const { return order_; }
    const std::vector<Part>& parts() const { return parts_; }
    std::size_t region_count() const { return region_count_; }  ///< of the mesh, at least 1
    /// The region in which the part `p` of this rank lies.
    std::size_t region_of(std::size_t p) const { return parts_[p].region_of(0).value(); }
    const std::vector<PartFeNodes>& nodes_of_parts() const { return nodes_; }
    const Ownership& ownership() const { return ownership_; }

    std::int64_t first_row() const { return first_row_; }
    std::int64_t total_rows() const { return total_rows_; }  ///< nodes of all ranks
    std::int32_t owned_count() const { return owned_; }
    std::int32_t node_count() const { return std::ssize(points_); }  ///< with ghosts
    const std::vector<Vec3>& points() const { return points_; }
    std::int64_t row_of(std::int32_t node) const {
        return node < owned_ ? first_row_ + node : ghost_rows_[node - owned_];
    }

    /// Returns the local nodes of a tetrahedron of the part `p` of this rank; -1 after the fourth for order 1.
    std::array<std::int32_t, most_element_nodes> nodes_of(std::size_t p, std::size_t tet) const;
    /// Returns the local nodes of a boundary triangle: corners, then for order 2 those on triangle_edges, else -1.
    std::array<std::int32_t, 6> nodes_of_facet(std::size_t p, std::size_t facet) const;
    TetElement element(std::size_t p, std::size_t tet) const;
    FacetElement facet_element(std::size_t p, std::size_t facet) const;

 private:
    void refuse_folded_cells() const;

    MpiRanks* ranks_;
    int order_;
    std::size_t region_count_;
    std::vector<Part> parts_;
    std::vector<PartFeNodes> nodes_;
    std::vector<Vec3> points_;
    std::vector<std::int64_t> ghost_rows_;
    std::int64_t first_row_ = 0, total_rows_ = 0;
    std::int32_t owned_ = 0;
    Ownership ownership_;
};

/// Calls visit(p, tet) for all tetrahedra of the rank, part after part.
template <class Visit>
void for_all_tets(const FeSpace& space, Visit visit) {
    for (std::size_t p = 0; p < space.parts().size(); ++p)
        for (std::size_t t = 0; t < space.parts()[p].mesh.tets.size(); ++t) visit(p, t);
}

}  // namespace kerf
