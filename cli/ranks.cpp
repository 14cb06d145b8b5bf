#include "cli/ranks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <list>
#include <new>

#include <fmt/format.h>

#include "cli/own_ranks.h"
#include "parallel/processors.h"

#ifdef KERF_WITH_MPI
#include <unistd.h>

#include <mpi.h>
#endif

namespace kerf {

namespace {

// All of the machine where the system tells of none.
int count_of(const std::vector<int>& processors) {
    return processors.empty() ? machine_processors() : static_cast<int>(processors.size());
}

#ifdef KERF_WITH_MPI

// In pieces, because MPI counts are 32-bit.
void broadcast(MPI_Comm comm, Bytes& bytes, int root) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    for (std::size_t begin = 0; begin < bytes.size(); begin += piece)
        MPI_Bcast(bytes.data() + begin, static_cast<int>(std::min(piece, bytes.size() - begin)), MPI_BYTE, root, comm);
}

// One broadcast per rank, once all of them have room for everything.
std::vector<Bytes> gather(MPI_Comm comm, const Bytes& contribution, const std::vector<std::uint64_t>& sizes) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    std::vector<Bytes> all;
    int has_room = 1;
    try {
        for (const std::uint64_t size : sizes) all.emplace_back(size);
        all[static_cast<std::size_t>(rank)] = contribution;
    } catch (const std::bad_alloc&) {
        has_room = 0;
        all.clear();
    }
    MPI_Allreduce(MPI_IN_PLACE, &has_room, 1, MPI_INT, MPI_MIN, comm);
    if (!has_room) throw std::bad_alloc();
    for (std::size_t r = 0; r < all.size(); ++r) broadcast(comm, all[r], static_cast<int>(r));
    return all;
}

constexpr std::uint64_t has_left = ~std::uint64_t{0};

// What a rank that leaves says to the others: of a size that needs no memory where there may be none.
struct LastWords {
    std::int32_t code = 0;
    std::array<char, 1020> message{};
};

class MpiRanks : public Communicator {
 public:
    MpiRanks();
    ~MpiRanks() override { MPI_Finalize(); }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int rank() const override {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        return rank;
    }
    int size() const override {
        int size = 1;
        MPI_Comm_size(MPI_COMM_WORLD, &size);
        return size;
    }
    std::vector<Bytes> all_gather(const Bytes& contribution) override;
    void post(int rank, const Bytes& message) override;
    std::optional<Bytes> poll() override;
    void drop_messages() override;
    void leave(const StageStatus& why) override;
    /// Collective: what the ranks of this host contribute, and which of them this one is.
    std::vector<Bytes> gather_on_host(const Bytes& contribution, std::size_t& own) const;

 private:
    static Bytes receive(const MPI_Status& announced);
    void begin_collective(std::uint64_t own_size);
    void end_together(LastWords& words);
    void take_messages();

    // A message on its way, which MPI reads until it has left.
    struct Posted {
        Bytes message;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::list<Posted> posted_;
    std::vector<int> sent_to_;  // messages to each rank since drop_messages()
    int received_ = 0;
    std::vector<std::uint64_t> sizes_;  // of what the ranks bring to a collective
    bool is_over_ = false;              // a rank has left
};

// Only the first thread calls MPI, but cuts are made on others meanwhile.
MpiRanks::MpiRanks() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
        MPI_Finalize();
        throw Error(ErrorCode::internal,
                    "The MPI library supports no program with threads (MPI_THREAD_FUNNELED). Use one that was built "
                    "with threads, or run kerf without mpirun.");
    }
    sent_to_.assign(static_cast<std::size_t>(size()), 0);
    sizes_.resize(sent_to_.size());
}

