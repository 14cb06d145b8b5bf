// What ranks do with each other, on a communicator of a program that has initialised MPI itself. It runs under mpirun,
// every test on all ranks together.
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/mpi/mpi_ranks.h"
#include "base/mpi/ownership.h"
#include "support/collective_laws.h"

namespace kerf {
namespace {

// What MPI does at messages of so many bytes; 0: of none.
struct Disturbance {
    int size = 0;
    bool meets_others_before = false;  // all ranks, before the message is sent or received
    bool fails_then = false;           // the next test whether it has left or arrived, and all later ones
    bool has_begun = false;
};
Disturbance disturbance;

int begun(int size, const auto& begin) {
    const bool is_meant = disturbance.size == size && size > 0;
    if (is_meant && disturbance.meets_others_before) PMPI_Barrier(MPI_COMM_WORLD);
    disturbance.has_begun |= is_meant;
    return begin();
}

}  // namespace
}  // namespace kerf

// In place of those of the library, which have a second name for that.
extern "C" int MPI_Isend(const void* data, int size, MPI_Datatype type, int to, int tag, MPI_Comm comm,
                         MPI_Request* request) {
    return kerf::begun(size, [&] { return PMPI_Isend(data, size, type, to, tag, comm, request); });
}
extern "C" int MPI_Irecv(void* data, int size, MPI_Datatype type, int from, int tag, MPI_Comm comm,
                         MPI_Request* request) {
    return kerf::begun(size, [&] { return PMPI_Irecv(data, size, type, from, tag, comm, request); });
}
extern "C" int MPI_Test(MPI_Request* request, int* is_over, MPI_Status* status) {
    if (kerf::disturbance.fails_then && kerf::disturbance.has_begun) return MPI_ERR_OTHER;
    return PMPI_Test(request, is_over, status);
}

namespace kerf {
namespace {

TEST(MpiRanks, ReduceValuesOfAllTypes) {
    const MpiRanks ranks;
    const int size = ranks.size();
    std::vector<double> values = {1, ranks.rank() + 0.5};
    ranks.all_reduce(std::span(values), Reduction::sum);
    EXPECT_EQ(values, (std::vector<double>{1.0 * size, 0.5 * size * size}));
    EXPECT_EQ(ranks.all_reduce(std::int32_t{ranks.rank()}, Reduction::largest), size - 1);
    EXPECT_EQ(ranks.all_reduce(std::int64_t{5} << 40 | ranks.rank(), Reduction::smallest), std::int64_t{5} << 40);
}

// Each tells the next one as many numbers as its own rank says.
TEST(MpiRanks, ExchangeWithNeighbours) {
    const MpiRanks ranks;
    const int size = ranks.size(), next = (ranks.rank() + 1) % size, before = (ranks.rank() + size - 1) % size;
    const auto values_of = [](int rank) { return std::vector<std::int64_t>(static_cast<std::size_t>(rank), rank); };
    const std::vector<RankValues<std::int64_t>> out = {{next, values_of(ranks.rank())}};
    std::vector<RankValues<std::int64_t>> in = {{before, std::vector<std::int64_t>(static_cast<std::size_t>(before))}};
    ranks.exchange(out, in);
    EXPECT_EQ(in[0].values, values_of(before));
}

// Each rank owns two items, and has ghosts of the first one of every other.
Ownership two_items_of_each(MpiRanks& ranks) {
    std::vector<std::int64_t> first_of_ranks = {0}, ghosts;
    for (int r = 0; r < ranks.size(); ++r) {
        if (r != ranks.rank()) ghosts.push_back(first_of_ranks.back());
        first_of_ranks.push_back(first_of_ranks.back() + 2);
    }
    return Ownership::of_numbers(ranks, first_of_ranks, ghosts);
}

TEST(Ownership, GhostsAndOwnersTellEachOtherTheirValues) {
    MpiRanks ranks;
    const Ownership items = two_items_of_each(ranks);
    const std::size_t others = static_cast<std::size_t>(ranks.size()) - 1;
    ASSERT_EQ(items.owned().size(), others);
    ASSERT_EQ(items.ghosts().size(), others);
    std::vector<std::int64_t> numbers(2 + others, -1);
    numbers[0] = 2 * ranks.rank();
    numbers[1] = numbers[0] + 1;
    items.from_owners(std::span(numbers), 1);
    for (std::size_t g = 0; g < others; ++g) {
        EXPECT_EQ(numbers[2 + g], 2 * items.ghosts()[g].rank);
        EXPECT_EQ(items.ghosts()[g].items, std::vector{static_cast<std::int32_t>(2 + g)});
        EXPECT_EQ(items.owned()[g].items, std::vector{0});
    }
    std::vector<double> pairs(2 * numbers.size(), 1);
    items.sum_to_owners(std::span(pairs), 2);
    EXPECT_EQ(pairs[0], ranks.size());
    EXPECT_EQ(pairs[1], ranks.size());
    EXPECT_EQ(pairs[2], 1) << "nobody has ghosts of the second item";
    std::vector<std::int32_t> least(numbers.size(), ranks.rank());
    items.smallest_over_ranks(std::span(least), 1);
    EXPECT_EQ(least[0], 0);
    EXPECT_EQ(least[1], ranks.rank());
}

TEST(Ownership, ListsAreOfAnyLengths) {
    MpiRanks ranks;
    const Ownership items = two_items_of_each(ranks);
    const auto own_rank_often = [&](const Ownership::Neighbour& neighbour) {
        return std::vector<std::int64_t>(static_cast<std::size_t>(neighbour.rank), ranks.rank());
    };
    const auto to_owners = items.lists_to_owners(own_rank_often), from_owners = items.lists_from_owners(own_rank_often);
    ASSERT_EQ(to_owners.size(), items.owned().size());
    ASSERT_EQ(from_owners.size(), items.ghosts().size());
    const auto length = static_cast<std::size_t>(ranks.rank());
    for (std::size_t r = 0; r < to_owners.size(); ++r) {
        EXPECT_EQ(to_owners[r], std::vector<std::int64_t>(length, items.owned()[r].rank));
        EXPECT_EQ(from_owners[r], std::vector<std::int64_t>(length, items.ghosts()[r].rank));
    }
}

// Without the items that get no number, neighbours without any are none.
TEST(Ownership, OfSomeItems) {
    MpiRanks ranks;
    const Ownership items = two_items_of_each(ranks);
    std::vector<std::int32_t> number(1 + static_cast<std::size_t>(ranks.size()), -1);
    EXPECT_TRUE(items.renumbered(number).owned().empty());
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<std::int32_t>(number.size() - 1 - i);
    const Ownership turned = items.renumbered(number);
    for (const Ownership::Neighbour& neighbour : turned.owned()) EXPECT_EQ(neighbour.items, std::vector{number[0]});
}

TEST(MpiRanks, GatherOnTheHost) {
    const MpiRanks ranks;
    std::size_t own = 0;
    const std::vector<Bytes> all = ranks.gather_on_host(to_bytes(ranks.rank()), own);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks.size())) << "all of them run here";
    EXPECT_EQ(from_bytes<int>(all[own]), ranks.rank());
}

