// Rules by which ranks share things out by numbers alone, without messages.
#pragma once

#include <cstdint>

#include "base/core/mixed_bits.h"
#include "base/parallel/communicator.h"

namespace kerf {

/// Returns the first of `count` things that belongs to a rank; for `rank` = ranks.size() it is the end. Ranges of ranks
/// follow each other and differ by one at most in size.
inline std::int64_t first_of_rank(std::int64_t count, int rank, const Communicator& ranks) {
    return count * rank / ranks.size();
}

/// Returns the rank in whose range a thing lies.
inline int rank_in_range(std::int64_t count, std::int64_t thing, const Communicator& ranks) {
    return (ranks.size() * (thing + 1) - 1) / count;
}

/// Returns the rank to which a thing with this number belongs, where numbers may be any and each rank is to have its
/// share.
inline int rank_of_number(std::uint64_t number, const Communicator& ranks) { return mixed_bits(number) % ranks.size(); }

}  // namespace kerf
