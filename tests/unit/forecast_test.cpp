#include "run/forecast.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace kerf {
namespace {

RunOptions with(std::int32_t workers, std::int64_t memory_mb, double max_volume) {
    RunOptions options;
    options.workers = workers;
    options.memory_mb = memory_mb;
    options.mesher.max_volume = max_volume;
    return options;
}

TEST(ChooseParts, AreFourForEachWorker) {
    EXPECT_EQ(choose_parts(with(1, 0, 0), 1e5, 1, 1, 1000), 4);
    EXPECT_EQ(choose_parts(with(4, 0, 0), 1e5, 1, 3, 1000), 48);
    EXPECT_EQ(choose_parts(with(4, 0, 0), 1e5, 1, 3, 10), 10) << "what the surface allows";
}

TEST(ChooseParts, AreFewerForSmallMeshes) {
    EXPECT_EQ(choose_parts(with(8, 0, 0), 12, 1, 1, 3), 1);
    EXPECT_EQ(choose_parts(with(8, 0, 1e-6), 12, 1, 1, 3), 3);
}

// With K parts a worker has room for its part by the forecast; with K - 1 it would not, if memory decides.
TEST(ChooseParts, FollowTheMemoryOfAWorker) {
    for (const std::int64_t memory_mb : {150, 300, 1000, 4000})
        for (const double max_volume : {1e-3, 1e-6, 1e-8, 1e-9}) {
            SCOPED_TRACE(testing::Message() << memory_mb << " MB, volume " << max_volume);
            const RunOptions options = with(2, memory_mb, max_volume);
            const std::int32_t parts = choose_parts(options, 1e5, 1, 1, 1'000'000);
            EXPECT_GE(parts, 8);
            const auto needed_mb = [&](double k) {
                return (forecast(1e5, 1, max_volume).memory_bytes - forecast(0, 0, 0).memory_bytes) / k / (1 << 20);
            };
            EXPECT_LT(needed_mb(parts), static_cast<double>(memory_mb));
            if (parts > 8) {
                EXPECT_GT(2.0 * needed_mb(parts - 1), static_cast<double>(memory_mb) - 100);
            }
        }
    EXPECT_THROW(choose_parts(with(2, 50, 0), 1e5, 1, 1, 100), Error);
}

TEST(PlanText, NamesPartsTetrahedraMemoryAndTime) {
    std::vector<PartReport> parts(2);
    parts[0].id = 2, parts[0].surface_facets = 1'000'000, parts[0].surface_volume = 1;
    parts[1].id = 3, parts[1].surface_facets = 2'000'000, parts[1].surface_volume = 1;
    EXPECT_EQ(plan_text(parts, with(2, 0, 0), 1, false),
              "plan        2 parts for 2 workers, about 5.7 M tetrahedra in 19 s; the largest part 3.8 M, 811 MB\n");
    const std::string table = plan_text(parts, with(2, 0, 1e-6), 1, true);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;
}

}  // namespace
}  // namespace kerf
