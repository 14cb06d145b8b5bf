// Values at the nodes of finite elements that several ranks hold.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/mpi/mpi_ranks.h"

namespace kerf {

/// The nodes that ranks share. A node belongs to one rank, its owner; ghosts are the copies on other ranks.
class GhostExchange {
 public:
    /// The nodes that this rank shares with a neighbouring one, in the same order on both sides.
    struct Neighbour {
        int rank = 0;
        std::vector<std::int32_t> nodes;  ///< local numbers
    };

    GhostExchange() = default;
    /// `owned`: nodes of this rank of which others have ghosts; `ghosts`: nodes of others of which this rank has
    /// ghosts. Both ascending by rank.
    GhostExchange(const MpiRanks& ranks, std::vector<Neighbour> owned, std::vector<Neighbour> ghosts)
        : ranks_(&ranks), owned_(std::move(owned)), ghosts_(std::move(ghosts)) {}

    const MpiRanks& ranks() const { return *ranks_; }
    const std::vector<Neighbour>& owned() const { return owned_; }
    const std::vector<Neighbour>& ghosts() const { return ghosts_; }

    /// Returns the exchange between some of the nodes: those with a new local number, not -1. Owners and ghosts of a
    /// node agree on whether it has one.
    GhostExchange renumbered(const std::vector<std::int32_t>& number) const {
        const auto some = [&](const std::vector<Neighbour>& all) {
            std::vector<Neighbour> kept;
            for (const Neighbour& neighbour : all) {
                Neighbour of_rank{neighbour.rank, {}};
                for (const std::int32_t node : neighbour.nodes)
                    if (number[node] >= 0) of_rank.nodes.push_back(number[node]);
                if (!of_rank.nodes.empty()) kept.push_back(std::move(of_rank));
            }
            return kept;
        };
        return {*ranks_, some(owned_), some(ghosts_)};
    }

    /// Sets the values of ghosts to those of their owners. Collective. `values`: `block` of them for each local node.
    template <class T>
    void to_ghosts(std::span<T> values, std::size_t block) const {
        transfer<T>(owned_, ghosts_, values, block, [](T& own, T other) { own = other; });
    }

    /// Adds the values of ghosts to those of their owners, rank after rank; the ghosts keep theirs. Collective.
    template <class T>
    void add_to_owners(std::span<T> values, std::size_t block) const {
        transfer<T>(ghosts_, owned_, values, block, [](T& own, T other) { own += other; });
    }

    /// Sets the values of each node, on all ranks, to the smallest that any rank has for it. Collective.
    template <class T>
    void share_smallest(std::span<T> values, std::size_t block) const {
        transfer<T>(ghosts_, owned_, values, block, [](T& own, T other) { own = std::min(own, other); });
        to_ghosts(values, block);
    }

 private:
    template <class T, class Take>
    void transfer(const std::vector<Neighbour>& from, const std::vector<Neighbour>& to, std::span<T> values,
                  std::size_t block, Take take) const {
        std::vector<RankValues<T>> out, in;
        for (const Neighbour& neighbour : to)
            in.push_back({neighbour.rank, std::vector<T>(neighbour.nodes.size() * block)});
        for (const Neighbour& neighbour : from) {
            std::vector<T> of_nodes;
            of_nodes.reserve(neighbour.nodes.size() * block);
            for (const std::int32_t node : neighbour.nodes) {
                const auto values_of_node = values.subspan(node * block, block);
                of_nodes.insert(of_nodes.end(), values_of_node.begin(), values_of_node.end());
            }
            out.push_back({neighbour.rank, std::move(of_nodes)});
        }
        ranks_->exchange(out, in);
        for (std::size_t n = 0; n < to.size(); ++n)
            for (std::size_t i = 0; i < to[n].nodes.size(); ++i)
                for (std::size_t c = 0; c < block; ++c)
                    take(values[to[n].nodes[i] * block + c], in[n].values[i * block + c]);
    }

    const MpiRanks* ranks_ = nullptr;
    std::vector<Neighbour> owned_, ghosts_;
};

}  // namespace kerf
