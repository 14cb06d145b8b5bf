// What one rank does for all of them.
#pragma once

#include <exception>
#include <utility>

#include "parallel/communicator.h"
#include "parallel/patience.h"

namespace kerf {

/// Collective: what stage() returns on rank 0, on every rank; what it throws there is thrown on all of them alike. The
/// others do not call it, and leave their processors to others meanwhile; on_waited() is called there afterwards, and
/// what it throws is thrown on all, too. No other messages may be posted before to ranks that have not polled them.
/// Throws RankHasLeft on all of them if one has left before or leaves meanwhile.
template <class Stage, class OnWaited>
Bytes bytes_of_root(Communicator& ranks, Stage stage, OnWaited on_waited) {
    Bytes bytes;
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) {
            for (Patience patience; !ranks.poll();) patience.pause();
            return on_waited();
        }
        std::exception_ptr failure;
        StageStatus why;
        try {
            bytes = stage();
        } catch (const std::exception&) {
            failure = std::current_exception();
            why = status_of_exception();
        }
        tell_or_leave(ranks, why, [&] {
            for (int rank = 1; rank < ranks.size(); ++rank) ranks.post(rank, Bytes(1));
        });
        if (failure) std::rethrow_exception(failure);
    });
    return ranks.broadcast(std::move(bytes), 0);
}

}  // namespace kerf
