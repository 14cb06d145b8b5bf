#include "cli/ranks.h"

#include <algorithm>
#include <cstdlib>
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
    MpiRanks() { MPI_Init(nullptr, nullptr); }
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
    int ranks_on_host() const;

 private:
    static void broadcast(Bytes& bytes, int root);
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
