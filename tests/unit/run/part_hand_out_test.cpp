// Many ranks and parts, without workers: who gets what, and how many messages that takes.
#include "run/run/inside/part_hand_out.h"

#include <atomic>
#include <deque>
#include <mutex>

#include <gtest/gtest.h>

#include "support/thread_ranks.h"

namespace kerf {
namespace {

// Posted messages of all ranks, by the one that they are for.
class Mail {
 public:
    explicit Mail(int ranks) : boxes_(static_cast<std::size_t>(ranks)) {}
    void put(int rank, const Bytes& message) {
        const std::lock_guard lock(mutex_);
        boxes_[static_cast<std::size_t>(rank)].push_back(message);
        ++sent_;
    }
    std::optional<Bytes> take(int rank) {
        const std::lock_guard lock(mutex_);
        std::deque<Bytes>& box = boxes_[static_cast<std::size_t>(rank)];
        if (box.empty()) return {};
        Bytes message = std::move(box.front());
        box.pop_front();
        return message;
    }
    std::int64_t sent() const { return sent_; }

 private:
    std::mutex mutex_;
    std::vector<std::deque<Bytes>> boxes_;
    std::int64_t sent_ = 0;
};

class MailRank : public test::ThreadRank {
 public:
    MailRank(test::MeetingPoint& meeting, int rank, Mail& mail) : ThreadRank(meeting, rank), mail_(mail) {}
    void post(int rank, const Bytes& message) override { mail_.put(rank, message); }
    std::optional<Bytes> poll() override { return mail_.take(rank()); }

 private:
    Mail& mail_;
};

// Parts that take no time: a rank has ended all that it was given when it looks for messages again.
class FakeRun {
 public:
    FakeRun(int ranks, std::int32_t hosts, std::size_t workers, std::size_t parts)
        : meeting_(ranks), mail_(ranks), workers_(workers), taken_by_(parts, -1) {
        for (std::int32_t rank = 0; rank < ranks; ++rank) host_of_rank_.push_back(rank * hosts / ranks);
        for (std::size_t i = 0; i < parts; ++i) waiting_.push_back({1, static_cast<std::int32_t>(i) % hosts});
    }
    void run() {
        std::vector<std::thread> threads;
        for (int rank = 0; rank < meeting_.size(); ++rank) threads.emplace_back([this, rank] { run_rank(rank); });
        for (std::thread& thread : threads) thread.join();
    }
    const std::vector<int>& taken_by() const { return taken_by_; }
    std::int64_t messages() const { return mail_.sent(); }

 private:
    void run_rank(int rank) {
        MailRank ranks(meeting_, rank, mail_);
        std::size_t busy = 0;
        PartHandOut hand_out(ranks, waiting_, host_of_rank_, [&](std::size_t place) {
            EXPECT_EQ(std::exchange(taken_by_[place], rank), -1);
            ++busy;
            ++done_;
        });
        while (done_ < static_cast<std::int64_t>(waiting_.size()) || hand_out.is_waiting() ||
               (rank == 0 && ended_ + 1 < meeting_.size())) {
            while (const auto bytes = ranks.poll()) {
                const auto message = from_bytes<VolumeMessage>(*bytes);
                rank == 0 ? hand_out.answer(message) : hand_out.receive(message);
            }
            EXPECT_LE(busy, workers_);
            busy = 0;
            hand_out.fill(workers_);
            std::this_thread::yield();
        }
        ++ended_;
    }

    test::MeetingPoint meeting_;
    Mail mail_;
    std::size_t workers_;
    std::vector<std::int32_t> host_of_rank_;
    std::vector<WaitingPart> waiting_;
    std::vector<int> taken_by_;
    std::atomic<std::int64_t> done_ = 0;
    std::atomic<int> ended_ = 0;
};

// A wish and its answer a part, and once more for each worker that finds nothing left.
TEST(PartHandOut, OfAThousandPartsTo64RanksTakesTwoMessagesAPart) {
    for (const std::size_t workers : {1u, 3u}) {
        constexpr int ranks = 64;
        constexpr std::size_t parts = 1000;
        FakeRun run(ranks, 4, workers, parts);
        run.run();
        EXPECT_EQ(std::count(run.taken_by().begin(), run.taken_by().end(), -1), 0);
        EXPECT_LE(run.messages(), static_cast<std::int64_t>(2 * (parts + (ranks - 1) * workers)));
    }
}

TEST(PartHandOut, ToRanksThatFindNothingLeftEnds) {
    for (const std::size_t parts : {0u, 1u, 2u}) {
        FakeRun run(5, 2, 2, parts);
        run.run();
        EXPECT_EQ(std::count(run.taken_by().begin(), run.taken_by().end(), -1), 0);
    }
}

TEST(PartHandOut, OfOneRankNeedsNoMessage) {
    FakeRun run(1, 1, 3, 100);
    run.run();
    EXPECT_EQ(std::count(run.taken_by().begin(), run.taken_by().end(), 0), 100);
    EXPECT_EQ(run.messages(), 0);
}

}  // namespace
}  // namespace kerf
