// Ranks that are threads of one process.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/parallel/communicator.h"

namespace kerf::test {

// Where the contributions of all ranks meet, and their messages wait.
class MeetingPoint {
 public:
    explicit MeetingPoint(int size) : size_(size), given_(size), leaving_(size), posted_(size) {}

    // Of a rank that leaves: with the reason. For all of them that is the error of the first that does.
    std::vector<Bytes> meet(int rank, const Bytes& contribution, const StageStatus* why = nullptr) {
        std::unique_lock lock(mutex_);
        given_[rank] = contribution;
        if (why) leaving_[rank] = StageStatus{why->code, why->message};
        const int round = round_;
        if (++arrived_ == size_) {
            result_ = given_;
            has_ended_ = is_anybody_leaving();
            arrived_ = 0;
            ++round_;
        }
        change_.notify_all();
        change_.wait(lock, [&] { return round_ != round; });
        if (has_ended_) {
            const auto left = std::find_if(leaving_.begin(), leaving_.end(), [](auto& w) { return w.has_value(); });
            throw RankHasLeft(static_cast<ErrorCode>((*left)->code), (*left)->message);
        }
        return result_;
    }
    void send(int from, int to, Bytes message) {
        const std::lock_guard lock(mutex_);
        sent_[{from, to}].push_back(std::move(message));
        change_.notify_all();
    }
    Bytes receive(int from, int to) {
        std::unique_lock lock(mutex_);
        std::deque<Bytes>& queue = sent_[{from, to}];
        change_.wait(lock, [&] { return !queue.empty() || is_anybody_leaving(); });
        if (queue.empty()) {
            lock.unlock();
            meet(to, {});  // throws
        }
        return take_first(queue);
    }
    // The first message that waits for this rank.
    std::optional<Bytes> take_any(int to) {
        std::unique_lock lock(mutex_);
        for (auto& [ends, queue] : sent_)
            if (ends.second == to && !queue.empty()) return take_first(queue);
        return nothing(to, lock);
    }
    void post(int to, const Bytes& message) {
        const std::lock_guard lock(mutex_);
        posted_[to].push_back(message);
    }
    std::optional<Bytes> poll(int rank) {
        std::unique_lock lock(mutex_);
        if (posted_[rank].empty()) return nothing(rank, lock);
        return take_first(posted_[rank]);
    }
    void drop_messages(int rank) {
        meet(rank, {});
        {
            const std::lock_guard lock(mutex_);
            posted_[rank].clear();
        }
        meet(rank, {});  // nobody posts before all are here
    }
    int size() const { return size_; }

 private:
    static Bytes take_first(std::deque<Bytes>& queue) {
        Bytes first = std::move(queue.front());
        queue.pop_front();
        return first;
    }
    std::optional<Bytes> nothing(int rank, std::unique_lock<std::mutex>& lock) {
        if (is_anybody_leaving()) {
            lock.unlock();
            meet(rank, {});  // throws
        }
        return {};
    }
    bool is_anybody_leaving() const {
        return std::any_of(leaving_.begin(), leaving_.end(), [](const auto& why) { return why.has_value(); });
    }

    int size_, arrived_ = 0, round_ = 0;
    bool has_ended_ = false;
    std::vector<Bytes> given_, result_;
    std::vector<std::optional<StageStatus>> leaving_;
    std::map<std::pair<int, int>, std::deque<Bytes>> sent_;
    std::vector<std::deque<Bytes>> posted_;
    std::mutex mutex_;
    std::condition_variable change_;
};

class ThreadRank : public Communicator {
 public:
    ThreadRank(MeetingPoint& meeting, int rank) : meeting_(meeting), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return meeting_.size(); }
    std::vector<Bytes> all_gather(const Bytes& contribution) override {
        return or_over([&] { return meeting_.meet(rank_, contribution); });
    }
    Bytes broadcast(Bytes of_root, int root) override { return all_gather(of_root)[static_cast<std::size_t>(root)]; }
    std::vector<Bytes> exchange(std::vector<Bytes> to_rank) override {
        std::vector<Bytes> got;
        for (const Bytes& of_rank : all_gather(to_bytes(to_rank)))
            got.push_back(from_bytes<std::vector<Bytes>>(of_rank)[static_cast<std::size_t>(rank_)]);
        return got;
    }
    void sum(std::span<std::uint64_t> words) override {
        const std::vector<std::uint64_t> own(words.begin(), words.end());
        std::fill(words.begin(), words.end(), 0);
        for (const Bytes& of_rank : all_gather(to_bytes(own))) {
            const auto added = from_bytes<std::vector<std::uint64_t>>(of_rank);
            for (std::size_t i = 0; i < words.size(); ++i) words[i] += added[i];
        }
    }
    void send(int rank, Bytes message) override {
        or_over([&] { meeting_.send(rank_, rank, std::move(message)); });
    }
    Bytes receive(int rank) override {
        return or_over([&] { return meeting_.receive(rank, rank_); });
    }
    std::optional<Bytes> receive_any() override {
        return or_over([&] { return meeting_.take_any(rank_); });
    }
    void post(int rank, const Bytes& message) override {
        if (!over_) meeting_.post(rank, message);
    }
    std::optional<Bytes> poll() override {
        return or_over([&] { return meeting_.poll(rank_); });
    }
    void drop_messages() override {
        if (!over_) or_over([&] { meeting_.drop_messages(rank_); });
    }
    void leave(const StageStatus& why) override {
        try {
            if (!over_) or_over([&] { meeting_.meet(rank_, {}, &why); });
        } catch (const RankHasLeft&) {  // now all know
        }
    }

 private:
    template <class Meet>
    std::invoke_result_t<Meet> or_over(Meet meet) {
        if (over_) throw RankHasLeft(*over_);
        try {
            return meet();
        } catch (const RankHasLeft& left) {
            over_ = left;
            throw;
        }
    }

    MeetingPoint& meeting_;
    int rank_;
    std::optional<RankHasLeft> over_;  // since a rank has left
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
