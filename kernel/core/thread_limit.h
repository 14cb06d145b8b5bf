// A limit of threads for the time of a call.
#pragma once

#include "core/threads.h"

namespace kerf {

/// Gives back, when it ends, the limit that was there before: what set_thread_limit() says meanwhile counts for one
/// call in a process that makes others. Not while a loop runs, neither its beginning nor its end.
class ThreadLimitGuard {
 public:
    ThreadLimitGuard() = default;
    ~ThreadLimitGuard() { detail::spare_threads() = before_; }
    ThreadLimitGuard(const ThreadLimitGuard&) = delete;
    ThreadLimitGuard& operator=(const ThreadLimitGuard&) = delete;

 private:
    int before_ = detail::spare_threads();
};

}  // namespace kerf
