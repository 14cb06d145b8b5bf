#include "cli/ranks.h"

#include <algorithm>
#include <cstdlib>
#include <list>
#include <thread>

#ifdef KERF_WITH_MPI
#include <mpi.h>
#endif

namespace kerf {

namespace {

int host_cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

#ifdef KERF_WITH_MPI

class MpiRanks : public Communicator {
 public:
    MpiRanks() {
        MPI_Init(nullptr, nullptr);
        sent_to_.assign(static_cast<std::size_t>(size()), 0);
    }
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
    int ranks_on_host() const;

 private:
    static void broadcast(Bytes& bytes, int root);
    static Bytes receive(const MPI_Status& announced);

    // A message on its way, which MPI reads until it has left.
    struct Posted {
        Bytes message;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::list<Posted> posted_;
    std::vector<int> sent_to_;  // messages to each rank since drop_messages()
    int received_ = 0;
};

// One broadcast per rank, in pieces, because MPI counts are 32-bit.
std::vector<Bytes> MpiRanks::all_gather(const Bytes& contribution) {
    const std::uint64_t own = contribution.size();
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(size()));
    MPI_Allgather(&own, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
    std::vector<Bytes> all;
    for (int r = 0; r < size(); ++r) {
        all.push_back(r == rank() ? contribution : Bytes(sizes[static_cast<std::size_t>(r)]));
        broadcast(all.back(), r);
    }
    return all;
}

void MpiRanks::broadcast(Bytes& bytes, int root) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    for (std::size_t begin = 0; begin < bytes.size(); begin += piece)
        MPI_Bcast(bytes.data() + begin, static_cast<int>(std::min(piece, bytes.size() - begin)), MPI_BYTE, root,
                  MPI_COMM_WORLD);
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

int MpiRanks::ranks_on_host() const {
    MPI_Comm host = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    int count = 1;
    MPI_Comm_size(host, &count);
    MPI_Comm_free(&host);
    return count;
}

bool started_by_launcher() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
        if (std::getenv(name)) return true;
    return false;
}

#endif

}  // namespace

bool is_first_rank() {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (const char* rank = std::getenv(name)) return std::atoi(rank) == 0;
    return true;
}

Ranks join_ranks() {
#ifdef KERF_WITH_MPI
    if (started_by_launcher()) {
        auto ranks = std::make_unique<MpiRanks>();
        const int cores = std::max(1, host_cores() / ranks->ranks_on_host());
        return {std::move(ranks), cores};
    }
#endif
    return {std::make_unique<SingleRank>(), host_cores()};
}

}  // namespace kerf
