#include "prepare/input_cover.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/check.h"
#include "core/mixed_bits.h"
#include "surface/facet_cover.h"

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
    explicit SidesOfFacets(std::span<const FacetSides> sides) : sides_(sides) {}

    bool has_region(std::int64_t side) const {
        const FacetSides& facet = sides_.empty() ? FacetSides{} : sides_[static_cast<std::size_t>(side / 2)];
        return (side % 2 == 0 ? facet.back : facet.front) >= 0;
    }
    // Of a facet of a leaf in this region; the region may be another than that of the side.
    std::int64_t side_of(std::int32_t facet, RegionIndex region) const {
        const bool is_in_front = !sides_.empty() && sides_[static_cast<std::size_t>(facet)].back != region.value();
        return 2 * std::int64_t{facet} + (is_in_front ? 1 : 0);
    }
    bool is_of(std::int32_t facet, RegionIndex region) const {
        if (sides_.empty()) return true;
        const auto [front, back] = sides_[static_cast<std::size_t>(facet)];
        return front == region.value() || back == region.value();
    }

 private:
    std::span<const FacetSides> sides_;
};

// Calls visit(facet, place) for all facets of a leaf that are facets of the input, or pieces of one.
template <class Visit>
void for_each_input_facet(const Leaf& leaf, Visit visit) {
    for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f)
        if (const Key key = leaf.surface.facet_key[f]; is_of_input(key)) visit(key_index(key), f);
}

// Pieces of all leaves, by side.
std::vector<Piece> gather_pieces(Communicator& ranks, const std::vector<char>& divided, const SidesOfFacets& sides,
                                 const std::vector<Leaf>& leaves) {
    std::vector<Piece> own;
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t f) {
            if (!divided[facet]) return;
            const Triangle& t = leaf.surface.facets[f];
            const std::vector<Vec3>& p = leaf.surface.vertices;
            own.push_back({sides.side_of(facet, leaf.region), {p[t[0]], p[t[1]], p[t[2]]}});
        });
    std::vector<Piece> all = gather_items(ranks, own);
    std::stable_sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.side < b.side; });
    return all;
}

std::int64_t count_uncovered(const std::vector<DividedFacet>& facets, const SidesOfFacets& sides,
                             const std::vector<Piece>& pieces) {
    std::int64_t uncovered = 0;
    std::size_t next = 0;
    for (const DividedFacet& facet : facets) {
        std::array<std::vector<FacetCorners>, 2> corners;
        for (; next < pieces.size() && pieces[next].side / 2 == facet.facet; ++next)
            corners[static_cast<std::size_t>(pieces[next].side % 2)].push_back(pieces[next].corners);
        const auto& [a, b, c] = facet.corners;
        const std::int64_t seen = sides.side_of(facet.facet, facet.region);
        for (const std::int64_t side : {seen, seen ^ 1}) {
            const std::vector<FacetCorners>& there = corners[static_cast<std::size_t>(side % 2)];
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
        for (std::size_t i = 0; i < words.size(); ++i)
            words[i] += random_bits(2 * static_cast<std::uint64_t>(number) + i);
    }
    void add(const SumOfNumbers& other) {
        for (std::size_t i = 0; i < words.size(); ++i) words[i] += other.words[i];
    }
    bool operator==(const SumOfNumbers&) const = default;

    template <class Archive>
    void archive(Archive& a) {
        a(words[0], words[1]);
    }
};

// Whether the leaves of all ranks have every side that is not divided once: told by 16 bytes of each rank.
bool has_each_once(Communicator& ranks, const std::vector<char>& divided, const SidesOfFacets& sides,
                   const std::vector<Leaf>& leaves) {
    SumOfNumbers wanted, own, there;
    for (std::int64_t side = 0; side < 2 * std::ssize(divided); ++side)
        if (!divided[static_cast<std::size_t>(side / 2)] && sides.has_region(side)) wanted.add(side);
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t) {
            if (!divided[facet] && sides.is_of(facet, leaf.region)) own.add(sides.side_of(facet, leaf.region));
        });
    for (const SumOfNumbers& of_rank : all_gather(ranks, own)) there.add(of_rank);
    return there == wanted;
}

// Facets in leaves of regions that they do not bound.
std::int64_t count_in_wrong_regions(Communicator& ranks, const SidesOfFacets& sides, const std::vector<Leaf>& leaves) {
    std::int64_t own = 0, all = 0;
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t) { own += !sides.is_of(facet, leaf.region); });
    for (const std::int64_t of_rank : all_gather(ranks, own)) all += of_rank;
    return all;
}

// How often each side is there, at most 255, by two bytes a facet from each rank; facets in wrong regions are not.
std::int64_t count_not_there_once(Communicator& ranks, const std::vector<char>& divided, const SidesOfFacets& sides,
                                  const std::vector<Leaf>& leaves) {
    std::vector<std::uint8_t> own(2 * divided.size(), 0);
    for (const Leaf& leaf : leaves)
        for_each_input_facet(leaf, [&](std::int32_t facet, std::size_t) {
            std::uint8_t& count = own[static_cast<std::size_t>(sides.side_of(facet, leaf.region))];
            if (sides.is_of(facet, leaf.region) && count < 255) ++count;
        });
    std::vector<std::int32_t> total(own.size(), 0);
    for (const auto& of_rank : all_gather(ranks, own))
        for (std::size_t s = 0; s < total.size(); ++s) total[s] += of_rank[s];
    std::int64_t missing = 0;
    for (std::size_t s = 0; s < total.size(); ++s)
        missing += !divided[s / 2] && total[s] != (sides.has_region(static_cast<std::int64_t>(s)) ? 1 : 0);
    return missing;
}

}  // namespace

std::int64_t count_missing_input_facets(Communicator& ranks, std::int64_t facets, const Decomposition& own,
                                        std::span<const FacetSides> sides_of_facets) {
    std::vector<char> divided(static_cast<std::size_t>(facets), 0);
    KERF_CHECK(sides_of_facets.empty() || std::ssize(sides_of_facets) == facets);
    KERF_CHECK(std::is_sorted(own.divided_facets.begin(), own.divided_facets.end(),
                              [](const DividedFacet& a, const DividedFacet& b) { return a.facet < b.facet; }));
    for (const DividedFacet& facet : own.divided_facets) divided[facet.facet] = 1;
    const SidesOfFacets sides(sides_of_facets);
    std::int64_t missing = count_in_wrong_regions(ranks, sides, own.leaves);
    if (!has_each_once(ranks, divided, sides, own.leaves))
        missing += count_not_there_once(ranks, divided, sides, own.leaves);
    return missing + count_uncovered(own.divided_facets, sides, gather_pieces(ranks, divided, sides, own.leaves));
}

}  // namespace kerf
