// What is divided among the ranks by number alone.
#pragma once

#include "decompose/decomposition.h"
#include "parallel/shares.h"

namespace kerf {

/// The share of this rank in `count` things, as first_of_rank() has it.
inline LeafRange range_of_rank(std::int32_t count, const Communicator& ranks) {
    const auto begin = [&](int rank) { return static_cast<std::int32_t>(first_of_rank(count, rank, ranks)); };
    return {begin(ranks.rank()), begin(ranks.rank() + 1)};
}

}  // namespace kerf
