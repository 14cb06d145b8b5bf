// Side 2 f is the one behind facet f, side 2 f + 1 the one in front of it; a side is wanted if it has a region. Facets
// belong to ranks by ranges of their numbers. In a good run no list of facets is sent: each rank sums random words, a
// function of the side's number, over the sides that its leaves have and over the wanted sides that it owns. If both
// sums agree over all ranks, each wanted side is there exactly once, but for a chance of 2^-128. Only if they differ,
// the owners of facets are told the sides of all leaves, and count. Facets that straight cuts have divided are compared
// as geometry: their pieces go to the owner, which checks that they cover the facet exactly once
// (surface/diagnosis/facet_cover.h).
#include "run/prepare/input_cover.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/core/check.h"
#include "base/core/mixed_bits.h"
#include "base/core/threads.h"
#include "base/parallel/shares.h"
#include "surface/diagnosis/facet_cover.h"

namespace kerf {

namespace {

using FacetCorners = std::array<Vec3, 3>;

struct Piece {
    std::int64_t side;
    FacetCorners corners;

    template <class Archive>
    void archive(Archive& a) {
        a(side, corners[0], corners[1], corners[2]);
    }
};

// The two sides of each facet as numbers: that behind facet f is 2 f, that in front of it 2 f + 1.
class SidesOfFacets {
 public:
    /// `divided`: ascending by facet.
    SidesOfFacets(std::int64_t facets, std::span<const FacetSides> sides, const std::vector<DividedFacet>& divided)
        : facets_(facets), sides_(sides), divided_(divided) {
        KERF_CHECK(sides.empty() || std::ssize(sides) == facets);
        KERF_CHECK(std::is_sorted(divided.begin(), divided.end(),
                                  [](const DividedFacet& a, const DividedFacet& b) { return a.facet < b.facet; }));
    }

    bool has_region(std::int64_t side) const {
        const FacetSides& facet = sides_.empty() ? FacetSides{} : sides_[side / 2];
        return (side % 2 == 0 ? facet.back : facet.front).is_valid();
    }
    // Returns the side of a facet of a leaf in this region; the region may be another than that of the side.
    std::int64_t side_of(std::int32_t facet, RegionIndex region) const {
        const bool is_in_front = !sides_.empty() && sides_[facet].back != region;
        return 2 * std::int64_t{facet} + (is_in_front ? 1 : 0);
    }
    bool is_of(std::int32_t facet, RegionIndex region) const {
        if (sides_.empty()) return true;
        const auto [front, back] = sides_[facet];
        return front == region || back == region;
    }
    bool is_divided(std::int64_t facet) const {
        const auto found = std::partition_point(divided_.begin(), divided_.end(),
                                                [&](const DividedFacet& d) { return d.facet < facet; });
        return found != divided_.end() && found->facet == facet;
    }
    // Facets belong to ranks by ranges of their numbers.
    std::int64_t first_of(int rank, const Communicator& ranks) const { return first_of_rank(facets_, rank, ranks); }
    int owner_of(std::int64_t side, const Communicator& ranks) const { return rank_in_range(facets_, side / 2, ranks); }

 private:
    std::int64_t facets_;
    std::span<const FacetSides> sides_;
    const std::vector<DividedFacet>& divided_;
};

// Calls visit(facet, place) for all facets of a leaf that are facets of the input, or pieces of one.
template <class Visit>
void for_each_input_facet(const Leaf& leaf, Visit visit) {
    for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f)
        if (const Key key = leaf.surface.facet_key[f]; is_of_input(key)) visit(key_index(key), f);
}

// Calls visit(side) for all facets of the leaves that are undivided facets of the input, in the region of the leaf.
template <class Visit>
void for_each_undivided(const SidesOfFacets& sides, const std::vector<Leaf>& leaves, Visit visit) {
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t) {
            if (sides.is_of(facet, leaf.region) && !sides.is_divided(facet)) visit(sides.side_of(facet, leaf.region));
        });
}

// Pieces in the leaves of all ranks of the facets that belong to this one, by side.
std::vector<Piece> exchange_pieces(Communicator& ranks, const SidesOfFacets& sides, const std::vector<Leaf>& leaves) {
    std::vector<std::vector<Piece>> to_owner(ranks.size());
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t f) {
            if (!sides.is_divided(facet)) return;
            const Triangle& t = leaf.surface.facets[f];
            const std::vector<Vec3>& p = leaf.surface.vertices;
            const std::int64_t side = sides.side_of(facet, leaf.region);
            to_owner[sides.owner_of(side, ranks)].push_back({side, {p[t[0]], p[t[1]], p[t[2]]}});
        });
    std::vector<Piece> own;
    for (const std::vector<Piece>& of_rank : exchange_items(ranks, std::move(to_owner)))
        own.insert(own.end(), of_rank.begin(), of_rank.end());
    std::stable_sort(own.begin(), own.end(), [](const Piece& a, const Piece& b) { return a.side < b.side; });
    return own;
}