TEST(MpiRanks, AreThoseOfTheCommunicatorThatIsGiven) {
    MpiRanks all;
    MPI_Comm half = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, all.rank() % 2, -all.rank(), &half);
    {
        MpiRanks ranks(half);
        EXPECT_EQ(ranks.size(), (all.size() + 1 - all.rank() % 2) / 2);
        const std::vector<int> gathered = all_gather(ranks, all.rank());
        EXPECT_EQ(gathered[static_cast<std::size_t>(ranks.rank())], all.rank());
        EXPECT_TRUE(std::is_sorted(gathered.rbegin(), gathered.rend())) << "in the order of that communicator";
    }
    MPI_Comm_free(&half);
    EXPECT_EQ(all.all_reduce(1, Reduction::sum), all.size()) << "the others go on";
}

TEST(MpiRanks, KeepThePromisesOfCollectives) {
    MpiRanks ranks;
    for (const std::size_t largest : {1, 9, 40'001, 300'007}) test::expect_collectives(ranks, largest);
    test::expect_sums(ranks);
    test::expect_exchanged_items(ranks);
    test::expect_posts(ranks);
}

// From one rank, more than one call gathers.
TEST(MpiRanks, GatherMoreThanAtOnce) {
    MpiRanks ranks;
    constexpr std::size_t large = (std::size_t{16} << 20) + 1;
    const std::vector<Bytes> all = ranks.all_gather(Bytes(ranks.rank() == 0 ? large : 3, 'a'));
    EXPECT_EQ(all.front(), Bytes(large, 'a'));
    EXPECT_EQ(all.back(), Bytes(ranks.size() > 1 ? 3 : large, 'a'));
}

TEST(MpiRanks, EndWhenOneOfThemLeaves) {
    MpiRanks all;
    if (all.size() == 1) return;
    for (const test::Waiting& waiting : test::ways_to_wait()) {
        MpiRanks ranks;
        test::expect_that_leaving_ends_all(ranks, waiting);
    }
    EXPECT_EQ(all.all_reduce(1, Reduction::sum), all.size()) << "these are other ones";
}

