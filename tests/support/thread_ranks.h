// Ranks that are threads of one process.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
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
    void send(int from, int to, const Bytes& message) {
        const std::lock_guard lock(mutex_);
        sent_[{from, to}].push_back(message);
        all_here_.notify_all();
    }
    Bytes receive(int from, int to) {
        std::unique_lock lock(mutex_);
        std::deque<Bytes>& queue = sent_[{from, to}];
        all_here_.wait(lock, [&] { return !queue.empty(); });
        Bytes message = std::move(queue.front());
        queue.pop_front();
        return message;
    }
    int size() const { return size_; }

 private:
    int size_, arrived_ = 0, round_ = 0;
    std::vector<Bytes> given_, result_;
    std::map<std::pair<int, int>, std::deque<Bytes>> sent_;
    std::mutex mutex_;
    std::condition_variable all_here_;
};

class ThreadRank : public Communicator {
 public:
    ThreadRank(MeetingPoint& meeting, int rank) : meeting_(meeting), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return meeting_.size(); }
    std::vector<Bytes> all_gather(const Bytes& contribution) override { return meeting_.meet(rank_, contribution); }
    Bytes broadcast(Bytes of_root, int root) override {
        return meeting_.meet(rank_, of_root)[static_cast<std::size_t>(root)];
    }
    std::vector<Bytes> exchange(std::vector<Bytes> to_rank) override {
        std::vector<Bytes> got;
        for (const Bytes& of_rank : meeting_.meet(rank_, to_bytes(to_rank)))
            got.push_back(from_bytes<std::vector<Bytes>>(of_rank)[static_cast<std::size_t>(rank_)]);
        return got;
    }
    void sum(std::span<std::uint64_t> words) override {
        const std::vector<std::uint64_t> own(words.begin(), words.end());
        std::fill(words.begin(), words.end(), 0);
        for (const Bytes& of_rank : meeting_.meet(rank_, to_bytes(own))) {
            const auto added = from_bytes<std::vector<std::uint64_t>>(of_rank);
            for (std::size_t i = 0; i < words.size(); ++i) words[i] += added[i];
        }
    }
    void send(int rank, const Bytes& message) override { meeting_.send(rank_, rank, message); }
    Bytes receive(int rank) override { return meeting_.receive(rank, rank_); }
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
