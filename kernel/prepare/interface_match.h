// Both sides of every interface, brought together over all ranks.
#pragma once

#include <span>
#include <vector>

#include "decompose/decomposition.h"
#include "parallel/communicator.h"
#include "part/shared_vertices.h"
#include "prepare/numbering.h"
#include "prepare/oriented_triangle.h"

namespace kerf {

/// One side of an interface facet.
struct InterfaceSide {
    Key facet;
    NamedTriangle vertices;  ///< rotated so that the smallest comes first
    NodeId leaf;

    template <class Archive>
    void archive(Archive& a) {
        a(facet, vertices, leaf);
    }
};

/// The interface facets of all leaves, sorted by facet key.
class InterfaceTable {
 public:
    /// Collective: gathers the sides that the leaves of this rank hold.
    InterfaceTable(Communicator& ranks, const std::vector<Leaf>& leaves);

    /// For each facet of the leaf the leaf on the other side, -1 for facets of the input.
    std::vector<NodeId> neighbours(const Leaf& leaf) const;
    /// The vertices of all interfaces. `leaves`: all of the run, in the order of the tree.
    SharedVertices shared_vertices(const VertexNumbering& numbering, const std::vector<NodeId>& leaves) const;
    /// Facets that do not appear exactly twice, on two leaves, with the same vertices in opposite order.
    std::int64_t unmatched() const;

 private:
    std::vector<InterfaceSide> sides_;
};

}  // namespace kerf