// `pieces`: of the facets that belong to this rank.
std::int64_t count_uncovered(const Communicator& ranks, const std::vector<DividedFacet>& facets,
                             const SidesOfFacets& sides, const std::vector<Piece>& pieces) {
    std::int64_t uncovered = 0;
    std::size_t next = 0;
    for (const DividedFacet& facet : facets) {
        const std::int64_t seen = sides.side_of(facet.facet, facet.region);
        if (sides.owner_of(seen, ranks) != ranks.rank()) continue;
        std::array<std::vector<FacetCorners>, 2> corners;
        for (; next < pieces.size() && pieces[next].side / 2 == facet.facet; ++next)
            corners[pieces[next].side % 2].push_back(pieces[next].corners);
        const auto& [a, b, c] = facet.corners;
        for (const std::int64_t side : {seen, seen ^ 1}) {
            const std::vector<FacetCorners>& there = corners[side % 2];
            const FacetCorners wanted = side == seen ? facet.corners : FacetCorners{a, c, b};
            uncovered += sides.has_region(side) ? !covers(wanted, there) : !there.empty();
        }
    }
    return uncovered;
}

// Two sums of random words, one for each number, without regard to order: equal for the same numbers, each as often,
// and otherwise by a chance of 2^-128.
struct SumOfNumbers {
    std::array<std::uint64_t, 2> words{};

    void add(std::int64_t number) {
        for (std::size_t i = 0; i < words.size(); ++i) words[i] += random_bits(2 * number + i);
    }
};

// Returns the sum over the wanted sides of facets that belong to this rank.
SumOfNumbers sum_of_wanted(const Communicator& ranks, const SidesOfFacets& sides) {
    const std::int64_t first = sides.first_of(ranks.rank(), ranks);
    const std::int64_t count = sides.first_of(ranks.rank() + 1, ranks) - first;
    SumOfNumbers wanted;
    for (const SumOfNumbers& part : values_of_ranges(count, 1 << 16, [&](const IndexRange& range) {
             SumOfNumbers sum;
             for (std::int64_t facet = first + range.first, last = first + range.last; facet < last; ++facet)
                 for (const std::int64_t side : {2 * facet, 2 * facet + 1})
                     if (sides.has_region(side) && !sides.is_divided(facet)) sum.add(side);
             return sum;
         }))
        for (std::size_t i = 0; i < wanted.words.size(); ++i) wanted.words[i] += part.words[i];
    return wanted;
}

struct QuickCount {
    bool has_each_once;             // the leaves of all ranks have every side that is not divided
    std::int64_t in_wrong_regions;  // facets in leaves of regions that they do not bound
};

// The difference of both sums, 24 bytes of each rank, tells whether all is there.
QuickCount count_quickly(Communicator& ranks, const SidesOfFacets& sides, const std::vector<Leaf>& leaves) {
    const SumOfNumbers wanted = sum_of_wanted(ranks, sides);
    SumOfNumbers there;
    for_each_undivided(sides, leaves, [&](std::int64_t side) { there.add(side); });
    std::uint64_t wrong = 0;
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t) { wrong += !sides.is_of(facet, leaf.region); });
    std::array<std::uint64_t, 3> sums = {there.words[0] - wanted.words[0], there.words[1] - wanted.words[1], wrong};
    ranks.sum(sums);
    return {sums[0] == 0 && sums[1] == 0, static_cast<std::int64_t>(sums[2])};
}

// Sides, of the facets that belong to this rank, that are not there as often as they should be, by eight bytes for each
// facet of a leaf; facets in wrong regions are not there.
std::int64_t count_not_there_once(Communicator& ranks, const SidesOfFacets& sides, const std::vector<Leaf>& leaves) {
    std::vector<std::vector<std::int64_t>> to_owner(ranks.size());
    for_each_undivided(sides, leaves,
                       [&](std::int64_t side) { to_owner[sides.owner_of(side, ranks)].push_back(side); });
    const std::int64_t first = 2 * sides.first_of(ranks.rank(), ranks);
    std::vector<std::int32_t> there(2 * sides.first_of(ranks.rank() + 1, ranks) - first, 0);
    for (const std::vector<std::int64_t>& of_rank : exchange_items(ranks, std::move(to_owner)))
        for (const std::int64_t side : of_rank) ++there[side - first];
    std::int64_t missing = 0;
    for (std::size_t i = 0; i < there.size(); ++i) {
        const std::int64_t side = first + i;
        missing += !sides.is_divided(side / 2) && there[i] != (sides.has_region(side) ? 1 : 0);
    }
    return missing;
}

}  // namespace

std::int64_t count_missing_input_facets(Communicator& ranks, std::int64_t facets, const Decomposition& own,
                                        std::span<const FacetSides> sides_of_facets) {
    const SidesOfFacets sides(facets, sides_of_facets, own.divided_facets);
    const QuickCount quick = count_quickly(ranks, sides, own.leaves);
    std::int64_t missing = count_uncovered(ranks, own.divided_facets, sides, exchange_pieces(ranks, sides, own.leaves));
    if (!quick.has_each_once) missing += count_not_there_once(ranks, sides, own.leaves);
    return quick.in_wrong_regions + sum_of(ranks, missing);
}

}  // namespace kerf
