// How a stage tells of its progress.
#pragma once

#include <cstddef>
#include <functional>

#include "core/error.h"
#include "decompose/decomposition.h"

namespace kerf {

/// Is told of the steps of stages. Once cancelled() is true, a stage ends with Error(cancelled).
class StageListener : public CutListener {
 public:
    /// `done` of `total` steps of a stage, 0 if nobody knows how many: "read", "repair", "remesh", "decompose",
    /// "prepare", "volume", "reference", "write", "hash".
    virtual void on_progress(const char* stage, std::size_t done, std::size_t total) = 0;
};

/// Throws Error(cancelled) if the listener wants the end; null wants nothing.
inline void end_if_cancelled(const CutListener* listener) {
    if (listener && listener->cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
}

/// Tells the listener of a step, unless it is null or wants the end: then Error(cancelled) is thrown.
inline void tell_progress(StageListener* listener, const char* stage, std::size_t done, std::size_t total) {
    end_if_cancelled(listener);
    if (listener) listener->on_progress(stage, done, total);
}

/// Calls end_if_cancelled() again and again in what takes a function.
inline std::function<void()> poll_of(const CutListener* listener) {
    return [listener] { end_if_cancelled(listener); };
}

}  // namespace kerf
