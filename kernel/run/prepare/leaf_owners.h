// The ranks that hold the leaves of a run.
#pragma once

#include <vector>

#include "base/core/ids.h"
#include "base/parallel/communicator.h"
#include "cut/decompose/decomposition.h"
#include "files/part/part_indices.h"

namespace kerf {

/// The leaves of all ranks, in the order of the tree, and the ranks that hold them. 16 bytes a leaf.
class LeafOwners {
 public:
    /// Collective. `own`: the leaves of this rank; those of all ranks follow each other in the tree.
    LeafOwners(Communicator& ranks, const std::vector<Leaf>& own);

    const std::vector<NodeId>& ids() const { return ids_; }
    PartIndex index_of(NodeId leaf) const { return index_.of(leaf); }
    int rank_of(PartIndex leaf) const { return rank_[leaf]; }
    int rank_of(NodeId leaf) const { return rank_of(index_of(leaf)); }

 private:
    std::vector<NodeId> ids_;
    PartIndices index_;
    Array<PartIndex, std::int32_t> rank_;
};

}  // namespace kerf
