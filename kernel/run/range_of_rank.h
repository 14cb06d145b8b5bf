// What is divided among the ranks by number alone.
#pragma once

#include "decompose/decomposition.h"
#include "parallel/shares.h"

namespace kerf {

/// The share of a rank in `count` things, as first_of_rank() has it.
inline LeafRange range_of_rank(std::int32_t count, int rank, const Communicator& ranks) {
    const auto begin = [&](int r) { return static_cast<std::int32_t>(first_of_rank(count, r, ranks)); };
    return {begin(rank), begin(rank + 1)};
}
inline LeafRange range_of_rank(std::int32_t count, const Communicator& ranks) {
    return range_of_rank(count, ranks.rank(), ranks);
}

}  // namespace kerf
