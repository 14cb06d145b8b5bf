// A rank that has failed is ended where the others do not come.
#include "base/parallel/failure_deadline.h"

#include <unistd.h>

#include <csignal>

#include <gtest/gtest.h>

#include "base/parallel/communicator.h"

namespace kerf {
namespace {

// The other ranks never come.
class LonelyRank : public SingleRank {
 public:
    std::vector<Bytes> all_gather(const Bytes&) override {
        for (;;) ::pause();
    }
};

void end_test(int code, std::string_view message) {
    (void)!::write(STDERR_FILENO, message.data(), message.size());
    ::_exit(code);
}

class FailureDeadlineTest : public testing::Test {
 protected:
    void SetUp() override { limit_wait_after_failure(1, end_test); }
    void TearDown() override { limit_wait_after_failure(0, nullptr); }
};
using FailureDeadlineDeathTest = FailureDeadlineTest;

TEST_F(FailureDeadlineDeathTest, EndsARankWhoseAgreementNobodyJoins) {
    EXPECT_EXIT(
        {
            LonelyRank ranks;
            in_agreement(ranks, [] { throw Error(ErrorCode::io, "The disk is full."); });
        },
        testing::ExitedWithCode(7), "The disk is full");
}

TEST_F(FailureDeadlineTest, IsOverWhenTheOthersHaveCome) {
    const auto earlier = std::signal(SIGALRM, SIG_IGN);
    SingleRank ranks;
    EXPECT_THROW(in_agreement(ranks, [] { throw Error(ErrorCode::io, "The disk is full."); }), Error);
    EXPECT_EQ(::alarm(0), 0u);
    EXPECT_EQ(std::signal(SIGALRM, earlier), SIG_IGN) << "the handler of others is back";
}

TEST_F(FailureDeadlineTest, RunsForErrorsOnlyAndOnce) {
    const auto runs = [](int code) {
        const FailureDeadline deadline(code, std::string(5000, 'x'));
        { const FailureDeadline within(code, ""); }
        const unsigned left = ::alarm(0);
        ::alarm(left);
        return left > 0;
    };
    EXPECT_FALSE(runs(0));
    EXPECT_FALSE(runs(static_cast<int>(ErrorCode::cancelled)));
    EXPECT_TRUE(runs(static_cast<int>(ErrorCode::io))) << "the inner one has not ended it";
    limit_wait_after_failure(0, nullptr);
    EXPECT_FALSE(runs(static_cast<int>(ErrorCode::io))) << "a library has no limit";
}

// A run that is being cancelled has its own.
TEST_F(FailureDeadlineTest, LeavesAnEarlierAlarmAlone) {
    ::alarm(100);
    { const FailureDeadline deadline(7, "The disk is full."); }
    EXPECT_GT(::alarm(0), 90u);
}

}  // namespace
}  // namespace kerf
