// Ownership of what several ranks have: one of them owns it, the others have copies of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/mpi/mpi_ranks.h"

namespace kerf {

/// The items that ranks share, as nodes of finite elements. An item belongs to one rank, its owner; ghosts are the
/// copies on other ranks. Items have local numbers on each rank; arrays over them have `block` values for each.
class Ownership {
 public:
    /// The items that this rank shares with a neighbouring one, in the same order on both sides.
    struct Neighbour {
        int rank = 0;
        std::vector<std::int32_t> items;  ///< local numbers
    };

    Ownership() = default;
    /// `owned`: items of this rank of which others have ghosts; `ghosts`: items of others of which this rank has
    /// ghosts. Both ascending by rank.
    Ownership(MpiRanks& ranks, std::vector<Neighbour> owned, std::vector<Neighbour> ghosts)
        : ranks_(&ranks), owned_(std::move(owned)), ghosts_(std::move(ghosts)) {}

    /// Returns the ownership of items that are numbered over all ranks: rank r owns the numbers from first_of_ranks[r]
    /// to before first_of_ranks[r + 1], and this one has ghosts of `ghosts`, ascending. Local numbers are those of the
    /// own items, then of the ghosts, in their order. Collective; messages follow the ghosts.
    static Ownership of_numbers(MpiRanks& ranks, const std::vector<std::int64_t>& first_of_ranks,
                                const std::vector<std::int64_t>& ghosts) {
        const int own = ranks.rank();
        const std::int64_t first = first_of_ranks[own];
        std::int32_t local = first_of_ranks[own + 1] - first;
        std::vector<std::vector<std::int64_t>> asked(ranks.size());
        std::vector<Neighbour> of_own, of_ghosts;
        for (const std::int64_t number : ghosts) {
            const auto after = std::upper_bound(first_of_ranks.begin(), first_of_ranks.end(), number);
            const int owner = after - first_of_ranks.begin() - 1;
            if (of_ghosts.empty() || of_ghosts.back().rank != owner) of_ghosts.push_back({owner, {}});
            of_ghosts.back().items.push_back(local++);
            asked[owner].push_back(number);
        }
        asked = exchange_items(ranks, std::move(asked));
        for (int r = 0; r < ranks.size(); ++r) {
            if (asked[r].empty()) continue;
            Neighbour& neighbour = of_own.emplace_back();
            neighbour.rank = r;
            for (const std::int64_t number : asked[r]) neighbour.items.push_back(number - first);
        }
        return {ranks, std::move(of_own), std::move(of_ghosts)};
    }

    const MpiRanks& ranks() const { return *ranks_; }
    const std::vector<Neighbour>& owned() const { return owned_; }
    const std::vector<Neighbour>& ghosts() const { return ghosts_; }

    /// Returns the ownership of some of the items: those with a new local number, not -1. Owners and ghosts of an item
    /// agree on whether it has one.
    Ownership renumbered(const std::vector<std::int32_t>& number) const {
        const auto some = [&](const std::vector<Neighbour>& all) {
            std::vector<Neighbour> kept;
            for (const Neighbour& neighbour : all) {
                Neighbour of_rank{neighbour.rank, {}};
                for (const std::int32_t item : neighbour.items)
                    if (number[item] >= 0) of_rank.items.push_back(number[item]);
                if (!of_rank.items.empty()) kept.push_back(std::move(of_rank));
            }
            return kept;
        };
        return {*ranks_, some(owned_), some(ghosts_)};
    }

    /// Sets the values of ghosts to those of their owners. Collective.
    template <class T>
    void from_owners(std::span<T> values, std::size_t block) const {
        transfer<T>(owned_, ghosts_, values, block, [](T& own, T other) { own = other; });
    }

    /// Adds the values of ghosts to those of their owners, rank after rank; the ghosts keep theirs. Collective.
    template <class T>
    void sum_to_owners(std::span<T> values, std::size_t block) const {
        transfer<T>(ghosts_, owned_, values, block, [](T& own, T other) { own += other; });
    }

    /// Sets the values of each item, on all ranks, to the smallest that any rank has for it. Collective.
    template <class T>
    void smallest_over_ranks(std::span<T> values, std::size_t block) const {
        transfer<T>(ghosts_, owned_, values, block, [](T& own, T other) { own = std::min(own, other); });
        from_owners(values, block);
    }

    /// Returns the lists, of any lengths, that owners have for this rank, one for each of ghosts(). The list for each
    /// of owned() is list_for(neighbour), a vector. Collective.
    template <class ListFor>
    auto lists_from_owners(const ListFor& list_for) const {
        return exchanged(owned_, ghosts_, list_for);
    }

    /// Returns the lists, of any lengths, that other ranks have for this one as an owner, one for each of owned(). The
    /// list for each of ghosts() is list_for(neighbour), a vector. Collective.
    template <class ListFor>
    auto lists_to_owners(const ListFor& list_for) const {
        return exchanged(ghosts_, owned_, list_for);
    }

 private:
    template <class T, class Take>
    void transfer(const std::vector<Neighbour>& from, const std::vector<Neighbour>& to, std::span<T> values,
                  std::size_t block, Take take) const {
        std::vector<RankValues<T>> out, in;
        for (const Neighbour& neighbour : to)
            in.push_back({neighbour.rank, std::vector<T>(neighbour.items.size() * block)});
        for (const Neighbour& neighbour : from) {
            std::vector<T> of_items;
            of_items.reserve(neighbour.items.size() * block);
            for (const std::int32_t item : neighbour.items) {
                const auto values_of_item = values.subspan(item * block, block);
                of_items.insert(of_items.end(), values_of_item.begin(), values_of_item.end());
            }
            out.push_back({neighbour.rank, std::move(of_items)});
        }
        ranks_->exchange(out, in);
        for (std::size_t n = 0; n < to.size(); ++n)
            for (std::size_t i = 0; i < to[n].items.size(); ++i)
                for (std::size_t c = 0; c < block; ++c)
                    take(values[to[n].items[i] * block + c], in[n].values[i * block + c]);
    }

    template <class ListFor>
    auto exchanged(const std::vector<Neighbour>& from, const std::vector<Neighbour>& to,
                   const ListFor& list_for) const {
        using List = std::invoke_result_t<const ListFor&, const Neighbour&>;
        std::vector<List> of_ranks(ranks_->size()), received;
        for (const Neighbour& neighbour : from) of_ranks[neighbour.rank] = list_for(neighbour);
        of_ranks = exchange_items(*ranks_, std::move(of_ranks));
        for (const Neighbour& neighbour : to) received.push_back(std::move(of_ranks[neighbour.rank]));
        return received;
    }

    MpiRanks* ranks_ = nullptr;
    std::vector<Neighbour> owned_, ghosts_;
};

}  // namespace kerf
