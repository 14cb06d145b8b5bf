// Ranks that are threads of one process.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "parallel/communicator.h"

namespace kerf::test {

// Where the contributions of all ranks meet.
class MeetingPoint {
 public:
    explicit MeetingPoint(int size) : size_(size), given_(size) {}
    std::vector<Bytes> meet(int rank, const Bytes& contribution) {
        std::unique_lock lock(mutex_);
        given_[rank] = contribution;
        const int round = round_;
        if (++arrived_ == size_) {
            result_ = given_;
            arrived_ = 0;
            ++round_;
            all_here_.notify_all();
        }
        all_here_.wait(lock, [&] { return round_ != round; });
        return result_;
    }
    int size() const { return size_; }

 private:
    int size_, arrived_ = 0, round_ = 0;
    std::vector<Bytes> given_, result_;
    std::mutex mutex_;
    std::condition_variable all_here_;
};

class ThreadRank : public Communicator {
 public:
    ThreadRank(MeetingPoint& meeting, int rank) : meeting_(meeting), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return meeting_.size(); }
    std::vector<Bytes> all_gather(const Bytes& contribution) override { return meeting_.meet(rank_, contribution); }
    void post(int, const Bytes&) override { FAIL() << "no stage under test posts messages"; }
    std::optional<Bytes> poll() override { return {}; }
    void drop_messages() override {}
    void leave(const StageStatus&) override { FAIL() << "no stage under test ends on one rank alone"; }

 private:
    MeetingPoint& meeting_;
    int rank_;
};

/// Calls body(communicator) on so many ranks, and returns when all have ended.
template <class Body>
void run_ranks(int size, Body body) {
    MeetingPoint meeting(size);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size; ++rank)
        threads.emplace_back([&, rank] {
            ThreadRank communicator(meeting, rank);
            body(communicator);
        });
    for (std::thread& thread : threads) thread.join();
}

}  // namespace kerf::test
