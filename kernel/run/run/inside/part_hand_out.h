// The parts of a run, handed out to the ranks by the root rank.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/parallel/communicator.h"
#include "run/report/report.h"
#include "run/work/part_tickets.h"

namespace kerf {

/// A message that ranks post to each other while they mesh.
struct VolumeMessage {
    enum class Kind : char { wish, assignment, part_done, all_done, stop };
    Kind kind = Kind::stop;
    /// Number of the rank that wishes for a part, or place of the part that is assigned, -1 for none.
    std::int32_t number = -1;
    std::vector<PartReport> part;  ///< the part that is done; empty in messages of another kind

    template <class Archive>
    void archive(Archive& a) {
        a(kind, number, part);
    }
};

/// Hands each part to one rank. The root rank, which is rank 0, has the tickets; the others ask it, once for each
/// worker that is free. So a part takes two messages, and a worker that finds nothing left two more. No call waits, and
/// only the tickets of the root rank grow with parts or ranks.
class PartHandOut {
 public:
    /// Takes `waiting`, all parts that wait, in descending order of load, and `host_of_rank`, the number of each rank's
    /// host; only the root rank looks at these two. `on_taken` gets the place in `waiting` of each part that this rank
    /// is to mesh.
    PartHandOut(Communicator& ranks, std::vector<WaitingPart> waiting, std::vector<std::int32_t> host_of_rank,
                std::function<void(std::size_t)> on_taken);

    /// Takes a part for each worker that is free, now or when the answer comes.
    void fill(std::size_t free_workers);
    /// Answers a `wish` with a part, or with none if none is left. Only on the root rank.
    void answer(const VolumeMessage& wish);
    /// Takes an `assignment` that has arrived. Not on the root rank.
    void receive(const VolumeMessage& assignment);

    /// Whether a wish has no answer yet.
    bool is_waiting() const { return wishes_ > 0; }

 private:
    Communicator& ranks_;
    PartTickets tickets_;
    std::vector<std::int32_t> host_of_rank_;
    std::function<void(std::size_t)> on_taken_;
    std::size_t wishes_ = 0;        // without an answer
    bool is_anything_left_ = true;  // whether parts are left, as far as this rank knows
};

}  // namespace kerf
