// The two sides of every interface, brought together over all ranks.
#pragma once

#include <span>
#include <vector>

#include "base/core/ids.h"
#include "base/parallel/communicator.h"
#include "cut/decompose/decomposition.h"
#include "run/prepare/oriented_triangle.h"

namespace kerf {

/// Whether the facet of a leaf has another leaf on its other side: it is one of an interface, or a wall of regions.
/// `sides`: of the facets of the input, as Complex::all_sides().
inline bool is_between_leaves(Key facet, std::span<const FacetSides> sides) {
    return is_of_cut(facet) || (!sides.empty() && sides[key_index(facet)].is_wall());
}

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

/// The leaves on the other sides of facets between leaves. Both sides of a facet are told to one rank, which its key
/// chooses, and that rank tells the ranks of the leaves their neighbours: memory and messages of a rank follow the
/// interfaces of its own leaves. O(n log n) for n facets of them.
class InterfaceMatch {
 public:
    /// Collective. `leaves`: of this rank. `sides`: see is_between_leaves().
    InterfaceMatch(Communicator& ranks, const std::vector<Leaf>& leaves, std::span<const FacetSides> sides = {});

    /// Returns, for the leaf with this place on this rank, the leaf on the other side of each of its facets, none()
    /// where there is none.
    const std::vector<NodeId>& neighbours(std::size_t leaf) const { return neighbours_[leaf]; }
    /// Returns the number of facets of all ranks that do not appear exactly twice, on two leaves, with the same
    /// vertices in opposite order.
    std::int64_t unmatched() const { return unmatched_; }

 private:
    std::vector<std::vector<NodeId>> neighbours_;
    std::int64_t unmatched_ = 0;
};

}  // namespace kerf