// Every collective begins with a number of each rank: how much it brings, or that it has left.
void MpiRanks::begin_collective(std::uint64_t own_size) {
    MPI_Allgather(&own_size, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    if (std::find(sizes_.begin(), sizes_.end(), has_left) == sizes_.end()) return;
    LastWords words;
    end_together(words);
    throw Error(static_cast<ErrorCode>(words.code), words.message.data());
}

// The words of the first rank that has left, on all ranks; no message stays under way.
void MpiRanks::end_together(LastWords& words) {
    is_over_ = true;
    const auto speaker = std::find(sizes_.begin(), sizes_.end(), has_left) - sizes_.begin();
    MPI_Bcast(&words, sizeof words, MPI_BYTE, static_cast<int>(speaker), MPI_COMM_WORLD);
    try {
        take_messages();
    } catch (const std::bad_alloc&) {
        MPI_Abort(MPI_COMM_WORLD, words.code);
    }
}

void MpiRanks::leave(const StageStatus& why) {
    if (is_over_) return;
    LastWords words{why.code, {}};
    why.message.copy(words.message.data(), words.message.size() - 1);
    MPI_Allgather(&has_left, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    end_together(words);
}

std::vector<Bytes> MpiRanks::all_gather(const Bytes& contribution) {
    begin_collective(contribution.size());
    return gather(MPI_COMM_WORLD, contribution, sizes_);
}

void MpiRanks::post(int rank, const Bytes& message) {
    posted_.remove_if([](Posted& posted) {
        int left = 0;
        MPI_Test(&posted.request, &left, MPI_STATUS_IGNORE);
        return left != 0;
    });
    Posted& posted = posted_.emplace_back(Posted{message});
    MPI_Isend(posted.message.data(), static_cast<int>(message.size()), MPI_BYTE, rank, 0, MPI_COMM_WORLD,
              &posted.request);
    ++sent_to_[static_cast<std::size_t>(rank)];
}

Bytes MpiRanks::receive(const MPI_Status& announced) {
    int size = 0;
    MPI_Get_count(&announced, MPI_BYTE, &size);
    Bytes message(static_cast<std::size_t>(size));
    MPI_Recv(message.data(), size, MPI_BYTE, announced.MPI_SOURCE, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

std::optional<Bytes> MpiRanks::poll() {
    int arrived = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &arrived, &status);
    if (!arrived) return {};
    ++received_;
    return receive(status);
}

void MpiRanks::drop_messages() {
    if (is_over_) return;
    begin_collective(0);
    take_messages();
}

void MpiRanks::take_messages() {
    int expected = 0;
    MPI_Reduce_scatter_block(sent_to_.data(), &expected, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    for (; received_ < expected; ++received_) {
        MPI_Status status;
        MPI_Probe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &status);
        receive(status);
    }
    for (Posted& posted : posted_) MPI_Wait(&posted.request, MPI_STATUS_IGNORE);
    posted_.clear();
    sent_to_.assign(sent_to_.size(), 0);
    received_ = 0;
}

std::vector<Bytes> MpiRanks::gather_on_host(const Bytes& contribution, std::size_t& own) const {
    MPI_Comm host = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    int rank = 0;
    MPI_Comm_rank(host, &rank);
    own = static_cast<std::size_t>(rank);
    int size = 1;
    MPI_Comm_size(host, &size);
    const std::uint64_t bytes = contribution.size();
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size));
    MPI_Allgather(&bytes, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, host);
    std::vector<Bytes> all = gather(host, contribution, sizes);
    MPI_Comm_free(&host);
    return all;
}

// What the launcher may use itself is what it could have given to its ranks: not all of the machine within the limits
// of a batch system. Where a shell lies between, that is bound like the rank, and nothing is known.
Ranks join_mpi_ranks() {
    auto ranks = std::make_unique<MpiRanks>();
    Ranks joined;
    joined.launched = true;
    std::size_t own = 0;
    std::vector<std::vector<int>> allowed;
    for (const Bytes& bytes : ranks->gather_on_host(to_bytes(allowed_processors()), own))
        allowed.push_back(from_bytes<std::vector<int>>(bytes));
    joined.cores_of_rank = share_of_processors(allowed, own);
    joined.unbound_share = count_of(allowed_processors(::getppid())) / static_cast<int>(allowed.size());
    joined.bound_to = count_of(allowed[own]);
    for (const int processors : all_gather(*ranks, joined.bound_to))
        joined.bound_to = std::min(joined.bound_to, processors);
    joined.communicator = std::move(ranks);
    return joined;
}

#endif

}  // namespace

bool is_first_rank() {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (const char* rank = std::getenv(name)) return std::atoi(rank) == 0;
    return true;
}

Ranks join_ranks([[maybe_unused]] MpiUse use) {
#ifdef KERF_WITH_MPI
    if (use == MpiUse::always || is_launched()) return join_mpi_ranks();
#endif
    const int cores = count_of(allowed_processors());
    return {std::make_unique<SingleRank>(), cores, cores, cores};
}

std::string binding_note(const Ranks& ranks, int workers) {
    const int machine = machine_processors();
    if (workers > ranks.bound_to && machine > ranks.bound_to)
        return fmt::format("The {} workers of a rank share {} of {} processors, because {}", workers, ranks.bound_to,
                           machine,
                           ranks.launched ? "mpirun has bound it to them; mpirun --bind-to none lifts that."
                                          : "taskset or a batch system has bound it to them.");
    if (workers == 0 && ranks.unbound_share > ranks.bound_to)
        return fmt::format(
            "mpirun has bound a rank to {} processor{}, so that it has no more workers; mpirun "
            "--bind-to none gives it {}.",
            ranks.bound_to, ranks.bound_to == 1 ? "" : "s", ranks.unbound_share);
    return "";
}

}  // namespace kerf
