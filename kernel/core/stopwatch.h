// Wall clock time.
#pragma once

#include <chrono>
#include <utility>

namespace kerf {

/// Counts seconds from its making on, by a clock that is never set.
class Stopwatch {
 public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    /// The seconds so far; then it counts from zero.
    double lap() {
        const auto now = Clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

 private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace kerf
