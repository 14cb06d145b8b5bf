#include "prepare/input_cover.h"

#include <algorithm>

#include "core/check.h"
#include "core/mixed_bits.h"
#include "surface/facet_cover.h"

namespace kerf {

namespace {

struct Piece {
    std::int32_t facet;
    std::array<Vec3, 3> corners;

    template <class Archive>
    void archive(Archive& a) {
        a(facet, corners[0], corners[1], corners[2]);
    }
};

// Pieces of all leaves, by facet.
std::vector<Piece> gather_pieces(Communicator& ranks, const std::vector<char>& divided,
                                 const std::vector<Leaf>& leaves) {
    std::vector<Piece> own;
    for (const Leaf& leaf : leaves)
        for (std::size_t f = 0; f < leaf.surface.facets.size(); ++f) {
            const Key key = leaf.surface.facet_key[f];
            if (!is_of_input(key) || !divided[key_index(key)]) continue;
            const Triangle& t = leaf.surface.facets[f];
            const std::vector<Vec3>& p = leaf.surface.vertices;
            own.push_back({key_index(key), {p[t[0]], p[t[1]], p[t[2]]}});
        }
    std::vector<Piece> all = gather_items(ranks, own);
    std::stable_sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.facet < b.facet; });
    return all;
}

std::int64_t count_uncovered(const std::vector<DividedFacet>& facets, const std::vector<Piece>& pieces) {
    std::int64_t uncovered = 0;
    std::size_t next = 0;
    for (const DividedFacet& facet : facets) {
        std::vector<std::array<Vec3, 3>> corners;
        for (; next < pieces.size() && pieces[next].facet == facet.facet; ++next)
            corners.push_back(pieces[next].corners);
        uncovered += !covers(facet.corners, corners);
    }
    return uncovered;
}

// Two sums of random words, one for each number, without regard to order: equal for the same numbers, each as often,
// and otherwise by a chance of 2^-128.
struct SumOfNumbers {
    std::array<std::uint64_t, 2> words{};

    void add(std::int32_t number) {
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

// Whether the leaves of all ranks have every facet that is not divided once: told by 16 bytes of each rank.
bool has_each_once(Communicator& ranks, const std::vector<char>& divided, const std::vector<Leaf>& leaves) {
    SumOfNumbers wanted, own, there;
    for (std::size_t f = 0; f < divided.size(); ++f)
        if (!divided[f]) wanted.add(static_cast<std::int32_t>(f));
    for (const Leaf& leaf : leaves)
        for (const Key key : leaf.surface.facet_key)
            if (is_of_input(key) && !divided[key_index(key)]) own.add(key_index(key));
    for (const SumOfNumbers& of_rank : all_gather(ranks, own)) there.add(of_rank);
    return there == wanted;
}

// How often each facet is there, at most 255, by a byte a facet from each rank.
std::int64_t count_not_there_once(Communicator& ranks, const std::vector<char>& divided,
                                  const std::vector<Leaf>& leaves) {
    std::vector<std::uint8_t> own(divided.size(), 0);
    for (const Leaf& leaf : leaves)
        for (const Key key : leaf.surface.facet_key)
            if (is_of_input(key) && own[key_index(key)] < 255) ++own[key_index(key)];
    std::vector<std::int32_t> total(own.size(), 0);
    for (const auto& of_rank : all_gather(ranks, own))
        for (std::size_t f = 0; f < total.size(); ++f) total[f] += of_rank[f];
    std::int64_t missing = 0;
    for (std::size_t f = 0; f < total.size(); ++f) missing += !divided[f] && total[f] != 1;
    return missing;
}

}  // namespace

std::int64_t count_missing_input_facets(Communicator& ranks, std::int64_t facets, const Decomposition& own) {
    std::vector<char> divided(static_cast<std::size_t>(facets), 0);
    KERF_CHECK(std::is_sorted(own.divided_facets.begin(), own.divided_facets.end(),
                              [](const DividedFacet& a, const DividedFacet& b) { return a.facet < b.facet; }));
    for (const DividedFacet& facet : own.divided_facets) divided[facet.facet] = 1;
    const std::int64_t missing =
        has_each_once(ranks, divided, own.leaves) ? 0 : count_not_there_once(ranks, divided, own.leaves);
    return missing + count_uncovered(own.divided_facets, gather_pieces(ranks, divided, own.leaves));
}

}  // namespace kerf
