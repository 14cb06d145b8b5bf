#include "run/run/inside/forecast.h"

#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/core/number_text.h"
#include "support/lines.h"

namespace kerf {
namespace {

MesherOptions of_size(double max_volume) { return MesherOptions({}, SizeField(max_volume)); }

// K for a surface of 1e5 facets around a volume of 1.
std::int32_t parts_for(const WorkerOptions& workers, double max_volume, int ranks, std::int32_t most) {
    return choose_parts(workers, of_size(max_volume), 1e5, 1, ranks, most);
}

TEST(ChooseParts, AreFourForEachWorker) {
    EXPECT_EQ(parts_for({.count = 1}, 0, 1, 1000), 4);
    EXPECT_EQ(parts_for({.count = 4}, 0, 3, 1000), 48);
    EXPECT_EQ(parts_for({.count = 4}, 0, 3, 10), 10) << "what the surface allows";
}

TEST(ChooseParts, AreFewerForSmallMeshes) {
    EXPECT_EQ(choose_parts({.count = 8}, of_size(0), 12, 1, 1, 3), 1);
    EXPECT_EQ(choose_parts({.count = 8}, of_size(1e-6), 12, 1, 1, 3), 3);
}

// With K parts a worker has room for its part by the forecast; with K - 1 it would not, if memory decides.
TEST(ChooseParts, FollowTheMemoryOfAWorker) {
    for (const std::int64_t memory_mb : {150, 300, 1000, 4000})
        for (const double max_volume : {1e-3, 1e-6, 1e-8, 1e-9}) {
            SCOPED_TRACE(testing::Message() << memory_mb << " MB, volume " << max_volume);
            const MesherOptions mesher = of_size(max_volume);
            const std::int32_t parts = parts_for({.count = 2, .memory_mb = memory_mb}, max_volume, 1, 1'000'000);
            EXPECT_GE(parts, 8);
            const auto needed_mb = [&](double k) {
                return (forecast({1e5, 2e5, 1}, mesher).memory_bytes - forecast({}, {}).memory_bytes) / k / (1 << 20);
            };
            EXPECT_LT(needed_mb(parts), static_cast<double>(memory_mb));
            if (parts > 8) {
                EXPECT_GT(2.0 * needed_mb(parts - 1), static_cast<double>(memory_mb) - 100);
            }
        }
    EXPECT_THROW(parts_for({.count = 2, .memory_mb = 50}, 0, 1, 100), Error);
}

std::vector<PartReport> random_parts(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<PartReport> parts(std::uniform_int_distribution<std::size_t>(1, 40)(random));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].id = NodeId(parts.size() + i);
        parts[i].surface_facets = std::uniform_int_distribution<std::int64_t>(100, 3'000'000)(random);
        parts[i].tets_at_facets =
            std::uniform_real_distribution<double>(0.5, 3)(random) * static_cast<double>(parts[i].surface_facets);
        parts[i].surface_volume = std::uniform_real_distribution<double>(0, 1)(random);
        parts[i].sized_volume = parts[i].surface_volume;
    }
    return parts;
}

Forecast forecast_of(const PartReport& part, const MesherOptions& mesher) {
    return forecast({static_cast<double>(part.surface_facets), part.tets_at_facets, part.sized_volume}, mesher);
}

bool holds_words(const std::string& line, const std::string& words) {
    return fmt::format(" {} ", line).find(fmt::format(" {}", words)) != std::string::npos;
}

