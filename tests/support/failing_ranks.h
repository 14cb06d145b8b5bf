// Ranks of which one fails at what it says to others or hears of them.
#pragma once

#include <new>
#include <optional>
#include <utility>

#include "support/counting_ranks.h"

namespace kerf::test {

/// A rank that has no memory for one of the messages that it posts: that after so many good ones.
class FailingPosts : public CountingRanks {
 public:
    FailingPosts(Communicator& ranks, int good_posts) : CountingRanks(ranks), good_posts_(good_posts) {}
    void post(int rank, const Bytes& message) override {
        if (good_posts_-- == 0) throw std::bad_alloc();
        CountingRanks::post(rank, message);
    }

 private:
    int good_posts_;
};

/// A rank that has no memory, once, when one of these messages arrives, which it gets later.
template <class IsOneOfThese>
class FailingPoll : public CountingRanks {
 public:
    FailingPoll(Communicator& ranks, IsOneOfThese is_one_of_these)
        : CountingRanks(ranks), is_one_of_these_(std::move(is_one_of_these)) {}
    std::optional<Bytes> poll() override {
        if (late_) return *std::exchange(late_, {});
        std::optional<Bytes> message = CountingRanks::poll();
        if (has_failed_ || !message || !is_one_of_these_(*message)) return message;
        has_failed_ = true;
        late_ = std::move(message);
        throw std::bad_alloc();
    }

 private:
    IsOneOfThese is_one_of_these_;
    bool has_failed_ = false;
    std::optional<Bytes> late_;
};

}  // namespace kerf::test
