#include "run/report/inside/exceeded_bounds.h"

#include <random>

#include <gtest/gtest.h>

#include "fill/mesh/quality.h"

namespace kerf {
namespace {

TetQuality quality_of(double volume, double radius_edge) {
    TetQuality quality = tet_quality(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
    quality.volume = volume;
    quality.radius_edge = radius_edge;
    return quality;
}

RunReport report_with(double max_volume, double radius_edge) {
    RunReport report;
    report.request.sizes.max_volume = max_volume;
    report.request.mesher.radius_edge = radius_edge;
    report.mesh.quality = PartQuality(10);
    return report;
}

// Against a count of the cells themselves, but for those within a bin of the bound.
TEST(ExceededBounds, CountCellsBeyondThem) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> factor(0.1, 2);
        RunReport report = report_with(1e-2, 2);
        std::int64_t large = 0, sharp = 0, near_bound = 0;
        double largest = 0;
        for (int i = 0; i < 1000; ++i) {
            const double volume = factor(random), ratio = factor(random);
            report.mesh.quality.all.add(quality_of(1e-2 * volume, 2 * ratio));
            large += volume > 1;
            sharp += ratio > 1;
            near_bound += std::abs(volume - 1) < 0.05 || std::abs(ratio - 1) < 0.05;
            largest = std::max(largest, 1e-2 * volume);
        }
        const std::vector<ExceededBound> found = exceeded_bounds(report);
        ASSERT_EQ(found.size(), 2U);
        EXPECT_STREQ(found[0].option, "max-volume");
        EXPECT_LE(found[0].cells, large);
        EXPECT_GE(found[0].cells, large - near_bound);
        EXPECT_EQ(found[0].largest, largest);
        EXPECT_LE(found[1].cells, sharp);
        EXPECT_GE(found[1].cells, sharp - near_bound);
    }
}

TEST(ExceededBounds, NothingIsSaidOfBoundsThatHoldOrThatNobodyAskedFor) {
    RunReport report = report_with(1, 1.4);
    report.mesh.quality.all.add(quality_of(0.5, 1));
    EXPECT_TRUE(exceeded_bounds(report).empty());
    RunReport none = report_with(0, 0);
    none.mesh.quality.all.add(quality_of(0.5, 100));
    EXPECT_TRUE(exceeded_bounds(none).empty());
    EXPECT_TRUE(exceeded_bounds(RunReport{}).empty());
    EXPECT_EQ(exceeded_text({}), "");
    EXPECT_EQ(exceeded_text({{"max-volume", 0.5, 1, 0.75}, {"radius-edge", 2, 1200, 402}}),
              "1 cell beyond --max-volume 0.5, up to 1.5 times; 1,200 cells beyond --radius-edge 2, up to 201 times");
}

}  // namespace
}  // namespace kerf
