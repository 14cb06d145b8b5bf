// A limit of threads for the duration of a call.
#pragma once

#include "base/core/threads.h"

namespace kerf {

/// Restores at its end the limit of threads that was there before, so that set_thread_limit() holds for one call in a
/// process that makes others. May neither begin nor end while a loop runs.
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
