// The parts of a run, handed out to the ranks by the root rank.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "parallel/communicator.h"
#include "report/report.h"
#include "work/part_tickets.h"

namespace kerf {

/// What ranks post to each other while they mesh.
struct VolumeMessage {
    enum class Kind : char { wish, assignment, part_done, all_done, stop };
    Kind kind = Kind::stop;
    std::int32_t number = -1;      ///< of the rank that wishes for a part; of the part that is assigned, -1 for none
    std::vector<PartReport> part;  ///< the one that is done

    template <class Archive>
    void archive(Archive& a) {
        a(kind, number, part);
    }
};

/// Each part goes to one rank: the root rank, which is rank 0, has the tickets, the others ask it, once for each worker
/// that is free. So a part takes two messages, and a worker that finds nothing left two more. Nothing waits here, and
/// nothing but the tickets of the root rank grows with parts or ranks.
class PartHandOut {
 public:
    /// `waiting`: all parts that wait, in descending order of load, and `host_of_rank`; only the root rank looks at
    /// them. `on_taken` gets the places in that list of the parts that this rank is to mesh.
    PartHandOut(Communicator& ranks, std::vector<WaitingPart> waiting, std::vector<std::int32_t> host_of_rank,
                std::function<void(std::size_t)> on_taken);

    /// Takes a part for each worker that is free, now or when the answer comes.
    void fill(std::size_t free_workers);
    /// What a `wish` gets. Only on the root rank.
    void answer(const VolumeMessage& wish);
    /// An `assignment` has arrived. Not on the root rank.
    void receive(const VolumeMessage& assignment);

    /// Whether a wish has no answer yet.
    bool is_waiting() const { return wishes_ > 0; }

 private:
    Communicator& ranks_;
    PartTickets tickets_;
    std::vector<std::int32_t> host_of_rank_;
    std::function<void(std::size_t)> on_taken_;
    std::size_t wishes_ = 0;        // without an answer
    bool is_anything_left_ = true;  // as far as this rank knows
};

}  // namespace kerf
