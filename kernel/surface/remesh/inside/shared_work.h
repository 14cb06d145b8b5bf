// Long work on several threads: whether it is still wanted, and how much of it is done.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace kerf {

/// Asks and tells on the thread that has made it alone: what it calls need not be safe for several. Once a question has
/// ended the work by an exception, all threads end by it.
class SharedWork {
 public:
    /// Either function may be empty. `tell` gets the share of the work that is done, never less than before.
    SharedWork(std::function<void()> check, std::function<void(double)> tell)
        : check_(std::move(check)), tell_(std::move(tell)) {}
    SharedWork(const SharedWork&) = delete;
    SharedWork& operator=(const SharedWork&) = delete;

    /// To be called every few milliseconds by each thread.
    void check() {
        if (has_ended_) std::rethrow_exception(why_);
        if (std::this_thread::get_id() != owner_) return;
        try {
            if (const double share = share_; tell_ && share > told_) {
                told_ = share;
                tell_(share);
            }
            if (check_) check_();
        } catch (...) {
            why_ = std::current_exception();
            has_ended_ = true;
            throw;
        }
    }

    /// Adds a share of all the work that is done. Any thread may.
    void add(double share) { share_ += share; }
    /// Says that this share of all the work is done, whatever has been added.
    void reach(double share) { share_ = share; }

 private:
    std::function<void()> check_;
    std::function<void(double)> tell_;
    std::thread::id owner_ = std::this_thread::get_id();
    std::atomic<double> share_ = 0;
    double told_ = 0;         // of the owner
    std::exception_ptr why_;  // set before has_ended_
    std::atomic<bool> has_ended_ = false;
};

}  // namespace kerf
