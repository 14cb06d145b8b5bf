// Ranks cut what one alone would, each node once, and end together. Ranks are threads here.
#include "run/run/inside/cuts_on_ranks.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "run/run/inside/range_of_rank.h"
#include "support/assets.h"
#include "support/decomposition_laws.h"
#include "support/failing_ranks.h"
#include "support/thread_ranks.h"
#include "support/voxel_regions.h"
#include "support/voxels.h"
#include "surface/complex/touching.h"

namespace kerf {
namespace {

constexpr std::array rank_counts = {2, 3, 5, 8};

// What each rank has cut, by decompose_on_ranks().
std::vector<Decomposition> cut_on_ranks(int size, const Complex& complex, const DecomposeOptions& options,
                                        const std::function<CutListener*(int rank)>& listener_of = {}) {
    std::vector<Decomposition> of_rank(static_cast<std::size_t>(size));
    test::run_ranks(size, [&](Communicator& ranks) {
        const int rank = ranks.rank();
        Complex own = rank == 0 || complex.region_count() > 1 ? complex : Complex();
        of_rank[static_cast<std::size_t>(rank)] =
            decompose_on_ranks(ranks, own, options, listener_of ? listener_of(rank) : nullptr);
    });
    return of_rank;
}

std::map<NodeId, Bytes> nodes_by_number(std::vector<TreeNode> nodes) {
    std::map<NodeId, Bytes> by_number;
    for (TreeNode& node : nodes) {
        node.seconds = 0;
        by_number.emplace(node.id, to_bytes(node));
    }
    return by_number;
}

// The law: leaf for leaf in the order of ranks, and node for node, the same bytes as of one rank.
void expect_same_as_alone(const Complex& complex, const DecomposeOptions& options) {
    const Decomposition alone = decompose(complex, options, {0, options.parts});
    for (const int size : rank_counts) {
        SCOPED_TRACE(testing::Message() << options.parts << " parts on " << size << " ranks");
        std::vector<Leaf> leaves;
        std::vector<TreeNode> nodes;
        std::size_t divided = 0;  // that several ranks pass
        for (const Decomposition& own : cut_on_ranks(size, complex, options)) {
            leaves.insert(leaves.end(), own.leaves.begin(), own.leaves.end());
            nodes.insert(nodes.end(), own.nodes.begin(), own.nodes.end());
            const auto has_regions = [](const TreeNode& node) { return node.regions > 1; };
            divided += static_cast<std::size_t>(std::count_if(own.nodes.begin(), own.nodes.end(), has_regions));
            EXPECT_EQ(own.contacts.empty(), alone.contacts.empty());
        }
        EXPECT_TRUE(to_bytes(leaves) == to_bytes(alone.leaves));
        const std::map<NodeId, Bytes> by_number = nodes_by_number(nodes);
        EXPECT_TRUE(by_number == nodes_by_number(alone.nodes));
        EXPECT_TRUE(divided > 0 || by_number.size() == nodes.size()) << "a node was cut twice";
    }
}

TEST(CutsOnRanks, LeavesAreThoseOfOneRank) {
    for (const std::string asset : {"cylinder", "hollow_box", "pipe_with_holes"}) {
        SCOPED_TRACE(asset);
        const Complex complex(test::asset_surface(asset));
        for (const std::int32_t parts : {1, 2, 7, 16})
            for (const std::int32_t threads : {1, 2}) {
                DecomposeOptions options = test::in_parts(parts);
                options.threads = threads;
                expect_same_as_alone(complex, options);
            }
    }
}

// Parts that stay whole have leaves that other ranks wait for.
TEST(CutsOnRanks, PartsThatStayWholeLeaveNobodyWaiting) {
    expect_same_as_alone(Complex(test::asset_surface("cube")), test::in_parts(16));
    expect_same_as_alone(Complex(test::asset_surface("hollow_box")), test::in_parts(100));
    DecomposeOptions straight = test::in_parts(9);
    straight.cut.contour = ContourMethod::straight;  // is for later
    expect_same_as_alone(Complex(test::asset_surface("cylinder")), straight);
}

// Facets do not tell the partners of edges with the same two ends.
TEST(CutsOnRanks, SurfacesThatTouchThemselvesArriveAsTheyWere) {
    for (const test::Voxels& voxels : {test::Voxels{{0, 0, 0}, {1, 1, 0}}, test::notched_voxels()}) {
        const SurfaceArrays welded = test::to_arrays(test::voxel_surface(voxels, 4));
        expect_same_as_alone(Complex(to_surface(separate_touching(welded))), test::in_parts(6));
    }
}

TEST(CutsOnRanks, LeavesOfRegionsAreThoseOfOneRank) {
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        SCOPED_TRACE(bodies.name);
        const auto [x, y, z] = bodies.cubes;
        const Complex complex =
            test::to_complex(test::voxel_body({3 * x, 3 * y, 3 * z}, test::refined(bodies.region, 3)));
        if (complex.region_count() < 2) continue;
        expect_same_as_alone(complex, test::in_parts(2 * complex.region_count() + 1));
    }
}

// Fails at a node, or wants the end.
class Disturber : public CutListener {
 public:
    void on_cut(const Surface&, const Cut& cut) override {
        if (cut.node == failing_node) throw Error(ErrorCode::io, "The disk is full.");
    }
    bool cancelled() const override { return wants_end; }
    NodeId failing_node = no_node;
    std::atomic<bool> wants_end = false;
};

// The codes by which ranks end. 0 and -1: nothing fails, nobody wants the end.
std::vector<ErrorCode> codes_of(int size, const Complex& complex, NodeId failing_node, int cancelled_rank) {
    std::vector<Disturber> disturbers(static_cast<std::size_t>(size));
    std::vector<ErrorCode> codes(static_cast<std::size_t>(size), ErrorCode::internal);
    test::run_ranks(size, [&](Communicator& ranks) {
        const auto rank = static_cast<std::size_t>(ranks.rank());
        disturbers[rank].failing_node = failing_node;
        disturbers[rank].wants_end = ranks.rank() == cancelled_rank;
        Complex own = rank == 0 ? complex : Complex();
        try {
            decompose_on_ranks(ranks, own, test::in_parts(8), &disturbers[rank]);
        } catch (const Error& error) {
            codes[rank] = error.code();
        }
        EXPECT_EQ(all_gather(ranks, ranks.rank()).back(), size - 1) << "the ranks are still in step";
        EXPECT_FALSE(ranks.poll() || ranks.receive_any()) << "nothing is on its way";
    });
    return codes;
}

TEST(CutsOnRanks, AFailureAtAnyLevelEndsAll) {
    const Complex complex(test::asset_surface("cylinder"));
    for (const int size : rank_counts)
        for (const NodeId node : {root_node, NodeId(2), NodeId(3), NodeId(5), NodeId(7)})
            EXPECT_EQ(codes_of(size, complex, node, -1), std::vector<ErrorCode>(size, ErrorCode::io))
                << size << " ranks, node " << node.value();
}

TEST(CutsOnRanks, AnyRankCanEndAll) {
    const Complex complex(test::asset_surface("cylinder"));
    for (const int size : {2, 5, 12})
        for (const int rank : {0, 1, size - 1})
            EXPECT_EQ(codes_of(size, complex, no_node, rank), std::vector<ErrorCode>(size, ErrorCode::cancelled))
                << size << " ranks, " << rank << " is stopped";
}

// The codes by which ranks end, 0 for a good end, where each cuts by means of what made(ranks) makes of it.
template <class Made>
std::vector<int> codes_with(int size, const Complex& complex, NodeId failing_node, Made made) {
    std::vector<int> codes(static_cast<std::size_t>(size));
    test::run_ranks(size, [&](Communicator& ranks) {
        const auto rank = static_cast<std::size_t>(ranks.rank());
        Disturber disturber;
        disturber.failing_node = failing_node;
        Complex own = rank == 0 ? complex : Complex();
        try {
            auto with = made(ranks);
            run_together(ranks, [&] { decompose_on_ranks(with, own, test::in_parts(8), &disturber); });
        } catch (const Error& error) {
            codes[rank] = static_cast<int>(error.code());
        }
    });
    return codes;
}

// Whatever it is that it cannot tell: that it is done, that it or another one has failed, that all are done.
TEST(CutsOnRanks, ARankThatCannotTellEndsAll) {
    const Complex complex(test::asset_surface("cylinder"));
    for (const int size : {2, 5})
        for (const int rank : {0, 1, size - 1})
            for (int good_posts = 0; good_posts < size; ++good_posts)
                for (const NodeId node : {no_node, root_node, NodeId(2)}) {
                    const std::vector<int> codes = codes_with(size, complex, node, [&](Communicator& ranks) {
                        return test::FailingPosts(ranks, ranks.rank() == rank ? good_posts : 1000);
                    });
                    SCOPED_TRACE(testing::Message() << size << " ranks, " << rank << " fails after " << good_posts
                                                    << " posts, node " << node.value());
                    EXPECT_EQ(codes, std::vector<int>(codes.size(), codes[0]));
                    EXPECT_TRUE(codes[0] != 0 || (node == no_node && good_posts > 0));
                }
}

// One has no memory when it hears that all are done: the others are no more at the cuts then.
TEST(CutsOnRanks, AFailureAtTheEndIsThatOfAll) {
    constexpr std::int32_t end_of_all = 3;
    const auto is_end = [](const Bytes& note) {
        return from_bytes<std::int32_t>(std::span(note).first(4)) == end_of_all;
    };
    const Complex complex(test::asset_surface("cylinder"));
    for (const int size : {2, 5})
        EXPECT_EQ(codes_with(size, complex, no_node,
                             [&](Communicator& ranks) {
                                 const bool is_last = ranks.rank() == size - 1;
                                 return test::FailingPoll(ranks,
                                                          [=](const Bytes& note) { return is_last && is_end(note); });
                             }),
                  std::vector<int>(static_cast<std::size_t>(size), static_cast<int>(ErrorCode::memory)));
}

TEST(CutsOnRanks, ListenersHearOfEachCutOnce) {
    class Counter : public CutListener {
     public:
        void on_cut(const Surface&, const Cut& cut) override { nodes.push_back(cut.node); }
        std::vector<NodeId> nodes;
    };
    const Complex complex(test::asset_surface("pipe_with_holes"));
    std::vector<Counter> counters(3);
    cut_on_ranks(3, complex, test::in_parts(7), [&](int rank) { return &counters[static_cast<std::size_t>(rank)]; });
    std::vector<NodeId> nodes;
    for (const Counter& counter : counters) nodes.insert(nodes.end(), counter.nodes.begin(), counter.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    EXPECT_EQ(nodes.size(), 6u);
    EXPECT_EQ(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

TEST(RangeOfRank, NamesTheRankOfEachItem) {
    test::run_ranks(7, [](Communicator& ranks) {
        for (const std::int32_t count : {1, 2, 6, 7, 8, 13, 1000, 2147483647}) {
            const LeafRange range = range_of_rank(count, ranks);
            for (const std::int32_t item : {0, count / 3, count / 2, count - 1})
                EXPECT_EQ(range.contains(item), rank_in_range(count, item, ranks) == ranks.rank()) << count;
        }
    });
}

}  // namespace
}  // namespace kerf
