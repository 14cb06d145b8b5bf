#include "base/parallel/communicator.h"

#include <algorithm>
#include <array>
#include <new>

#include "base/core/out_of_memory.h"
#include "base/parallel/failure_deadline.h"

namespace kerf {

namespace {

StageStatus told_status_of_exception() {
    try {
        throw;
    } catch (const Error& e) {
        return {static_cast<int>(e.code()), e.what(), e.elements()};
    } catch (const std::exception& e) {
        if (is_out_of_memory(e))
            return {static_cast<int>(ErrorCode::memory), "Out of memory. Use more parts, fewer workers or more hosts."};
        return {static_cast<int>(ErrorCode::internal), e.what()};
    }
}

}  // namespace

// The message of the last status is so short that it lies in the string itself and needs no memory.
StageStatus status_of_exception() noexcept {
    try {
        return told_status_of_exception();
    } catch (const std::bad_alloc&) {
        return {static_cast<int>(ErrorCode::memory), "Out of memory."};
    }
}

void throw_first_error(Communicator& ranks, const StageStatus& own) {
    const FailureDeadline deadline(own.code, own.message);
    const bool was_stopped = own.code == static_cast<int>(ErrorCode::cancelled);
    const bool has_failed = own.code != 0 && !was_stopped;
    std::array<std::uint64_t, 2> counts = {has_failed, was_stopped};
    ranks.sum(counts);
    if (counts[0] + counts[1] == 0) return;
    const std::vector<char> may_speak = all_gather(ranks, static_cast<char>(counts[0] > 0 ? has_failed : was_stopped));
    const int speaker = std::find(may_speak.begin(), may_speak.end(), 1) - may_speak.begin();
    const Bytes words = ranks.broadcast(ranks.rank() == speaker ? to_bytes(own) : Bytes(), speaker);
    throw from_bytes<StageStatus>(words).error();
}

}  // namespace kerf
