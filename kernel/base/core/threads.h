// Loops of one process on several threads, with the same result for any number of them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace kerf {

namespace detail {

// The number of threads that may be started beside the running ones; below 0 while more run than should.
inline std::atomic<int>& spare_threads() {
    static std::atomic<int> spare(std::max<int>(1, std::thread::hardware_concurrency()) - 1);
    return spare;
}

// Takes up to `wanted` of the spare threads, and gives those back at its end that have not been given back one by one.
class ThreadLease {
 public:
    explicit ThreadLease(int wanted) {
        int spare = spare_threads();
        while (!spare_threads().compare_exchange_weak(spare, spare - taken_of(spare, wanted))) {
        }
        count_ = left_ = taken_of(spare, wanted);
    }
    ~ThreadLease() { spare_threads() += left_; }
    ThreadLease(const ThreadLease&) = delete;
    ThreadLease& operator=(const ThreadLease&) = delete;
    int count() const { return count_; }
    void give_back_one() {
        --left_;
        ++spare_threads();
    }

 private:
    static int taken_of(int spare, int wanted) { return std::clamp(wanted, 0, std::max(0, spare)); }
    int count_ = 0;
    std::atomic<int> left_ = 0;
};

// A thread that waits for others: loops of theirs may have another one in its place.
class WaitingThread {
 public:
    WaitingThread() { ++spare_threads(); }
    ~WaitingThread() { --spare_threads(); }
    WaitingThread(const WaitingThread&) = delete;
    WaitingThread& operator=(const WaitingThread&) = delete;
};

// The numbers that threads take one after the other, and the exception for the lowest of them.
class SharedRanges {
 public:
    explicit SharedRanges(std::size_t count) : count_(count) {}

    template <class Work>
    void work(const Work& work) {
        for (std::size_t i = next_++; i < count_; i = next_++) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (i < failed_) {
                    failed_ = i;
                    exception_ = std::current_exception();
                }
                next_ = count_;  // those below have been taken
            }
        }
    }
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

 private:
    std::size_t count_, failed_ = ~std::size_t{0};
    std::atomic<std::size_t> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr exception_;
};

}  // namespace detail

/// Limits the threads with which this process works at a time, the thread that calls a loop included. Without a call
/// the limit is the number of processors. Not while a loop runs.
inline void set_thread_limit(int threads) { detail::spare_threads() = std::max(1, threads) - 1; }

/// Calls work(i) for each i below `count`, on the caller's thread and on as many others as are free and can be started,
/// perhaps none. The output of work(i) must belong to i alone. Of several exceptions that of the lowest i is thrown;
/// work for higher ones may be left out then. Starting a thread takes some 20 us: an i should be worth that.
template <class Work>
void for_each_on_threads(std::size_t count, const Work& work) {
    if (count == 0) return;
    detail::SharedRanges ranges(count);
    {
        detail::ThreadLease lease(std::min<std::size_t>(count - 1, 1024));
        std::vector<std::jthread> others;
        try {
            for (int i = 0; i < lease.count(); ++i)
                others.emplace_back([&] {
                    ranges.work(work);
                    lease.give_back_one();
                });
        } catch (const std::system_error&) {
            // The system has no more threads for us: those that there are do the work.
        }
        ranges.work(work);
        if (!others.empty()) {
            const detail::WaitingThread waiting;
            others.clear();
        }
    }
    ranges.rethrow();
}

/// A part of [0, count).
struct IndexRange {
    std::size_t first = 0, last = 0;
};

/// Calls work(range) for consecutive ranges of `grain` numbers of [0, count), of which the last may be shorter; they
/// depend on these two numbers alone. Otherwise as for_each_on_threads().
template <class Work>
void for_ranges_on_threads(std::size_t count, std::size_t grain, const Work& work) {
    for_each_on_threads((count + grain - 1) / grain, [&](std::size_t i) {
        work(IndexRange{i * grain, std::min(count, (i + 1) * grain)});
    });
}

/// Returns of_range(range) for each of the ranges of for_ranges_on_threads(), in their order, so that a sum of them
/// does not depend on threads.
template <class OfRange>
auto values_of_ranges(std::size_t count, std::size_t grain, const OfRange& of_range) {
    std::vector<decltype(of_range(IndexRange{}))> values((count + grain - 1) / grain);
    for_ranges_on_threads(count, grain,
                          [&](const IndexRange& range) { values[range.first / grain] = of_range(range); });
    return values;
}

/// Sorts by an order in which no two different items are equal: it is not stable. O(n log n); takes memory for a copy
/// of half the items.
template <class T, class Less = std::less<T>>
void sort_on_threads(std::vector<T>& items, const Less& less = Less()) {
    constexpr std::size_t least_of_range = std::size_t{1} << 16;
    std::size_t grain = std::max(least_of_range, (items.size() + 15) / 16);
    const auto at = [&](std::size_t i) { return items.begin() + i; };
    for_ranges_on_threads(items.size(), grain,
                          [&](const IndexRange& range) { std::sort(at(range.first), at(range.last), less); });
    for (; grain < items.size(); grain *= 2)
        for_ranges_on_threads(items.size(), 2 * grain, [&](const IndexRange& range) {
            if (range.last - range.first > grain)
                std::inplace_merge(at(range.first), at(range.first + grain), at(range.last), less);
        });
}

}  // namespace kerf
