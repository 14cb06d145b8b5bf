// The second thread, which does one task after the other and hands over the results when the first thread asks.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "base/core/error.h"

namespace kerf::view {

/// The owner of tasks. Once it has ended, the tasks that wait are dropped, and so are the results of all.
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
    /// A function that runs on the thread of take_over().
    using Completion = std::function<void()>;
    /// A function that runs on the thread of the loader, and shares no data with others but constants.
    using Work = std::function<Completion()>;

    struct Task {
        std::shared_ptr<const Scope> scope;
        Work work;
        std::function<void(const Error&)> on_failure;  ///< runs instead of the completion, if `work` throws
    };

    Loader();
    /// Waits for the task under way.
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    /// Queues a task for which someone waits: the newest comes first, before all idle ones.
    void post(Task task);
    /// Queues a task that is done when nothing else is to be done, in the order of the calls.
    void post_idle(Task task);

    /// Runs the completions that have come, and returns their number. Completions of ended scopes are dropped.
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
