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

/// One side of a facet between two leaves.
struct InterfaceSide {
    Key facet;
    NamedTriangle vertices;  ///< rotated so that the smallest comes first
    NodeId leaf;

    template <class Archive>
    void archive(Archive& a) {
        a(facet, vertices, leaf);
    }
};

/// The facets of all leaves that have a leaf on either side, interfaces and walls of regions, sorted by facet key.
class InterfaceTable {
 public:
    /// Collective: gathers the sides that the leaves of this rank hold. `sides`: of the facets of the input, as
    /// Complex::all_sides(), and for as long as this lives.
    InterfaceTable(Communicator& ranks, const std::vector<Leaf>& leaves, std::span<const FacetSides> sides = {});

    /// For each facet of the leaf the leaf on the other side, -1 where there is none.
    std::vector<NodeId> neighbours(const Leaf& leaf) const;
    /// The vertices of all interfaces, and those of `contacts`, which all ranks have told. `leaves`: all of the run, in
    /// the order of the tree.
    SharedVertices shared_vertices(const VertexNumbering& numbering, const std::vector<NodeId>& leaves,
                                   std::vector<SharedVertices::Incidence> contacts = {}) const;
    /// Facets that do not appear exactly twice, on two leaves, with the same vertices in opposite order.
    std::int64_t unmatched() const;

 private:
    bool is_shared(Key facet) const;

    std::span<const FacetSides> facet_sides_;
    std::vector<InterfaceSide> sides_;
};

}  // namespace kerf
