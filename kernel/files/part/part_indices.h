// Finds the places of parts in the order of the tree by their numbers.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/core/check.h"
#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

class PartIndices {
 public:
    PartIndices() = default;
    /// Takes the numbers of the parts, in the order of the tree. O(n log n).
    explicit PartIndices(const std::vector<NodeId>& ids) {
        for (const NodeId id : ids) places_.push_back({id, PartIndex(places_.size())});
        std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.id < b.id; });
    }

    /// Returns the place of one of these parts. O(log n).
    PartIndex of(NodeId id) const {
        const auto found = std::lower_bound(places_.begin(), places_.end(), id,
                                            [](const Place& place, NodeId wanted) { return place.id < wanted; });
        KERF_CHECK(found != places_.end() && found->id == id);
        return found->index;
    }

 private:
    struct Place {
        NodeId id;
        PartIndex index;
    };
    std::vector<Place> places_;  // ascending by id
};

}  // namespace kerf