// The plan is what the forecasts of the parts add up to: all tetrahedra, no less time than the largest part takes or
// than the workers need together, and the memory of the largest part.
TEST(PlanText, SaysWhatTheForecastsOfItsPartsAddUpTo) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const std::vector<PartReport> parts = random_parts(seed);
        const MesherOptions mesher = of_size(seed % 2 ? 1e-5 : 0);
        const int workers = (1 + static_cast<int>(seed % 3)) * (1 + static_cast<int>(seed % 5));
        Forecast all, largest;
        std::vector<Forecast> each;
        for (const PartReport& part : parts) {
            const Forecast one = each.emplace_back(forecast_of(part, mesher));
            all.tets += one.tets;
            all.seconds += one.seconds;
            if (one.tets > largest.tets) largest = one;
        }
        const double pace = seed % 2 ? 1 : 0.01;
        const double seconds = pace * std::max(largest.seconds, all.seconds / workers);
        const std::vector<std::string> plan = test::lines_of(plan_text(parts, mesher, workers, false, pace));
        ASSERT_EQ(plan.size(), 1U);
        for (const std::string& words :
             {fmt::format("{} parts", parts.size()), fmt::format("{} worker", workers), short_number(all.tets),
              seconds < 0.05 ? "less than 0.1 s" : fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0),
              short_number(largest.tets), fmt::format("{:.0f} MB", largest.memory_bytes / (1 << 20))})
            EXPECT_TRUE(holds_words(plan[0], words)) << words << " in " << plan[0];

        const std::vector<std::string> table = test::lines_of(plan_text(parts, mesher, workers, true, pace));
        ASSERT_EQ(table.size(), 2 + parts.size());
        EXPECT_EQ(table[0], plan[0]);
        for (std::size_t i = 0; i < parts.size(); ++i)
            for (const std::string& words : {std::to_string(parts[i].id.value()), fmt::format("{:.0f}", each[i].tets)})
                EXPECT_TRUE(holds_words(table[2 + i], words)) << words << " in " << table[2 + i];
    }
}

TEST(PlanText, SaysWhatTheFirstRankHasTaken) {
    EXPECT_EQ(plan_text(12.34, 878 << 20), "before      12 s to read and to cut, 878 MB on the first rank\n");
    EXPECT_EQ(plan_text(0.01, 30 << 20), "before      less than 0.1 s to read and to cut, 30 MB on the first rank\n");
}

TEST(PaceOfReading, IsThatOfTheMachineWithinBounds) {
    EXPECT_NEAR(pace_of_reading(0.203, 1e5), 1, 1e-9);
    EXPECT_NEAR(pace_of_reading(1.015, 1e5), 5, 1e-9) << "busy with others";
    EXPECT_EQ(pace_of_reading(0, 1e5), 0.5);
    EXPECT_EQ(pace_of_reading(1e6, 1e5), 20) << "a disk that sleeps says nothing of workers";
}

// Bodies have fewer tetrahedra than the forecast says and take longer: the first part that has ended corrects both.
TEST(RunningForecast, LearnsFromThePartsThatHaveEnded) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        std::vector<PartReport> parts = random_parts(seed);
        const MesherOptions mesher = of_size(1e-6);
        parts.front().resumed = true;
        double forecast_tets = 0, tets = 0, seconds = 0;
        std::vector<PartReport> ended = parts;
        for (PartReport& part : ended) {
            const Forecast f = forecast_of(part, mesher);
            forecast_tets += f.tets;
            part.result.tets = std::llround(0.64 * f.tets);
            tets += static_cast<double>(part.result.tets);
            part.seconds = part.resumed ? 1e9 : 7 * f.seconds;  // of another machine, and of this one
            if (!part.resumed) seconds += part.seconds;
        }
        RunningForecast running(parts, mesher, 6);
        EXPECT_NEAR(running.tets(), forecast_tets, 1e-6 * forecast_tets);
        EXPECT_LT(running.seconds_left(1), 0) << "nobody knows";
        for (std::size_t i = 0; i < ended.size(); ++i) {
            running.add(ended[i]);
            EXPECT_NEAR(running.tets(), tets, 1e-3 * tets);
            if (i == 0) {
                EXPECT_LT(running.seconds_left(1), 0);
                continue;
            }
            EXPECT_NEAR(running.seconds_left(0.01 * seconds), seconds / 6 - 0.01 * seconds, 1e-6 * seconds);
            EXPECT_EQ(running.seconds_left(seconds), 0);
        }
        EXPECT_NEAR(running.tets(), tets, 1e-9 * tets);
    }
}

}  // namespace
}  // namespace kerf
