// Every criterion with every balance: valid, the wanted number of parts, and the halves are alike in what was asked
// for.
#include <algorithm>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "run/run/pipeline.h"
#include "support/assets.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

constexpr Criterion criteria[] = {Criterion::inertia, Criterion::volume, Criterion::equidistant};
const std::vector<Balance> balances = {Balance::nodes, Balance::faces, Balance::volume, Balance::inertia,
                                       Balance::work};

// Keeps how far each plane of a first try lies from the middle of its body, relative to the extent.
class PlaneWitness : public RunListener {
 public:
    void on_progress(const char*, std::size_t, std::size_t) override {}
    bool wants_cuts() const override { return true; }
    void on_cut(const Surface& parent, const Cut& cut) override {
        normals.push_back(cut.plane.normal);
        if (cut.strategy != CutStrategy::first_try && cut.strategy != CutStrategy::local_repair) return;
        double low = 0, high = 0;
        for (const Vertex v : parent.vertices()) {
            low = std::min(low, cut.plane.distance(parent.point(v)));
            high = std::max(high, cut.plane.distance(parent.point(v)));
        }
        off_middle.push_back((high + low) / 2 / (high - low));
    }
    std::vector<Vec3> normals;
    std::vector<double> off_middle;
};

class CutRuns : public testing::TestWithParam<std::string> {
 protected:
    RunReport decomposed(const DecomposeOptions& decompose, RunListener* listener = nullptr) {
        RunRequest options;
        options.input = test::asset_path(GetParam());
        options.output = folder_.file("out");
        options.volume = false;
        options.workers.count = 2;
        options.parts = decompose.parts;
        options.cut = decompose.cut;
        SingleRank rank;
        RunReport report = run(options, 2, rank, listener);
        EXPECT_EQ(report.exit_code, 0);
        EXPECT_TRUE(report.verification.passed);
        EXPECT_EQ(report.parts.size(), static_cast<std::size_t>(decompose.parts));
        return report;
    }

    test::TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Assets, CutRuns, testing::Values("bearing_cap_14k", "pipe_with_holes", "sinter_packing"),
                         [](const auto& param) { return param.param; });

// Largest part over the mean, less 1.
double imbalance(const RunReport& report, const LoadModel& model) {
    double most = 0, sum = 0;
    for (const PartReport& part : report.parts) {
        const double load = model.load(static_cast<double>(part.surface_vertices),
                                       static_cast<double>(part.surface_facets), part.surface_volume);
        most = std::max(most, load);
        sum += load;
    }
    return most * static_cast<double>(report.parts.size()) / sum - 1;
}

TEST_P(CutRuns, EveryCriterionBalancesWhatWasAskedFor) {
    for (const Criterion criterion : criteria)
        for (const Balance balance : balances) {
            SCOPED_TRACE(testing::Message() << "criterion " << int(criterion) << ", balance " << int(balance));
            DecomposeOptions options;
            options.parts = 4;
            options.cut.criterion = criterion;
            options.cut.balance = balance;
            PlaneWitness planes;
            const RunReport report = decomposed(options, &planes);
            ASSERT_EQ(planes.normals.size(), 3u);
            for (const Vec3& normal : planes.normals)
                EXPECT_TRUE(criterion == Criterion::inertia || normal.maxCoeff() == 1) << "no coordinate axis";
            if (criterion == Criterion::equidistant) {
                EXPECT_FALSE(planes.off_middle.empty());
                for (const double off : planes.off_middle) EXPECT_NEAR(off, 0, 1e-12);
            } else if (options.cut.bisected_load().balance != Balance::inertia) {  // equal moments, unequal volumes
                EXPECT_LT(imbalance(report, options.cut.bisected_load()), 0.1);
            }
        }
}

// Prepartition: K slabs one behind the other.
TEST_P(CutRuns, OneDirectionGivesSlabsForAnyNumberOfParts) {
    for (const Criterion criterion : criteria)
        for (const std::int32_t parts : {2, 3, 5, 6}) {
            SCOPED_TRACE(testing::Message() << "criterion " << int(criterion) << ", " << parts << " slabs");
            DecomposeOptions options;
            options.parts = parts;
            options.cut.criterion = criterion;
            options.cut.axis = 0;
            PlaneWitness planes;
            const RunReport report = decomposed(options, &planes);
            for (const Vec3& normal : planes.normals) EXPECT_EQ(normal, Vec3::UnitX());
            for (std::size_t i = 0; i < report.parts.size(); ++i) {
                std::vector<NodeId> beside;
                if (i > 0) beside.push_back(report.parts[i - 1].id);
                if (i + 1 < report.parts.size()) beside.push_back(report.parts[i + 1].id);
                std::sort(beside.begin(), beside.end());
                EXPECT_EQ(report.parts[i].neighbours, beside);
            }
        }
}

}  // namespace
}  // namespace kerf
