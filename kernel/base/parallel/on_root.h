// Work that one rank does for all of them.
#pragma once

#include <exception>
#include <utility>

#include "base/parallel/communicator.h"
#include "base/parallel/patience.h"

namespace kerf {

/// Collective: returns the bytes of stage(), which rank 0 calls, on every rank; an exception of it is thrown on all of
/// them alike. The other ranks leave their processors to others meanwhile; on_waited() is called there afterwards, and
/// its exceptions are thrown on all, too. There must be no other messages that were posted before and not polled.
/// Throws RankHasLeft on all ranks if one has left before or leaves meanwhile.
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
