// What ranks gather, and how they agree on errors.
#include "base/parallel/communicator.h"

#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

#include "base/parallel/shares.h"
#include "support/collective_laws.h"
#include "support/counting_ranks.h"
#include "support/failing_ranks.h"
#include "support/thread_ranks.h"

namespace kerf {
namespace {

// The message of the error that a stage ends with on every rank, per rank.
template <class Stage>
std::vector<std::string> errors_of(int size, Stage stage, ErrorCode expected) {
    std::vector<std::string> errors(size);
    test::run_ranks(size, [&](Communicator& ranks) {
        try {
            in_agreement(ranks, [&] { stage(ranks.rank()); });
        } catch (const Error& error) {
            errors[ranks.rank()] = error.what();
            EXPECT_EQ(error.code(), expected);
        }
        EXPECT_EQ(all_gather(ranks, ranks.rank()).back(), size - 1) << "the ranks are still in step";
    });
    return errors;
}

TEST(InAgreement, ReturnsEachRanksValue) {
    test::run_ranks(3, [](Communicator& ranks) {
        EXPECT_EQ(in_agreement(ranks, [&] { return 10 * ranks.rank(); }), 10 * ranks.rank());
        EXPECT_EQ(all_gather(ranks, std::to_string(ranks.rank())), (std::vector<std::string>{"0", "1", "2"}));
    });
}

TEST(InAgreement, ErrorOfOneRankIsThrownOnAll) {
    const auto on_rank_1 = [](int rank) {
        if (rank == 1) throw Error(ErrorCode::io, "The disk of rank 1 is full.");
    };
    const std::string message = "The disk of rank 1 is full.";
    EXPECT_EQ(errors_of(2, on_rank_1, ErrorCode::io), (std::vector<std::string>{message, message}));
}

TEST(InAgreement, ElementsOfAnErrorReachAllRanks) {
    test::run_ranks(2, [](Communicator& ranks) {
        try {
            in_agreement(ranks, [&] {
                if (ranks.rank() == 1)
                    throw Error(ErrorCode::input, "Facet 7.", {{ElementKind::facet, {7}, {{1, 2, 3}}, {"inlet"}}});
            });
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            ASSERT_EQ(error.elements().size(), 1u);
            const ErrorElements& facet = error.elements()[0];
            EXPECT_EQ(facet.kind, ElementKind::facet);
            EXPECT_EQ(facet.ids, std::vector<std::int64_t>{7});
            EXPECT_EQ(facet.points[0], (std::array<double, 3>{1, 2, 3}));
            EXPECT_EQ(facet.names, std::vector<std::string>{"inlet"});
        }
    });
}

TEST(InAgreement, FirstRankWins) {
    const auto on_all = [](int rank) {
        throw Error(rank ? ErrorCode::io : ErrorCode::input, "rank " + std::to_string(rank));
    };
    EXPECT_EQ(errors_of(3, on_all, ErrorCode::input), std::vector<std::string>(3, "rank 0"));
}

// The rank that was stopped because of another's error must not hide it.
TEST(InAgreement, BeingStoppedGivesWayToErrors) {
    const auto rank_1_fails = [](int rank) {
        throw Error(rank == 1 ? ErrorCode::io : ErrorCode::cancelled, "rank " + std::to_string(rank));
    };
    const auto all_stop = [](int rank) { throw Error(ErrorCode::cancelled, "rank " + std::to_string(rank)); };
    EXPECT_EQ(errors_of(3, rank_1_fails, ErrorCode::io), std::vector<std::string>(3, "rank 1"));
    EXPECT_EQ(errors_of(2, all_stop, ErrorCode::cancelled), std::vector<std::string>(2, "rank 0"));
}

TEST(InAgreement, OtherExceptionsGetTheirCodes) {
    const auto memory = [](int rank) {
        if (rank == 1) throw std::bad_alloc();
    };
    const auto bug = [](int rank) {
        if (rank == 0) throw std::logic_error("a bug");
    };
    EXPECT_NE(errors_of(2, memory, ErrorCode::memory)[0].find("Out of memory"), std::string::npos);
    EXPECT_EQ(errors_of(2, bug, ErrorCode::internal), (std::vector<std::string>{"a bug", "a bug"}));
}

TEST(Gathering, ListsTheItemsOfAllRanksInTheirOrder) {
    test::run_ranks(3, [](Communicator& ranks) {
        const std::vector<int> own(static_cast<std::size_t>(ranks.rank()), ranks.rank());
        EXPECT_EQ(gather_items(ranks, own), (std::vector<int>{1, 2, 2}));
    });
}

TEST(Collectives, KeepTheirPromises) {
    for (const int size : {1, 2, 3, 8})
        test::run_ranks(size, [](Communicator& ranks) {
            for (const std::size_t largest : {1, 9, 40'001}) test::expect_collectives(ranks, largest);
            test::expect_sums(ranks);
            test::expect_exchanged_items(ranks);
            test::expect_posts(ranks);
        });
    SingleRank alone;
    test::expect_collectives(alone, 10);
    test::expect_sums(alone);
    test::expect_exchanged_items(alone);
    test::expect_posts(alone);
}

TEST(Collectives, EndWhenARankLeaves) {
    for (const int size : {2, 5})
        for (const test::Waiting& waiting : test::ways_to_wait())
            test::run_ranks(size, [&](Communicator& ranks) { test::expect_that_leaving_ends_all(ranks, waiting); });
}

// The code of the error by which all ranks end, of which each runs body(ranks).
template <class Body>
void expect_end(int size, ErrorCode expected, Body body) {
    test::run_ranks(size, [&](Communicator& ranks) {
        try {
            run_together(ranks, [&] { body(ranks); });
            ADD_FAILURE() << "rank " << ranks.rank() << " of " << size << " has not failed";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), expected) << "rank " << ranks.rank() << " of " << size;
        }
    });
}

TEST(BytesOfRoot, AreAnErrorWhereTheRootHasLeft) {
    for (const int size : {2, 5})
        expect_end(size, ErrorCode::io, [](Communicator& ranks) {
            if (ranks.rank() == 0) throw Error(ErrorCode::io, "The disk is full.");
            bytes_of_root(
                ranks, [] { return Bytes(1); }, [] {});
        });
}

// The first error counts, if there is one.
TEST(BytesOfRoot, AreAnErrorWhereTheRootCannotTellThatItHasThem) {
    for (const int size : {2, 5})
        for (const int good_posts : {0, size - 2})
            for (const bool fails : {false, true})
                expect_end(size, fails ? ErrorCode::io : ErrorCode::memory, [&](Communicator& ranks) {
                    test::FailingPosts failing(ranks, good_posts);
                    const auto stage = [&] {
                        if (fails) throw Error(ErrorCode::io, "The disk is full.");
                        return Bytes(1);
                    };
                    bytes_of_root(failing, stage, [] {});
                });
}

TEST(Shares, AreRangesThatFollowEachOther) {
    for (const int size : {1, 2, 3, 7, 8})
        test::run_ranks(size, [](Communicator& ranks) {
            for (const std::int64_t count : {1, 2, 7, 8, 9, 1000}) {
                EXPECT_EQ(first_of_rank(count, 0, ranks), 0);
                EXPECT_EQ(first_of_rank(count, ranks.size(), ranks), count);
                for (int r = 0; r < ranks.size(); ++r) {
                    const std::int64_t first = first_of_rank(count, r, ranks), end = first_of_rank(count, r + 1, ranks);
                    EXPECT_TRUE(end - first == count / ranks.size() || end - first == count / ranks.size() + 1);
                    for (std::int64_t i = first; i < end; ++i) EXPECT_EQ(rank_in_range(count, i, ranks), r);
                }
            }
        });
}

// The busiest rank of so many, in a stage.
template <class Stage>
test::Traffic busiest_of(int size, Stage stage) {
    std::vector<test::Traffic> traffic(size);
    test::run_ranks(size, [&](Communicator& ranks) {
        test::CountingRanks counting(ranks);
        stage(counting);
        traffic[ranks.rank()] = counting.traffic();
    });
    return *std::max_element(traffic.begin(), traffic.end(),
                             [](const auto& a, const auto& b) { return a.bytes() < b.bytes(); });
}

TEST(InAgreement, CostsASumOfTwoNumbersWhereAllIsWell) {
    for (const int size : {1, 2, 4, 8, 64}) {
        const test::Traffic traffic = busiest_of(size, [](Communicator& ranks) { in_agreement(ranks, [] {}); });
        const std::int64_t depth = std::bit_width(static_cast<unsigned>(size - 1));
        EXPECT_LE(traffic.bytes(), 2 * 16 * depth);
        EXPECT_LE(traffic.messages, depth);
    }
}

}  // namespace
}  // namespace kerf
