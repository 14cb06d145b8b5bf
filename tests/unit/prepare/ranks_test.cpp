// What the ranks agree on: the tree, interfaces, numbers. Ranks are threads here.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "base/parallel/shares.h"
#include "run/prepare/gathered_nodes.h"
#include "run/prepare/input_cover.h"
#include "run/prepare/interface_match.h"
#include "run/prepare/numbering.h"
#include "support/assets.h"
#include "support/counting_ranks.h"
#include "support/decomposition_laws.h"
#include "support/thread_ranks.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

Decomposition five_parts() {
    DecomposeOptions options;
    options.parts = 5;
    return decompose(test::asset_surface("hollow_box"), options, {0, 5});
}

std::vector<TreeNode> by_number(std::vector<TreeNode> nodes) {
    std::sort(nodes.begin(), nodes.end(), [](const TreeNode& a, const TreeNode& b) { return a.id < b.id; });
    return nodes;
}

// What each of so many ranks has of the tree.
std::vector<std::vector<TreeNode>> nodes_of_ranks(int size, std::int32_t parts) {
    std::vector<std::vector<TreeNode>> nodes;
    for (int rank = 0; rank < size; ++rank)
        nodes.push_back(decompose(test::asset_surface("hollow_box"), test::in_parts(parts),
                                  {parts * rank / size, parts * (rank + 1) / size})
                            .nodes);
    return nodes;
}

std::vector<std::pair<NodeId, FileHash>> hashes_of(const std::vector<TreeNode>& nodes) {
    std::vector<std::pair<NodeId, FileHash>> hashes;
    for (const TreeNode& node : nodes) hashes.emplace_back(node.id, node.cut_hash);
    return hashes;
}

std::string host_of(int rank) { return "host_" + std::to_string(rank / 2); }

// The error that every rank alike ends with; empty if none does.
std::string error_of_gathering(const std::vector<std::vector<TreeNode>>& nodes) {
    const int size = static_cast<int>(nodes.size());
    std::vector<std::string> errors(size);
    test::run_ranks(size, [&](Communicator& ranks) {
        try {
            gather_nodes(ranks, nodes[ranks.rank()], host_of(ranks.rank()));
        } catch (const Error& error) {
            errors[ranks.rank()] = error.what();
            EXPECT_EQ(error.code(), ErrorCode::internal);
        }
        EXPECT_EQ(all_gather(ranks, ranks.rank()).back(), size - 1) << "the ranks are still in step";
    });
    EXPECT_EQ(errors, std::vector<std::string>(size, errors.front()));
    return errors.front();
}

TEST(GatherNodes, GivesTheTreeOfOneRankWhereAllAgree) {
    const auto expected = hashes_of(by_number(nodes_of_ranks(1, 7).front()));
    for (const int size : {1, 2, 3, 7}) {
        const auto nodes = nodes_of_ranks(size, 7);
        test::run_ranks(size, [&](Communicator& ranks) {
            EXPECT_EQ(hashes_of(gather_nodes(ranks, nodes[ranks.rank()], "host")), expected);
        });
    }
}

// Every node that several ranks have, and every rank of these but the first.
TEST(GatherNodes, TellsWhichRankHasCutOtherwise) {
    const auto nodes = nodes_of_ranks(4, 7);
    const std::vector<void (*)(TreeNode&)> changes = {[](TreeNode& node) { node.cut_hash[1] ^= 1; },
                                                      [](TreeNode& node) { node.cut_tried = !node.cut_tried; },
                                                      [](TreeNode& node) { ++node.leaves; }};
    std::map<NodeId, int> first_rank;
    int shared = 0;
    for (int rank = 0; rank < 4; ++rank)
        for (std::size_t i = 0; i < nodes[rank].size(); ++i) {
            const NodeId id = nodes[rank][i].id;
            const auto [first, is_new] = first_rank.emplace(id, rank);
            if (is_new) continue;
            ++shared;
            const std::string words = "Rank " + std::to_string(first->second) + " on " + host_of(first->second) +
                                      " and rank " + std::to_string(rank) + " on " + host_of(rank) + " have cut node " +
                                      std::to_string(id.value()) + " ";
            for (const auto& change : changes) {
                auto unlike = nodes;
                change(unlike[rank][i]);
                const std::string error = error_of_gathering(unlike);
                EXPECT_NE(error.find(words), std::string::npos) << error;
            }
        }
    EXPECT_GE(shared, 3);
    EXPECT_EQ(error_of_gathering(nodes), "");
}

