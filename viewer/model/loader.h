// The second thread: does one task after the other, and hands over what came out when the first thread asks.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/error.h"

namespace kerf::view {

/// What tasks belong to. Once it has ended, those that wait are dropped, and so are their results.
class Scope {
 public:
    bool has_ended() const { return ended_; }
    void end() { ended_ = true; }

 private:
    std::atomic<bool> ended_ = false;
};

/// Runs tasks on a thread of its own. All other calls come from one thread.
class Loader {
 public:
    /// Runs on the thread of take_over().
    using Completion = std::function<void()>;
    /// Runs on the thread of the loader, sharing no data with others but what is const.
    using Work = std::function<Completion()>;

    struct Task {
        std::shared_ptr<const Scope> scope;
        Work work;
        std::function<void(const Error&)> on_failure;  ///< instead of the completion, if `work` throws
    };

    Loader();
    /// Waits for the task under way.
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    /// Asked for by someone who waits: the newest come first, before all that can wait.
    void post(Task task);
    /// Done when nothing else is to be done, in the order of the calls.
    void post_idle(Task task);

    /// Runs the completions that have come; how many. Those of ended scopes are dropped.
    std::size_t take_over();
    /// Blocks until there is something to take over, at most `seconds`.
    void wait(double seconds);

 private:
    struct Result {
        std::shared_ptr<const Scope> scope;
        Completion completion;
    };
    void run();
    bool next(Task& task);
    static Result perform(Task task);

    std::mutex mutex_;
    std::condition_variable to_do_, done_;
    std::deque<Task> urgent_, idle_;  // the next one first
    std::vector<Result> results_;
    bool stops_ = false;
    std::thread thread_;  // last, so that all else is there when it starts
};

}  // namespace kerf::view
