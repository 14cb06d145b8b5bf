// The question of a long computation whether its result is still wanted.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

namespace kerf {

/// A function that is called every few milliseconds of a long computation, and ends it by throwing. Without a function
/// it does nothing.
class CancellationCheck {
 public:
    CancellationCheck() = default;
    explicit CancellationCheck(std::function<void()> function) : function_(std::move(function)) {}

    void operator()() const {
        if (function_) function_();
    }
    /// Calls it at every 1024th step of a loop whose steps take some microseconds.
    void at(std::size_t step) const {
        if (step % 1024 == 0) (*this)();
    }

 private:
    std::function<void()> function_;
};

}  // namespace kerf
