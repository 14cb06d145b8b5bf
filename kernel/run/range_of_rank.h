// What is divided among the ranks by number alone.
#pragma once

#include "decompose/decomposition.h"
#include "parallel/communicator.h"

namespace kerf {

/// The share of this rank in `count` things: ranges of all ranks follow each other and differ by one at most in size.
inline LeafRange range_of_rank(std::int32_t count, const Communicator& ranks) {
    const auto begin = [&](int rank) {
        return static_cast<std::int32_t>(static_cast<std::int64_t>(count) * rank / ranks.size());
    };
    return {begin(ranks.rank()), begin(ranks.rank() + 1)};
}

}  // namespace kerf
