// Messages and collectives in which no rank waits for one that has left with an error. Every collective begins with a
// number from each rank, the bytes that it brings or `has_left` (`begin_collective()`); if a rank has left, all take
// part in its last broadcast, of its error, which later calls that wait or look for messages throw. A rank that waits
// outside of a collective looks for a message with the tag `leave_tag` beside its own, and then joins that broadcast.
// Room for a result is taken before data moves, and ranks agree on whether all have it, so that std::bad_alloc is
// thrown on all or none. Counts of MPI have 32 bits: longer messages go in pieces.
#include "base/mpi/mpi_ranks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>

#include <fmt/format.h>

#include "base/parallel/failure_deadline.h"
#include "base/parallel/patience.h"

namespace kerf {

namespace {

constexpr std::uint64_t has_left = ~std::uint64_t{0};
// Tags beside those of exchanges and of posted messages.
constexpr int send_tag = 2, leave_tag = 3, answer_tag = 4;

void finalise_mpi() {
    int is_finalised = 0;
    MPI_Finalized(&is_finalised);
    if (!is_finalised) MPI_Finalize();
}

// Initialises MPI for threads of which only the first calls it: cuts are made on others meanwhile. Where ranks end with
// an error, the launcher ends the others when the first of them has left: so they leave together, at the end of the
// process, when the one that speaks for them has spoken.
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

MPI_Comm duplicate_of(MPI_Comm comm) {
    initialise_mpi();
    MPI_Comm duplicate = MPI_COMM_NULL;
    check_mpi(MPI_Comm_dup(comm, &duplicate), "MPI_Comm_dup");
    check_mpi(MPI_Comm_set_errhandler(duplicate, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    return duplicate;
}

int rank_in(MPI_Comm comm) {
    int rank = 0;
    check_mpi(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
    return rank;
}

int size_of(MPI_Comm comm) {
    int size = 1;
    check_mpi(MPI_Comm_size(comm, &size), "MPI_Comm_size");
    return size;
}

// Bytes of the largest piece of a message, since MPI's counts are 32-bit.
constexpr std::size_t most_of_piece = std::size_t{1} << 30;

// Calls pass(data, size) for pieces of the items.
template <class Array, class Pass>
void for_pieces(Array& items, const Pass& pass) {
    for (std::size_t first = 0; first < items.size(); first += most_of_piece)
        pass(items.data() + first, std::min(most_of_piece, items.size() - first));
}

std::size_t count_pieces(std::uint64_t bytes) { return (bytes + most_of_piece - 1) / most_of_piece; }

// The most bytes that are gathered by one call, with a copy of them all.
constexpr std::uint64_t most_of_one_call = std::uint64_t{1} << 24;

template <class Allocate>
bool has_room_for(const Allocate& allocate) {
    try {
        allocate();
    } catch (const std::bad_alloc&) {
        return false;
    }
    return true;
}

// Takes room on every rank. Throws std::bad_alloc on all ranks if one has none.
template <class Allocate>
void take_room(const MpiRanks& ranks, const Allocate& allocate) {
    if (!ranks.all_reduce(std::int32_t{has_room_for(allocate)}, Reduction::smallest)) throw std::bad_alloc();
}

void broadcast_bytes(std::span<char> bytes, int root, MPI_Comm comm) {
    for_pieces(bytes,
               [&](char* piece, int size) { check_mpi(MPI_Bcast(piece, size, MPI_BYTE, root, comm), "MPI_Bcast"); });
}

// Returns true when the message has left or arrived, false when a rank has left. Who waits for long leaves the
// processor to others.
bool is_done(MPI_Request& request, MPI_Comm comm) {
    int is_over = 0, has_rank_left = 0;
    for (Patience patience;; patience.pause()) {
        check_mpi(MPI_Test(&request, &is_over, MPI_STATUS_IGNORE), "MPI_Test");
        if (is_over) return true;
        check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, leave_tag, comm, &has_rank_left, MPI_STATUS_IGNORE), "MPI_Iprobe");
        if (has_rank_left) return false;
    }
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

// Messages of this rank while MPI sends or receives them. Those that are on their way when the object ends, because an
// error has ended the wait for them, are abandoned. All memory for that is there before the first of them leaves.
class MpiRanks::Transfer {
 public:
    explicit Transfer(std::vector<Bytes> messages, std::size_t most_requests) : own_(1) {
        own_.front().messages = std::move(messages);
        own_.front().requests.reserve(most_requests);
    }
    explicit Transfer(Bytes message) : own_(1) {
        own_.front().messages.push_back(std::move(message));
        own_.front().requests.reserve(1);
    }
    Transfer(const Transfer&) = delete;
    Transfer& operator=(const Transfer&) = delete;
    ~Transfer() {
        const std::vector<MPI_Request>& all = requests();
        if (std::any_of(all.begin(), all.end(), [](MPI_Request request) { return request != MPI_REQUEST_NULL; }))
            abandoned_.splice(abandoned_.end(), own_);
    }

    std::vector<Bytes>& messages() { return own_.front().messages; }
    Bytes& message() { return messages().front(); }
    std::vector<MPI_Request>& requests() { return own_.front().requests; }
    MPI_Request& new_request() { return requests().emplace_back(MPI_REQUEST_NULL); }
    void wait_for_all() {
        check_mpi(MPI_Waitall(count_of(requests()), requests().data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    }

 private:
    std::list<OnTheWay> own_;
    std::list<OnTheWay>& abandoned_ = abandoned_messages();
};

MpiRanks::MpiRanks(MPI_Comm comm)
    : comm_(duplicate_of(comm)), rank_(rank_in(comm_)), size_(size_of(comm_)), posted_(comm_, size_) {
    for (auto* of_ranks : {&sizes_, &sent_, &expected_}) of_ranks->resize(size_);
    leaving_.assign(size_, MPI_REQUEST_NULL);
}

MpiRanks::~MpiRanks() { MPI_Comm_free(&comm_); }

// Begins a collective with a number of each rank: the bytes that it brings, or that it has left.
void MpiRanks::begin_collective(std::uint64_t own_size) {
    if (is_over_) throw_last_words();
    check_mpi(MPI_Allgather(&own_size, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, comm_), "MPI_Allgather");
    if (std::find(sizes_.begin(), sizes_.end(), has_left) == sizes_.end()) return;
    end_together({});
    throw_last_words();
}

void MpiRanks::throw_last_words() const {
    throw RankHasLeft(static_cast<ErrorCode>(last_words_.code), last_words_.message.data());
}

// Takes the words of the first rank that has left, on all ranks; no posted message stays under way.
void MpiRanks::end_together(const StageStatus& why) {
    is_over_ = true;
    if (why.code != 0) last_words_.code = why.code;
    why.message.copy(last_words_.message.data(), last_words_.message.size() - 1);
    const int speaker = std::find(sizes_.begin(), sizes_.end(), has_left) - sizes_.begin();
    check_mpi(MPI_Bcast(&last_words_, sizeof last_words_, MPI_BYTE, speaker, comm_), "MPI_Bcast");
    for (int r = 0; r < size_; ++r)
        if (r != rank_ && sizes_[r] == has_left)
            check_mpi(MPI_Recv(nullptr, 0, MPI_BYTE, r, leave_tag, comm_, MPI_STATUS_IGNORE), "MPI_Recv");
    check_mpi(MPI_Waitall(size_, leaving_.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    try {
        posted_.drain();
    } catch (const std::bad_alloc&) {
        MPI_Abort(comm_, last_words_.code);
    }
}

// Tells the others by messages, too: a rank that waits for another one, not in a collective, learns of it by one.
void MpiRanks::leave(const StageStatus& why) {
    if (is_over_) return;
    const FailureDeadline deadline(why.code, why.message);
    for (int r = 0; r < size_; ++r)
        if (r != rank_) check_mpi(MPI_Isend(nullptr, 0, MPI_BYTE, r, leave_tag, comm_, &leaving_[r]), "MPI_Isend");
    check_mpi(MPI_Allgather(&has_left, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, comm_), "MPI_Allgather");
    end_together(why);
}

std::vector<Bytes> MpiRanks::all_gather(const Bytes& contribution) {
    begin_collective(contribution.size());
    std::uint64_t total = 0;
    for (const std::uint64_t size : sizes_) total += size;
    const bool is_one_call = total <= most_of_one_call;
    std::vector<Bytes> all;
    Bytes together;
    std::vector<int> sizes, starts;
    take_room(*this, [&] {
        for (const std::uint64_t size : sizes_) {
            starts.push_back(starts.empty() ? 0 : starts.back() + sizes.back());
            sizes.push_back(is_one_call ? size : 0);
            all.emplace_back(size);
        }
        if (is_one_call) together.resize(total);
        all[rank_] = contribution;
    });
    if (is_one_call)
        check_mpi(MPI_Allgatherv(contribution.data(), count_of(contribution), MPI_BYTE, together.data(), sizes.data(),
                                 starts.data(), MPI_BYTE, comm_),
                  "MPI_Allgatherv");
    for (std::size_t r = 0; r < all.size(); ++r)
        if (is_one_call)
            std::copy_n(together.begin() + starts[r], sizes[r], all[r].begin());
        else
            broadcast_bytes(all[r], r, comm_);
    return all;
}

Bytes MpiRanks::broadcast(Bytes of_root, int root) {
    begin_collective(of_root.size());
    take_room(*this, [&] {
        if (rank_ != root) of_root = Bytes(sizes_[root]);
    });
    broadcast_bytes(of_root, root, comm_);
    return of_root;
}

std::vector<Bytes> MpiRanks::exchange(std::vector<Bytes> to_rank) {
    begin_collective(0);
    for (int r = 0; r < size_; ++r) sent_[r] = r == rank_ ? 0 : to_rank[r].size();
    check_mpi(MPI_Alltoall(sent_.data(), 1, MPI_UINT64_T, expected_.data(), 1, MPI_UINT64_T, comm_), "MPI_Alltoall");
    std::optional<Transfer> sent, got;
    take_room(*this, [&] {
        std::vector<Bytes> from_rank;
        std::size_t pieces_sent = 0, pieces_expected = 0;
        for (std::size_t r = 0; r < sent_.size(); ++r) {
            from_rank.emplace_back(expected_[r]);
            pieces_sent += count_pieces(sent_[r]);
            pieces_expected += count_pieces(expected_[r]);
        }
        sent.emplace(std::move(to_rank), pieces_sent);
        got.emplace(std::move(from_rank), pieces_expected);
    });
    got->messages()[rank_] = std::move(sent->messages()[rank_]);
    for (int step = 1; step < size_; ++step) {  // each rank begins with another one
        const int r = (rank_ + step) % size_;
        for_pieces(got->messages()[r], [&](char* piece, int size) {
            check_mpi(MPI_Irecv(piece, size, MPI_BYTE, r, exchange_tag, comm_, &got->new_request()), "MPI_Irecv");
        });
        for_pieces(sent->messages()[r], [&](char* piece, int size) {
            check_mpi(MPI_Isend(piece, size, MPI_BYTE, r, exchange_tag, comm_, &sent->new_request()), "MPI_Isend");
        });
    }
    got->wait_for_all();
    sent->wait_for_all();
    return std::move(got->messages());
}

void MpiRanks::sum(std::span<std::uint64_t> words) {
    begin_collective(0);
    for_pieces(words, [&](std::uint64_t* piece, int count) {
        check_mpi(MPI_Allreduce(MPI_IN_PLACE, piece, count, MPI_UINT64_T, MPI_SUM, comm_), "MPI_Allreduce");
    });
}

// Sends the message of `transfer`, piece by piece; receive() receives into it. A message that nobody receives any more
// cannot be called back.
void MpiRanks::send(Transfer& transfer, int rank, int tag) {
    for_pieces(transfer.message(), [&](char* piece, int size) {
        transfer.requests().clear();
        MPI_Request& request = transfer.new_request();
        check_mpi(MPI_Isend(piece, size, MPI_BYTE, rank, tag, comm_, &request), "MPI_Isend");
        if (!is_done(request, comm_)) begin_collective(0);  // throws, when nobody receives any more
    });
}

void MpiRanks::receive(Transfer& transfer, int rank, int tag) {
    for_pieces(transfer.message(), [&](char* piece, int size) {
        transfer.requests().clear();
        MPI_Request& request = transfer.new_request();
        check_mpi(MPI_Irecv(piece, size, MPI_BYTE, rank, tag, comm_, &request), "MPI_Irecv");
        if (is_done(request, comm_)) return;
        check_mpi(MPI_Cancel(&request), "MPI_Cancel");
        check_mpi(MPI_Wait(&request, MPI_STATUS_IGNORE), "MPI_Wait");
        begin_collective(0);  // throws
    });
}

// Sends the size first; the receiver answers whether it has room.
void MpiRanks::send(int rank, Bytes message) {
    if (is_over_) throw_last_words();
    Transfer size(to_bytes(std::uint64_t{message.size()})), has_room(Bytes(sizeof(std::int32_t)));
    Transfer whole(std::move(message));
    send(size, rank, send_tag);
    receive(has_room, rank, answer_tag);
    if (from_bytes<std::int32_t>(has_room.message())) send(whole, rank, send_tag);
}

Bytes MpiRanks::receive(int rank) {
    if (is_over_) throw_last_words();
    Transfer size(Bytes(sizeof(std::uint64_t))), yes(to_bytes(std::int32_t{1})), no(to_bytes(std::int32_t{0}));
    receive(size, rank, send_tag);
    std::optional<Transfer> whole;
    const bool has_room = has_room_for([&] { whole.emplace(Bytes(from_bytes<std::uint64_t>(size.message()))); });
    send(has_room ? yes : no, rank, answer_tag);
    if (!has_room) throw std::bad_alloc();
    receive(*whole, rank, send_tag);
    return std::move(whole->message());
}

// Throws if a rank has left, for callers that look for messages that never come then.
void MpiRanks::end_if_one_has_left() {
    int has_rank_left = is_over_;
    if (!is_over_)
        check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, leave_tag, comm_, &has_rank_left, MPI_STATUS_IGNORE), "MPI_Iprobe");
    if (has_rank_left) begin_collective(0);  // throws
}

std::optional<Bytes> MpiRanks::receive_any() {
    int arrived = 0;
    MPI_Status status;
    check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, send_tag, comm_, &arrived, &status), "MPI_Iprobe");
    if (arrived) return receive(status.MPI_SOURCE);
    end_if_one_has_left();
    return {};
}

void MpiRanks::post(int rank, const Bytes& message) {
    if (is_over_) return;
    posted_.post(rank, message);
}

std::optional<Bytes> MpiRanks::poll() {
    std::optional<Bytes> message = posted_.poll();
    if (!message) end_if_one_has_left();
    return message;
}

void MpiRanks::drop_messages() {
    if (is_over_) return;
    begin_collective(0);
    posted_.drain();
}

std::vector<Bytes> MpiRanks::gather_on_host(const Bytes& contribution, std::size_t& own) const {
    MPI_Comm host = MPI_COMM_NULL;
    check_mpi(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host), "MPI_Comm_split_type");
    std::vector<Bytes> all;
    {
        MpiRanks on_host(host);
        own = on_host.rank();
        all = on_host.all_gather(contribution);
    }
    check_mpi(MPI_Comm_free(&host), "MPI_Comm_free");
    return all;
}

}  // namespace kerf