// A rank whose wait for a message fails goes on, and has its memory for other things, when the message is passed on: it
// arrives as it was sent, and nowhere else.
TEST(MpiRanks, LeaveTheMemoryOfAMessageAloneWhoseWaitHasFailed) {
    constexpr std::size_t size = std::size_t{96} << 10;  // beyond what MPI copies before it is received
    constexpr int sender = 0, receiver = 1;
    const auto other_things = [] { return std::vector<Bytes>(3, Bytes(size, 'x')); };
    MpiRanks ranks;
    if (ranks.size() == 1) return;
    for (const int failing : {sender, receiver}) {
        SCOPED_TRACE(failing);
        const bool fails = ranks.rank() == failing;
        disturbance = {static_cast<int>(size), !fails, fails};
        Bytes received;
        const auto pass_on = [&] {
            if (ranks.rank() == sender) ranks.send(receiver, test::words_of(sender, receiver, size));
            if (ranks.rank() == receiver) received = ranks.receive(sender);
        };
        std::vector<Bytes> things;
        if (fails) {
            EXPECT_THROW(pass_on(), Error);
            things = other_things();
        } else if (ranks.rank() == sender || ranks.rank() == receiver) {
            pass_on();
        }
        disturbance = {};
        if (fails || ranks.rank() > receiver) PMPI_Barrier(MPI_COMM_WORLD);
        MPI_Barrier(MPI_COMM_WORLD);
        if (fails) {
            EXPECT_TRUE(things == other_things());
        } else if (ranks.rank() == receiver) {
            EXPECT_TRUE(received == test::words_of(sender, receiver, size));
        }
    }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose maps are larger than any limit
// So much of the address space beyond what is in use may be used as long as this lives.
class MemoryLimit {
 public:
    explicit MemoryLimit(std::uint64_t bytes) {
        getrlimit(RLIMIT_AS, &before_);
        std::uint64_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit limit{pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes, before_.rlim_max};
        setrlimit(RLIMIT_AS, &limit);
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
    rlimit before_{};
};

// One that has no room for what the others have: an error on all of them, which are in step afterwards.
TEST(MpiRanks, AreAllOutOfMemoryIfOneIs) {
    constexpr std::size_t room = std::size_t{16} << 20, large = std::size_t{48} << 20;
    MpiRanks ranks;
    if (ranks.size() == 1) return;
    const bool is_last = ranks.rank() == ranks.size() - 1;
    const auto expect_no_room = [&](const char* call, const auto& collective) {
        std::optional<MemoryLimit> limit;
        if (is_last) limit.emplace(room);
        EXPECT_THROW(collective(), std::bad_alloc) << call;
    };
    const Bytes message(ranks.rank() == 0 ? large : 1);
    std::vector<Bytes> to_rank(static_cast<std::size_t>(ranks.size()));
    if (ranks.rank() == 0) to_rank.back() = message;
    expect_no_room("all_gather", [&] { ranks.all_gather(message); });
    expect_no_room("broadcast", [&] { ranks.broadcast(message, 0); });
    expect_no_room("exchange", [&] { ranks.exchange(to_rank); });
    if (ranks.rank() == 0) ranks.send(ranks.size() - 1, message);
    if (is_last) expect_no_room("receive", [&] { ranks.receive(0); });
    test::expect_collectives(ranks, 1000);
}
#endif

// The program's own message must not be taken for one of ours, nor the other way round.
TEST(MpiRanks, LeaveTheMessagesOfTheProgramAlone) {
    MpiRanks ranks;
    const int other = ranks.rank() ^ 1;
    const bool has_other = other < ranks.size();
    int sent = ranks.rank(), received = -1;
    MPI_Request request = MPI_REQUEST_NULL;
    if (has_other) {
        MPI_Isend(&sent, 1, MPI_INT, other, 0, MPI_COMM_WORLD, &request);
        ranks.post(other, to_bytes(100 + ranks.rank()));
        std::optional<Bytes> polled;
        while (!polled) polled = ranks.poll();
        EXPECT_EQ(from_bytes<int>(*polled), 100 + other);
        MPI_Recv(&received, 1, MPI_INT, other, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        EXPECT_EQ(received, other);
        MPI_Wait(&request, MPI_STATUS_IGNORE);
    }
    ranks.drop_messages();
}

TEST(MpiRanks, AFailedCallIsAnErrorThatNamesIt) {
    MpiRanks ranks;
    try {
        ranks.post(ranks.size(), to_bytes(1));
        ADD_FAILURE() << "there is no such rank";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::internal);
        EXPECT_NE(std::string(error.what()).find("MPI_Isend has failed"), std::string::npos) << error.what();
    }
}

TEST(MpiRanks, DoNotEndTheMpiOfTheProgram) {
    { const MpiRanks ranks; }
    int is_finalised = 1;
    MPI_Finalized(&is_finalised);
    EXPECT_FALSE(is_finalised);
}

}  // namespace
}  // namespace kerf

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    const int failed = RUN_ALL_TESTS();
    MPI_Finalize();
    return failed;
}
