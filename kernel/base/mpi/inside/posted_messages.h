// Messages that a rank posts to others without waiting for them.
#pragma once

#include <list>
#include <optional>
#include <vector>

#include <mpi.h>

#include "base/parallel/communicator.h"

namespace kerf {

/// Messages on their way, which MPI reads or writes until all requests are done.
struct OnTheWay {
    std::vector<Bytes> messages;
    std::vector<MPI_Request> requests;
};

/// Returns the messages whose ends nobody waits for any more. They live until the process ends, since MPI may read or
/// write them until then.
std::list<OnTheWay>& abandoned_messages();

/// The messages that a rank has posted, and those that were posted to it. They are counted by receiver, so that
/// drain() knows how many are still under way. Those that are on their way when the object ends are abandoned.
class PostedMessages {
 public:
    PostedMessages(MPI_Comm comm, int ranks);
    ~PostedMessages();
    PostedMessages(const PostedMessages&) = delete;
    PostedMessages& operator=(const PostedMessages&) = delete;

    void post(int rank, const Bytes& message);
    /// Returns a message that was posted to this rank; nothing if none has arrived yet.
    std::optional<Bytes> poll();
    /// Collective: takes all messages out of the way that were posted before and not polled.
    void drain();

 private:
    Bytes receive(const MPI_Status& announced);

    MPI_Comm comm_;
    std::list<OnTheWay> posted_;
    std::vector<int> sent_to_;  // messages to each rank since drain()
    int received_ = 0;
};

}  // namespace kerf