TEST(CutHash, TellsTheLastBitOfACut) {
    const SurfaceArrays box = test::asset_surface("hollow_box").arrays();
    SurfaceArrays scaled = box;
    for (Vec3& p : scaled.vertices) p *= 1 + 0x1p-51;
    for (const ContourMethod contour : {ContourMethod::min_cut, ContourMethod::straight}) {
        DecomposeOptions options = test::in_parts(5);
        options.cut.contour = contour;
        const auto hashes = [&](const SurfaceArrays& arrays) {
            return hashes_of(by_number(test::decompose_whole(Surface(arrays), options).nodes));
        };
        const auto first = hashes(box), again = hashes(box), other = hashes(scaled);
        EXPECT_EQ(first, again);
        std::set<FileHash> of_cuts;
        for (const auto& [id, hash] : first)
            if (hash != FileHash{0, 0}) of_cuts.insert(hash);
        EXPECT_EQ(of_cuts.size(), 4u);
        for (const auto& [id, hash] : other) EXPECT_FALSE(of_cuts.contains(hash)) << "node " << id.value();
    }
}

TEST(InterfaceMatch, BothSidesNameEachOther) {
    const Decomposition five = five_parts();
    SingleRank alone;
    const InterfaceMatch match(alone, five.leaves);
    EXPECT_EQ(match.unmatched(), 0);
    std::map<Key, std::set<std::pair<NodeId, NodeId>>> sides;
    for (std::size_t i = 0; i < five.leaves.size(); ++i) {
        const Leaf& leaf = five.leaves[i];
        const std::vector<NodeId>& neighbours = match.neighbours(i);
        for (std::size_t f = 0; f < neighbours.size(); ++f) {
            EXPECT_EQ(neighbours[f] == NodeId::none(), key_node(leaf.surface.facet_key[f]) == input_node);
            if (neighbours[f].is_valid()) sides[leaf.surface.facet_key[f]].insert({leaf.id, neighbours[f]});
        }
    }
    EXPECT_FALSE(sides.empty());
    for (const auto& [facet, pair] : sides) {
        ASSERT_EQ(pair.size(), 2u);
        EXPECT_EQ(pair.begin()->first, pair.rbegin()->second);
        EXPECT_EQ(pair.begin()->second, pair.rbegin()->first);
    }
}

// Of all leaves those of a rank.
std::vector<Leaf> leaves_of_rank(const std::vector<Leaf>& all, const Communicator& ranks) {
    const auto first = [&](int rank) { return all.begin() + first_of_rank(std::ssize(all), rank, ranks); };
    return {first(ranks.rank()), first(ranks.rank() + 1)};
}

TEST(InterfaceMatch, IsTheSameForLeavesOnSeveralRanks) {
    const test::VoxelBody grains = test::voxel_body({5, 5, 5}, test::grains({5, 5, 5}, 4, 7));
    const Decomposition of_regions = decompose(test::to_complex(grains), test::in_parts(11), {0, 11});
    const Decomposition five = five_parts();
    for (const auto& [all, sides] :
         {std::pair(&five.leaves, std::vector<FacetSides>()), std::pair(&of_regions.leaves, grains.sides)}) {
        SingleRank alone;
        const InterfaceMatch whole(alone, *all, sides);
        for (const int size : {1, 2, 4, 8})
            test::run_ranks(size, [&, all = all, &sides = sides](Communicator& ranks) {
                const std::vector<Leaf> own = leaves_of_rank(*all, ranks);
                const InterfaceMatch match(ranks, own, sides);
                EXPECT_EQ(match.unmatched(), 0);
                const std::int64_t before = first_of_rank(std::ssize(*all), ranks.rank(), ranks);
                for (std::size_t i = 0; i < own.size(); ++i)
                    EXPECT_EQ(match.neighbours(i), whole.neighbours(static_cast<std::size_t>(before) + i));
            });
    }
}

