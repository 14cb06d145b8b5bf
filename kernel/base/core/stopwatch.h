// Wall clock time.
#pragma once

#include <chrono>
#include <utility>

namespace kerf {

/// Counts the seconds since its construction, by a clock that is never set.
class Stopwatch {
 public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    /// Returns the seconds so far, and begins again from zero.
    double lap() {
        const auto now = Clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

 private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Returns the result of a stage, and adds its wall clock to `seconds`, also where it throws.
template <class Stage>
auto timed(double& seconds, Stage stage) {
    struct AddAtEnd {
        double& seconds;
        Stopwatch stopwatch = {};
        ~AddAtEnd() { seconds += stopwatch.seconds(); }
    } timer{seconds};
    return stage();
}

}  // namespace kerf
