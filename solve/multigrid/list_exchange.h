// The exchange of lists between neighbouring ranks, which do not know their lengths.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/multigrid/ghost_exchange.h"

namespace kerf {

/// Returns the lists that `senders` have for this rank, in their order, while the lists of `out` go to others.
/// Collective among them.
inline std::vector<RankValues<double>> exchange_lists(const std::vector<RankValues<double>>& out,
                                                      const std::vector<GhostExchange::Neighbour>& senders,
                                                      const MpiRanks& ranks) {
    std::vector<RankValues<std::int64_t>> lengths, expected;
    for (const RankValues<double>& list : out) lengths.push_back({list.rank, {std::ssize(list.values)}});
    for (const GhostExchange::Neighbour& sender : senders) expected.push_back({sender.rank, {0}});
    ranks.exchange(lengths, expected);
    std::vector<RankValues<double>> in;
    for (const RankValues<std::int64_t>& length : expected)
        in.push_back({length.rank, std::vector<double>(length.values[0])});
    ranks.exchange(out, in);
    return in;
}

}  // namespace kerf
