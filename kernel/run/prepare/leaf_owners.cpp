#include "run/prepare/leaf_owners.h"

namespace kerf {

LeafOwners::LeafOwners(Communicator& ranks, const std::vector<Leaf>& own) {
    std::vector<NodeId> own_ids;
    for (const Leaf& leaf : own) own_ids.push_back(leaf.id);
    std::int32_t rank = 0;
    for (const std::vector<NodeId>& of_rank : all_gather(ranks, own_ids)) {
        ids_.insert(ids_.end(), of_rank.begin(), of_rank.end());
        rank_.resize(ids_.size(), rank++);
    }
    index_ = PartIndices(ids_);
}

}  // namespace kerf
