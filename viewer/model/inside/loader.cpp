#include "viewer/model/inside/loader.h"
#include "base/core/out_of_memory.h"

#include <chrono>
#include <exception>
#include <utility>

namespace kerf::view {

Loader::Loader() : thread_([this] { run(); }) {}

Loader::~Loader() {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    to_do_.notify_one();
    thread_.join();
}

void Loader::post(Task task) {
    {
        const std::lock_guard lock(mutex_);
        urgent_.push_front(std::move(task));
    }
    to_do_.notify_one();
}

void Loader::post_idle(Task task) {
    {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(task));
    }
    to_do_.notify_one();
}

// False when the loader is to stop.
bool Loader::next(Task& task) {
    std::unique_lock lock(mutex_);
    to_do_.wait(lock, [this] { return stops_ || !urgent_.empty() || !idle_.empty(); });
    if (stops_) return false;
    std::deque<Task>& queue = urgent_.empty() ? idle_ : urgent_;
    task = std::move(queue.front());
    queue.pop_front();
    return true;
}

Loader::Result Loader::perform(Task task) {
    const auto failure = [&task](const Error& error) -> Result {
        return {task.scope, [fail = std::move(task.on_failure), error] {
                    if (fail) fail(error);
                }};
    };
    try {
        return {task.scope, task.work()};
    } catch (const Error& error) {
        return failure(error);
    } catch (const std::exception& error) {
        return failure(is_out_of_memory(error) ? Error(ErrorCode::memory, "There is not enough memory.")
                                               : Error(ErrorCode::internal, error.what()));
    }
}

void Loader::run() {
    for (;;) {
        Task task;
        if (!next(task)) return;
        if (task.scope->has_ended()) continue;
        Result result = perform(std::move(task));
        const std::lock_guard lock(mutex_);
        results_.push_back(std::move(result));
        done_.notify_one();
    }
}

std::size_t Loader::take_over() {
    std::vector<Result> results;
    {
        const std::lock_guard lock(mutex_);
        results.swap(results_);
    }
    std::size_t count = 0;
    for (const Result& result : results) {
        if (result.scope->has_ended() || !result.completion) continue;
        result.completion();
        ++count;
    }
    return count;
}

void Loader::wait(double seconds) {
    std::unique_lock lock(mutex_);
    done_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return !results_.empty(); });
}

}  // namespace kerf::view
