// Listeners that stages tell of their progress.
#pragma once

#include <cstddef>
#include <functional>

#include "base/core/error.h"
#include "cut/decompose/decomposition.h"

namespace kerf {

/// A listener that is told of the steps of stages. Once cancelled() is true, a stage ends with Error(cancelled).
class StageListener : public CutListener {
 public:
    /// `done` of `total` steps of a stage, 0 if the total is not known: "read", "repair", "remesh", "decompose",
    /// "prepare", "volume", "reference", "write", "hash".
    virtual void on_progress(const char* stage, std::size_t done, std::size_t total) = 0;
};

/// Throws Error(cancelled) if the listener is cancelled; null never is.
inline void end_if_cancelled(const CutListener* listener) {
    if (listener && listener->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
}

/// Tells the listener of a step, unless it is null; throws Error(cancelled) if it is cancelled.
inline void tell_progress(StageListener* listener, const char* stage, std::size_t done, std::size_t total) {
    end_if_cancelled(listener);
    if (listener) listener->on_progress(stage, done, total);
}

/// Returns a function that calls end_if_cancelled(), to be called again and again by long work.
inline std::function<void()> cancellation_check(const CutListener* listener) {
    return [listener] { end_if_cancelled(listener); };
}

}  // namespace kerf
