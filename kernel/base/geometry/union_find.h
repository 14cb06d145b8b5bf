// Connected components of items that are joined pair by pair.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/core/ids.h"

namespace kerf {

/// The component of each item, numbered by their smallest items, and the number of components.
struct Components {
    std::vector<std::int32_t> of;
    std::int32_t count = 0;
};

/// Items 0, 1, ... in disjoint sets, whose smallest item is the root. Nearly O(1) for each call.
class UnionFind {
 public:
    explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    std::int32_t root(std::int32_t item) {
        while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
        return item;
    }
    void join(std::int32_t a, std::int32_t b) {
        const auto [low, high] = std::minmax({root(a), root(b)});
        parent_[high] = low;
    }
    /// Returns the sets, in the memory of the object, which must not be used afterwards.
    Components take() {
        std::int32_t count = 0;
        for (std::int32_t i = 0; i < count_of(parent_); ++i)  // parents come first, so theirs are numbers already
            parent_[i] = parent_[i] == i ? count++ : parent_[parent_[i]];
        return {std::move(parent_), count};
    }

 private:
    std::vector<std::int32_t> parent_;  // not larger than the item; roots are their own
};

}  // namespace kerf