TEST(InterfaceMatch, CountsWhatDoesNotMatch) {
    const auto unmatched_after = [](const auto& damage) {
        Decomposition five = five_parts();
        damage(five.leaves);
        std::set<std::int64_t> counts;
        for (const int size : {1, 2, 3, 6}) {
            std::vector<std::int64_t> of_ranks(size);
            test::run_ranks(size, [&](Communicator& ranks) {
                of_ranks[ranks.rank()] = InterfaceMatch(ranks, leaves_of_rank(five.leaves, ranks)).unmatched();
            });
            counts.insert(of_ranks.begin(), of_ranks.end());
        }
        EXPECT_EQ(counts.size(), 1u) << "on all ranks, however many";
        return *counts.begin();
    };
    // The last facet of a leaf lies on the interface that was cut last.
    EXPECT_EQ(unmatched_after([](auto& leaves) {
                  std::swap(leaves[0].surface.facets.back()[0], leaves[0].surface.facets.back()[1]);
              }),
              1);
    const auto without_last_facet = [](SurfaceArrays& surface) {
        surface.facets.pop_back();
        surface.facet_key.pop_back();
    };
    EXPECT_EQ(unmatched_after([&](auto& leaves) { without_last_facet(leaves[0].surface); }), 1);
    EXPECT_GT(unmatched_after([](auto& leaves) { leaves.pop_back(); }), 10);
}

// Leaves dealt out to ranks: each is told and asked as much as its own have to do with others.
TEST(InterfaceMatch, CostsARankLessWhereThereAreMore) {
    const Decomposition whole = decompose(test::asset_surface("bearing_cap_14k"), test::in_parts(16), {0, 16});
    std::map<int, test::Traffic> busiest;
    for (const int size : {2, 4, 8}) {
        std::vector<test::Traffic> traffic(size);
        test::run_ranks(size, [&](Communicator& ranks) {
            test::CountingRanks counting(ranks);
            const InterfaceMatch match(counting, leaves_of_rank(whole.leaves, ranks));
            traffic[ranks.rank()] = counting.traffic();
        });
        busiest[size] = *std::max_element(traffic.begin(), traffic.end(),
                                          [](const auto& a, const auto& b) { return a.bytes() < b.bytes(); });
        EXPECT_LE(busiest[size].messages, 2 * (size - 1) + 3 * 4) << size;
    }
    // Of a share 1 / P of all sides (P - 1) / P goes elsewhere: 7/16 of it from 2 ranks to 8, were all parts alike.
    EXPECT_LT(busiest[8].bytes(), 0.6 * static_cast<double>(busiest[2].bytes()));
    EXPECT_LT(busiest[8].bytes(), 0.75 * static_cast<double>(busiest[4].bytes()));
}

// On so many ranks; the same on all of them.
std::int64_t missing_on_ranks(int size, const Decomposition& all, std::int64_t facets,
                              const std::vector<FacetSides>& sides = {}) {
    std::vector<std::int64_t> missing(size);
    test::run_ranks(size, [&](Communicator& ranks) {
        Decomposition own;
        own.divided_facets = all.divided_facets;
        own.leaves = leaves_of_rank(all.leaves, ranks);
        missing[ranks.rank()] = count_missing_input_facets(ranks, facets, own, sides);
    });
    EXPECT_EQ(missing, std::vector<std::int64_t>(size, missing.front())) << size << " ranks";
    return missing.front();
}

