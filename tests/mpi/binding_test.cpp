// Ranks that are bound to processors: they start no more workers than these have room for, and say what lifts it.
#include <gtest/gtest.h>

#include "base/parallel/processors.h"
#include "support/assets.h"
#include "support/mpirun.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using Words = std::vector<std::string>;

class MpiBinding : public testing::Test {
 protected:
    Words mesh(const Words& more = {}) const {
        Words words = {test::kerf_program(), "mesh", test::asset_path("cube"), "-o", folder_.file("out"), "-n", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    static Words joined(Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // mpirun knows hardware threads only where it is told to count them.
    const Words bound_ = {"--bind-to", "hwthread", "--use-hwthread-cpus"}, unbound_ = {"--bind-to", "none"};
    const Words on_one_ = {"/usr/bin/taskset", "--cpu-list", std::to_string(allowed_processors().back())};
    const int processors_ = static_cast<int>(allowed_processors().size());

 private:
    test::TemporaryFolder folder_;
};

// As the report says it.
void expect_workers(const ChildResult& result, int ranks, int workers) {
    EXPECT_EQ(result.exit_code, 0) << result.log;
    const std::string words = std::to_string(ranks) + " rank" + (ranks == 1 ? "" : "s") + " x " +
                              std::to_string(workers) + " worker" + (workers == 1 ? "\n" : "s\n");
    EXPECT_NE(result.log.find(words), std::string::npos) << words << '\n' << result.log;
}

TEST_F(MpiBinding, ARankHasAWorkerForEachProcessorThatItMayUse) {
    expect_workers(test::run_ranks(1, joined(unbound_, mesh())), 1, processors_);
    expect_workers(test::run_ranks(1, joined(bound_, mesh())), 1, 1);
    expect_workers(test::run_ranks(1, joined(joined(unbound_, on_one_), mesh())), 1, 1);
}

TEST_F(MpiBinding, RanksShareTheProcessorsThatTheyMayUse) {
    for (const int ranks : {2, 3})
        expect_workers(test::run_ranks(ranks, joined(unbound_, mesh())), ranks, std::max(1, processors_ / ranks));
}

TEST_F(MpiBinding, WithoutRanksTasksetBindsToo) {
    expect_workers(test::run_program("/usr/bin/env", mesh()), 1, processors_);
    expect_workers(test::run_program("/usr/bin/env", joined(on_one_, mesh())), 1, 1);
}

TEST_F(MpiBinding, IsSaidOnceWithWhatLiftsIt) {
    if (processors_ < 2) GTEST_SKIP() << "nothing can be bound to less than one processor";
    const ChildResult asked = test::run_ranks(2, joined(bound_, mesh({"--workers", "2"})));
    expect_workers(asked, 2, 2);
    EXPECT_EQ(test::count(asked.log, "The 2 workers of a rank share 1 of"), 1) << asked.log;
    EXPECT_EQ(test::count(asked.log, "mpirun --bind-to none"), 1) << asked.log;
    EXPECT_EQ(test::run_ranks(1, joined(bound_, mesh({"--workers", "2", "-q"}))).log, "");
    EXPECT_EQ(test::count(test::run_ranks(2, joined(unbound_, mesh({"--workers", "2"}))).log, "bind"), 0);
    EXPECT_EQ(test::count(test::run_ranks(1, joined(bound_, mesh())).log, "mpirun --bind-to none gives it"), 1);
    EXPECT_EQ(test::count(test::run_ranks(1, joined(unbound_, mesh())).log, "bind"), 0);
}

TEST_F(MpiBinding, OfTasksetIsNotThatOfMpirun) {
    if (processors_ < 2) GTEST_SKIP() << "nothing can be bound to less than one processor";
    const ChildResult asked = test::run_program("/usr/bin/env", joined(on_one_, mesh({"--workers", "2"})));
    expect_workers(asked, 1, 2);
    EXPECT_EQ(test::count(asked.log, "because taskset or a batch system has bound it"), 1) << asked.log;
    EXPECT_EQ(test::count(asked.log, "mpirun"), 0) << asked.log;
    EXPECT_EQ(test::count(test::run_program("/usr/bin/env", joined(on_one_, mesh())).log, "bound"), 0);
}

}  // namespace
}  // namespace kerf
