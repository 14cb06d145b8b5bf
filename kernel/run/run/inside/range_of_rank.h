// The division of things among the ranks by number alone.
#pragma once

#include "base/parallel/shares.h"
#include "cut/decompose/decomposition.h"

namespace kerf {

/// Returns the share of a rank in `count` things, as first_of_rank() divides them.
inline LeafRange range_of_rank(std::int32_t count, int rank, const Communicator& ranks) {
    const auto begin = [&](int r) -> std::int32_t { return first_of_rank(count, r, ranks); };
    return {begin(rank), begin(rank + 1)};
}
inline LeafRange range_of_rank(std::int32_t count, const Communicator& ranks) {
    return range_of_rank(count, ranks.rank(), ranks);
}

}  // namespace kerf