// However many ranks there are.
std::int64_t missing_facets(const Decomposition& all, std::int64_t facets, const std::vector<FacetSides>& sides = {}) {
    const std::int64_t missing = missing_on_ranks(1, all, facets, sides);
    for (const int size : {2, 3, 8}) EXPECT_EQ(missing_on_ranks(size, all, facets, sides), missing) << size << " ranks";
    return missing;
}

std::int64_t missing_after(const std::function<void(SurfaceArrays&)>& damage) {
    Decomposition all = five_parts();
    damage(all.leaves[1].surface);
    return missing_facets(all, all.nodes.front().facets);
}

TEST(InputCover, CountsFacetsThatAreMissingOrNotThereOnce) {
    const auto place_of_first = [](const SurfaceArrays& s) {
        return std::find_if(s.facet_key.begin(), s.facet_key.end(), is_of_input) - s.facet_key.begin();
    };
    EXPECT_EQ(missing_after([](SurfaceArrays&) {}), 0);
    EXPECT_EQ(missing_after([&](SurfaceArrays& s) {
                  const auto first = place_of_first(s);
                  s.facets.erase(s.facets.begin() + first);
                  s.facet_key.erase(s.facet_key.begin() + first);
              }),
              1);
    EXPECT_EQ(missing_after([&](SurfaceArrays& s) {
                  const auto first = place_of_first(s);
                  s.facets.push_back(s.facets[first]);
                  s.facet_key.push_back(s.facet_key[first]);
              }),
              1);
    EXPECT_EQ(missing_after([&](SurfaceArrays& s) {
                  const auto first = s.facet_key.begin() + place_of_first(s);
                  *std::find_if(first + 1, s.facet_key.end(), is_of_input) = *first;
              }),
              2)
        << "as many as before";
}

// Facets that straight cuts divide, at each of which pieces of several parts meet.
TEST(InputCover, CountsFacetsWithoutAllTheirPieces) {
    DecomposeOptions options = test::in_parts(6);
    options.cut.contour = ContourMethod::straight;
    const Surface box = test::asset_surface("hollow_box");
    const Decomposition whole = test::decompose_whole(box, options);
    ASSERT_GT(whole.divided_facets.size(), 10u);
    EXPECT_EQ(missing_facets(whole, box.facet_count()), 0);
    std::int64_t expected = 0;
    Decomposition damaged = whole;
    for (const DividedFacet& facet : whole.divided_facets) {
        if (facet.facet % 3 != 0) continue;
        ++expected;
        const auto is_its = [&](Key key) { return is_of_input(key) && key_index(key) == facet.facet; };
        for (Leaf& leaf : damaged.leaves) {
            SurfaceArrays& s = leaf.surface;
            const auto piece = std::find_if(s.facet_key.begin(), s.facet_key.end(), is_its);
            if (piece == s.facet_key.end()) continue;
            s.facets.erase(s.facets.begin() + (piece - s.facet_key.begin()));
            s.facet_key.erase(piece);
            break;
        }
    }
    EXPECT_GT(expected, 2);
    EXPECT_EQ(missing_facets(damaged, box.facet_count()), expected);
}

// The sums of all ranks alone where all is there; of what is not, each facet of a leaf goes to one rank.
TEST(InputCover, TellsTheOthersLittle) {
    Decomposition all = decompose(test::asset_surface("bearing_cap_14k"), test::in_parts(16), {0, 16});
    const std::int64_t facets = all.nodes.front().facets;
    for (const bool is_whole : {true, false}) {
        if (!is_whole) all.leaves.pop_back();
        for (const int size : {2, 4, 8})
            test::run_ranks(size, [&](Communicator& ranks) {
                test::CountingRanks counting(ranks);
                Decomposition own;
                own.leaves = leaves_of_rank(all.leaves, ranks);
                EXPECT_EQ(count_missing_input_facets(counting, facets, own) == 0, is_whole);
                std::int64_t of_leaves = 0;
                for (const Leaf& leaf : own.leaves) of_leaves += std::ssize(leaf.surface.facets);
                const std::int64_t all_alike = 400 + 40 * size;
                EXPECT_LE(counting.traffic().sent_bytes, all_alike + (is_whole ? 0 : 8 * of_leaves));
                EXPECT_LE(counting.traffic().received_bytes, all_alike + (is_whole ? 0 : 8 * (facets / size + 1)));
            });
    }
}

