#include "mpi/mpi_ranks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>

#include <fmt/format.h>

namespace kerf {

namespace {

constexpr std::uint64_t has_left = ~std::uint64_t{0};

void finalise_mpi() {
    int is_finalised = 0;
    MPI_Finalized(&is_finalised);
    if (!is_finalised) MPI_Finalize();
}

// Only the first thread calls MPI, but cuts are made on others meanwhile. Where ranks end with an error, the launcher
// ends the others when the first of them has left: so they leave together, at the end of the process, when the one that
// speaks for them has spoken.
void initialise_mpi() {
    int is_initialised = 0, is_finalised = 0, provided = MPI_THREAD_SINGLE;
    check_mpi(MPI_Finalized(&is_finalised), "MPI_Finalized");
    if (is_finalised)
        throw Error(ErrorCode::internal,
                    "MPI has been finalised in this process, which cannot be undone. Use ranks "
                    "before that.");
    check_mpi(MPI_Initialized(&is_initialised), "MPI_Initialized");
    if (is_initialised)
        check_mpi(MPI_Query_thread(&provided), "MPI_Query_thread");
    else {
        check_mpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
        std::atexit(finalise_mpi);
    }
    if (provided >= MPI_THREAD_FUNNELED) return;
    throw Error(ErrorCode::internal,
                "The MPI library supports no program with threads (MPI_THREAD_FUNNELED). Use one that was built "
                "with threads, or run kerf without mpirun.");
}

// Calls pass(data, size) for pieces of the bytes, because MPI counts are 32-bit.
template <class Array, class Pass>
void for_pieces(Array& bytes, const Pass& pass) {
    constexpr std::size_t most = std::size_t{1} << 30;
    for (std::size_t first = 0; first < bytes.size(); first += most)
        pass(bytes.data() + first, static_cast<int>(std::min(most, bytes.size() - first)));
}

template <class Allocate>
bool has_room_for(const Allocate& allocate) {
    try {
        allocate();
    } catch (const std::bad_alloc&) {
        return false;
    }
    return true;
}

}  // namespace

void check_mpi(int result, const char* call) {
    if (result == MPI_SUCCESS) return;
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    MPI_Error_string(result, text.data(), &length);
    throw Error(ErrorCode::internal,
                fmt::format("{} has failed: {}. Check the hosts and their network.", call, text.data()));
}

// What a rank that leaves says to the others: of a size that needs no memory where there may be none.
struct MpiRanks::LastWords {
    std::int32_t code = 0;
    std::array<char, 1020> message{};
};

MpiRanks::MpiRanks(MPI_Comm comm) {
    initialise_mpi();
    check_mpi(MPI_Comm_dup(comm, &comm_), "MPI_Comm_dup");
    check_mpi(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    check_mpi(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
    check_mpi(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
    sent_to_.assign(static_cast<std::size_t>(size_), 0);
    sizes_.resize(sent_to_.size());
}

MpiRanks::~MpiRanks() { MPI_Comm_free(&comm_); }

MPI_Op MpiRanks::operation_of(Reduction reduction) {
    if (reduction == Reduction::sum) return MPI_SUM;
    return reduction == Reduction::smallest ? MPI_MIN : MPI_MAX;
}

// Every collective begins with a number of each rank: how much it brings, or that it has left.
void MpiRanks::begin_collective(std::uint64_t own_size) {
    check_mpi(MPI_Allgather(&own_size, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, comm_), "MPI_Allgather");
    if (std::find(sizes_.begin(), sizes_.end(), has_left) == sizes_.end()) return;
    LastWords words;
    end_together(words);
    throw Error(static_cast<ErrorCode>(words.code), words.message.data());
}

// The words of the first rank that has left, on all ranks; no message stays under way.
void MpiRanks::end_together(LastWords& words) {
    is_over_ = true;
    const auto speaker = std::find(sizes_.begin(), sizes_.end(), has_left) - sizes_.begin();
    check_mpi(MPI_Bcast(&words, sizeof words, MPI_BYTE, static_cast<int>(speaker), comm_), "MPI_Bcast");
    try {
        take_messages();
    } catch (const std::bad_alloc&) {
        MPI_Abort(comm_, words.code);
    }
}

void MpiRanks::leave(const StageStatus& why) {
    if (is_over_) return;
    LastWords words{why.code, {}};
    why.message.copy(words.message.data(), words.message.size() - 1);
    check_mpi(MPI_Allgather(&has_left, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, comm_), "MPI_Allgather");
    end_together(words);
}

// One broadcast per rank, once all of them have room for everything.
std::vector<Bytes> MpiRanks::all_gather(const Bytes& contribution) {
    begin_collective(contribution.size());
    std::vector<Bytes> all;
    require_room(has_room_for([&] {
        for (const std::uint64_t size : sizes_) all.emplace_back(size);
        all[static_cast<std::size_t>(rank_)] = contribution;
    }));
    for (std::size_t r = 0; r < all.size(); ++r) broadcast_bytes(all[r], static_cast<int>(r));
    return all;
}

// Out of memory on all ranks, if it is on one.
void MpiRanks::require_room(bool has_room) const {
    if (!all_reduce(std::int32_t{has_room}, Reduction::smallest)) throw std::bad_alloc();
}

void MpiRanks::broadcast_bytes(std::span<char> bytes, int root) const {
    for_pieces(bytes,
               [&](char* piece, int size) { check_mpi(MPI_Bcast(piece, size, MPI_BYTE, root, comm_), "MPI_Bcast"); });
}

Bytes MpiRanks::broadcast(Bytes of_root, int root) {
    begin_collective(of_root.size());
    require_room(has_room_for([&] {
        if (rank_ != root) of_root = Bytes(sizes_[static_cast<std::size_t>(root)]);
    }));
    broadcast_bytes(of_root, root);
    return of_root;
}

std::vector<Bytes> MpiRanks::exchange(std::vector<Bytes> to_rank) {
    begin_collective(0);
    std::vector<std::uint64_t> out, in(to_rank.size());
    for (const Bytes& bytes : to_rank) out.push_back(bytes.size());
    check_mpi(MPI_Alltoall(out.data(), 1, MPI_UINT64_T, in.data(), 1, MPI_UINT64_T, comm_), "MPI_Alltoall");
    std::vector<Bytes> got(to_rank.size());
    require_room(has_room_for([&] {
        for (std::size_t r = 0; r < got.size(); ++r) got[r].resize(static_cast<int>(r) == rank_ ? 0 : in[r]);
    }));
    got[static_cast<std::size_t>(rank_)] = std::move(to_rank[static_cast<std::size_t>(rank_)]);
    std::vector<MPI_Request> requests;
    for (int r = 0; r < size_; ++r) {
        if (r == rank_) continue;
        for_pieces(got[static_cast<std::size_t>(r)], [&](char* piece, int size) {
            check_mpi(MPI_Irecv(piece, size, MPI_BYTE, r, exchange_tag, comm_, &requests.emplace_back()), "MPI_Irecv");
        });
        for_pieces(to_rank[static_cast<std::size_t>(r)], [&](char* piece, int size) {
            check_mpi(MPI_Isend(piece, size, MPI_BYTE, r, exchange_tag, comm_, &requests.emplace_back()), "MPI_Isend");
        });
    }
    check_mpi(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    return got;
}

void MpiRanks::sum(std::span<std::uint64_t> words) {
    begin_collective(words.size());
    check_mpi(MPI_Allreduce(MPI_IN_PLACE, words.data(), static_cast<int>(words.size()), MPI_UINT64_T, MPI_SUM, comm_),
              "MPI_Allreduce");
}

void MpiRanks::send(int rank, const Bytes& message) {
    std::uint64_t size = message.size();
    check_mpi(MPI_Send(&size, 1, MPI_UINT64_T, rank, send_tag, comm_), "MPI_Send");
    for_pieces(message, [&](const char* piece, int piece_size) {
        check_mpi(MPI_Send(piece, piece_size, MPI_BYTE, rank, send_tag, comm_), "MPI_Send");
    });
}

Bytes MpiRanks::receive(int rank) {
    std::uint64_t size = 0;
    check_mpi(MPI_Recv(&size, 1, MPI_UINT64_T, rank, send_tag, comm_, MPI_STATUS_IGNORE), "MPI_Recv");
    Bytes message(size);
    for_pieces(message, [&](char* piece, int piece_size) {
        check_mpi(MPI_Recv(piece, piece_size, MPI_BYTE, rank, send_tag, comm_, MPI_STATUS_IGNORE), "MPI_Recv");
    });
    return message;
}

void MpiRanks::post(int rank, const Bytes& message) {
    posted_.remove_if([](Posted& posted) {
        int left = 0;
        check_mpi(MPI_Test(&posted.request, &left, MPI_STATUS_IGNORE), "MPI_Test");
        return left != 0;
    });
    Posted& posted = posted_.emplace_back(Posted{message});
    check_mpi(MPI_Isend(posted.message.data(), static_cast<int>(message.size()), MPI_BYTE, rank, post_tag, comm_,
                        &posted.request),
              "MPI_Isend");
    ++sent_to_[static_cast<std::size_t>(rank)];
}

Bytes MpiRanks::receive(const MPI_Status& announced) const {
    int size = 0;
    check_mpi(MPI_Get_count(&announced, MPI_BYTE, &size), "MPI_Get_count");
    Bytes message(static_cast<std::size_t>(size));
    check_mpi(MPI_Recv(message.data(), size, MPI_BYTE, announced.MPI_SOURCE, post_tag, comm_, MPI_STATUS_IGNORE),
              "MPI_Recv");
    return message;
}

std::optional<Bytes> MpiRanks::poll() {
    int arrived = 0;
    MPI_Status status;
    check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, post_tag, comm_, &arrived, &status), "MPI_Iprobe");
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
    check_mpi(MPI_Reduce_scatter_block(sent_to_.data(), &expected, 1, MPI_INT, MPI_SUM, comm_),
              "MPI_Reduce_scatter_block");
    for (; received_ < expected; ++received_) {
        MPI_Status status;
        check_mpi(MPI_Probe(MPI_ANY_SOURCE, post_tag, comm_, &status), "MPI_Probe");
        receive(status);
    }
    for (Posted& posted : posted_) check_mpi(MPI_Wait(&posted.request, MPI_STATUS_IGNORE), "MPI_Wait");
    posted_.clear();
    sent_to_.assign(sent_to_.size(), 0);
    received_ = 0;
}

std::vector<Bytes> MpiRanks::gather_on_host(const Bytes& contribution, std::size_t& own) const {
    MPI_Comm host = MPI_COMM_NULL;
    check_mpi(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host), "MPI_Comm_split_type");
    std::vector<Bytes> all;
    {
        MpiRanks on_host(host);
        own = static_cast<std::size_t>(on_host.rank());
        all = on_host.all_gather(contribution);
    }
    check_mpi(MPI_Comm_free(&host), "MPI_Comm_free");
    return all;
}

}  // namespace kerf
