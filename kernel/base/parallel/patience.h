// Waiting for messages without work for the processor.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace kerf {

/// Pauses between looks for messages: short at first, and a millisecond at last.
class Patience {
 public:
    void pause() {
        std::this_thread::sleep_for(pause_);
        pause_ = std::min(2 * pause_, longest);
    }
    /// Makes the next pause short again: something has arrived, and more may follow soon.
    void reset() { pause_ = shortest; }

 private:
    static constexpr std::chrono::microseconds shortest{20}, longest{1000};
    std::chrono::microseconds pause_ = shortest;
};

}  // namespace kerf
