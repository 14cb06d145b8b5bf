#include "base/mpi/inside/posted_messages.h"

#include "base/core/ids.h"
#include "base/mpi/mpi_ranks.h"

namespace kerf {

namespace {

constexpr int post_tag = 0;

}  // namespace

std::list<OnTheWay>& abandoned_messages() {
    static auto* const all = new std::list<OnTheWay>;
    return *all;
}

PostedMessages::PostedMessages(MPI_Comm comm, int ranks) : comm_(comm), sent_to_(ranks, 0) {}

PostedMessages::~PostedMessages() { abandoned_messages().splice(abandoned_messages().end(), posted_); }

void PostedMessages::post(int rank, const Bytes& message) {
    posted_.remove_if([](OnTheWay& posted) {
        int left = 0;
        check_mpi(MPI_Test(posted.requests.data(), &left, MPI_STATUS_IGNORE), "MPI_Test");
        return left != 0;
    });
    OnTheWay& posted = posted_.emplace_back(OnTheWay{{message}, {MPI_REQUEST_NULL}});
    check_mpi(MPI_Isend(posted.messages.front().data(), count_of(message), MPI_BYTE, rank, post_tag, comm_,
                        posted.requests.data()),
              "MPI_Isend");
    ++sent_to_[rank];
}

Bytes PostedMessages::receive(const MPI_Status& announced) {
    int size = 0;
    check_mpi(MPI_Get_count(&announced, MPI_BYTE, &size), "MPI_Get_count");
    Bytes message(size);
    check_mpi(MPI_Recv(message.data(), size, MPI_BYTE, announced.MPI_SOURCE, post_tag, comm_, MPI_STATUS_IGNORE),
              "MPI_Recv");
    ++received_;
    return message;
}

std::optional<Bytes> PostedMessages::poll() {
    int arrived = 0;
    MPI_Status status;
    check_mpi(MPI_Iprobe(MPI_ANY_SOURCE, post_tag, comm_, &arrived, &status), "MPI_Iprobe");
    if (!arrived) return {};
    return receive(status);
}

void PostedMessages::drain() {
    int expected = 0;
    check_mpi(MPI_Reduce_scatter_block(sent_to_.data(), &expected, 1, MPI_INT, MPI_SUM, comm_),
              "MPI_Reduce_scatter_block");
    while (received_ < expected) {
        MPI_Status status;
        check_mpi(MPI_Probe(MPI_ANY_SOURCE, post_tag, comm_, &status), "MPI_Probe");
        receive(status);
    }
    for (OnTheWay& posted : posted_) check_mpi(MPI_Wait(posted.requests.data(), MPI_STATUS_IGNORE), "MPI_Wait");
    posted_.clear();
    sent_to_.assign(sent_to_.size(), 0);
    received_ = 0;
}

}  // namespace kerf
