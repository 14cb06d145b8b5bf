// The ranks of an MPI job, with sums and exchanges of values that are distributed over them. The only place of the
// kernel that calls MPI.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <mpi.h>

#include "base/core/ids.h"
#include "base/mpi/inside/posted_messages.h"
#include "base/parallel/communicator.h"

namespace kerf {

/// Throws Error(internal), with the name of the call and MPI's words for it, for a result that is no success.
void check_mpi(int result, const char* call);

template <class T>
MPI_Datatype mpi_type();
template <>
inline MPI_Datatype mpi_type<double>() {
    return MPI_DOUBLE;
}
template <>
inline MPI_Datatype mpi_type<long double>() {
    return MPI_LONG_DOUBLE;
}
template <>
inline MPI_Datatype mpi_type<std::int32_t>() {
    return MPI_INT32_T;
}
template <>
inline MPI_Datatype mpi_type<std::int64_t>() {
    return MPI_INT64_T;
}

enum class Reduction { sum, smallest, largest };

inline MPI_Op mpi_operation(Reduction reduction) {
    if (reduction == Reduction::sum) return MPI_SUM;
    return reduction == Reduction::smallest ? MPI_MIN : MPI_MAX;
}

/// Values for another rank, or from it.
template <class T>
struct RankValues {
    int rank = 0;
    std::vector<T> values;
};

/// The ranks of a communicator of MPI, of which a duplicate is used, so that no message of the program is taken for one
/// of the kernel's. Only the thread that makes the object may call it.
class MpiRanks : public Communicator {
 public:
    /// Collective. Without an argument the ranks are all processes that a launcher has started, or this one alone.
    /// Where the program has not initialised MPI, that is done here, and undone at the end of the process. Throws
    /// Error(internal) if MPI has been finalised, or does not allow the threads that a rank has beside its first. A
    /// failure to duplicate `comm` is handled as `comm` says.
    explicit MpiRanks(MPI_Comm comm = MPI_COMM_WORLD);
    /// Collective.
    ~MpiRanks() override;
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    std::vector<Bytes> all_gather(const Bytes& contribution) override;
    Bytes broadcast(Bytes of_root, int root) override;
    std::vector<Bytes> exchange(std::vector<Bytes> to_rank) override;
    void sum(std::span<std::uint64_t> words) override;
    void send(int rank, Bytes message) override;
    Bytes receive(int rank) override;
    std::optional<Bytes> receive_any() override;
    void post(int rank, const Bytes& message) override;
    std::optional<Bytes> poll() override;
    void drop_messages() override;
    void leave(const StageStatus& why) override;

    /// Collective: returns the contributions of the ranks of this host; `own` becomes the index of this one among them.
    std::vector<Bytes> gather_on_host(const Bytes& contribution, std::size_t& own) const;

    /// Collective, with as many values on every rank: replaces each value by its sum, least or largest over the ranks.
    template <class T>
    void all_reduce(std::span<T> values, Reduction reduction) const {
        check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), count_of(values), mpi_type<T>(), mpi_operation(reduction),
                                comm_),
                  "MPI_Allreduce");
    }
    template <class T>
    T all_reduce(T value, Reduction reduction) const {
        all_reduce(std::span(&value, 1), reduction);
        return value;
    }

    /// Sends the values of `out` to other ranks, and receives values into `in`, which names their senders and has room
    /// for them; each message must be named on both sides. O(values).
    template <class T>
    void exchange(const std::vector<RankValues<T>>& out, std::vector<RankValues<T>>& in) const {
        std::vector<MPI_Request> requests;
        for (RankValues<T>& from : in)
            check_mpi(MPI_Irecv(from.values.data(), count_of(from.values), mpi_type<T>(), from.rank, exchange_tag,
                                comm_, &requests.emplace_back()),
                      "MPI_Irecv");
        for (const RankValues<T>& to : out)
            check_mpi(MPI_Isend(to.values.data(), count_of(to.values), mpi_type<T>(), to.rank, exchange_tag, comm_,
                                &requests.emplace_back()),
                      "MPI_Isend");
        check_mpi(MPI_Waitall(count_of(requests), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    }

    /// Ends all ranks without their consent. Does not return.
    void end_all(int exit_code) const { MPI_Abort(comm_, exit_code); }

    /// The communicator, for libraries that call MPI themselves.
    MPI_Comm handle() const { return comm_; }

 private:
    static constexpr int exchange_tag = 1;  // PostedMessages has 0
    void begin_collective(std::uint64_t own_size);
    void end_together(const StageStatus& why);
    [[noreturn]] void throw_last_words() const;
    void end_if_one_has_left();
    class Transfer;
    void send(Transfer& transfer, int rank, int tag);
    void receive(Transfer& transfer, int rank, int tag);

    // The words of a rank that leaves to the others, of a fixed size: there may be no memory for more.
    struct LastWords {
        std::int32_t code = static_cast<std::int32_t>(ErrorCode::internal);
        std::array<char, 1020> message{};
    };
    MPI_Comm comm_;
    int rank_, size_;
    PostedMessages posted_;
    std::vector<std::uint64_t> sizes_;            // bytes that each rank brings to a collective
    std::vector<std::uint64_t> sent_, expected_;  // bytes to and from each rank in an exchange
    std::vector<MPI_Request> leaving_;            // messages to each rank that this one leaves
    bool is_over_ = false;                        // a rank has left
    LastWords last_words_;                        // with these words
};

}  // namespace kerf