TEST(VertexNumbering, IsDenseOverInputAndCuts) {
    const Decomposition five = five_parts();
    const std::int64_t input_vertices = five.nodes.front().vertices;
    const VertexNumbering numbering(input_vertices, by_number(five.nodes));
    std::map<Key, std::int64_t> number_of;
    std::set<std::int64_t> numbers;
    for (const Leaf& leaf : five.leaves) {
        const std::vector<std::int64_t> ids = numbering.global_ids(leaf.surface.vertex_key);
        for (std::size_t v = 0; v < ids.size(); ++v) {
            const Key key = leaf.surface.vertex_key[v];
            EXPECT_TRUE(key_node(key) != input_node || ids[v] == key_index(key));
            EXPECT_EQ(number_of.emplace(key, ids[v]).first->second, ids[v]);
            numbers.insert(ids[v]);
        }
    }
    EXPECT_EQ(number_of.size(), numbers.size());
    EXPECT_EQ(*numbers.begin(), 0);
    EXPECT_EQ(*numbers.rbegin() + 1, static_cast<std::int64_t>(numbers.size()));
    EXPECT_EQ(numbering.surface_vertices(), static_cast<std::int64_t>(numbers.size()));
}

TEST(VertexNumbering, SkipsNodesWithoutACut) {
    std::vector<TreeNode> nodes(4);
    for (int i = 0; i < 4; ++i)
        nodes[i].id = NodeId(i + 1), nodes[i].interface_vertices = 10, nodes[i].cut_made = i % 2 == 0;
    const VertexNumbering numbering(100, nodes);
    EXPECT_EQ(numbering.global_id(make_key(input_node, 99)), 99);
    EXPECT_EQ(numbering.global_id(make_key(NodeId(1), 3)), 103);
    EXPECT_EQ(numbering.global_id(make_key(NodeId(3), 3)), 113);
    EXPECT_EQ(numbering.surface_vertices(), 120);
}

// Of regions each side of a facet is to be there, in a leaf of the region that lies there.
TEST(InputCover, CountsSidesOfRegions) {
    const test::VoxelBody body =
        test::voxel_body({6, 3, 3}, test::refined([](std::array<std::int32_t, 3> cube) { return cube[0]; }, 3));
    const Decomposition whole = decompose(test::to_complex(body), test::in_parts(5), {0, 5});
    const auto missing_after = [&](const std::function<void(Decomposition&, std::vector<FacetSides>&)>& damage) {
        SingleRank alone;
        Decomposition damaged = whole;
        std::vector<FacetSides> sides = body.sides;
        damage(damaged, sides);
        EXPECT_EQ(InterfaceMatch(alone, whole.leaves, body.sides).unmatched(), 0);
        return missing_facets(damaged, std::ssize(sides), sides);
    };
    EXPECT_EQ(missing_after([](auto&, auto&) {}), 0);
    EXPECT_GT(missing_after([](Decomposition& d, auto&) { d.leaves[0].region = RegionIndex(1); }), 9);
    EXPECT_EQ(missing_after([](auto&, auto& sides) {
                  std::find_if(sides.begin(), sides.end(), [](const FacetSides& s) { return s.is_wall(); })->front =
                      RegionIndex::none();
              }),
              1);
}

}  // namespace
}  // namespace kerf
