// The laws of whole runs, for every asset and many numbers of parts: in the report, and again from the files.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/assets.h"
#include "support/checked_run.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

using test::FinishedRun;
using test::run_and_check;

class AllAssets : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Assets, AllAssets, testing::ValuesIn(test::asset_names()),
                         [](const auto& param) { return param.param; });

TEST_P(AllAssets, ObeyEveryLawForAnyNumberOfParts) {
    for (const std::int32_t parts : {1, 2, 3, 5, 8}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        run_and_check(test::asset_path(GetParam()), parts);
    }
}

// What is asked of it on good surfaces, in several parts at once.
TEST_P(AllAssets, HaveBetterCellsForTheImprovement) {
    const std::string asset = test::asset_path(GetParam());
    const FinishedRun raw = run_and_check(asset, 3, nullptr, false), better = run_and_check(asset, 3);
    const Distribution &was = raw.report.mesh.quality.all.measures[0], &is = better.report.mesh.quality.all.measures[0];
    EXPECT_GE(is.min(), was.min());
    EXPECT_GE(is.percentile(0.01), 1.5 * was.percentile(0.01));
    EXPECT_EQ(better.report.mesh.improvement.smallest_before.count(), raw.report.mesh.tets);
    EXPECT_TRUE(raw.report.mesh.improvement.is_empty());
    EXPECT_EQ(better.report.mesh.vertices, raw.report.mesh.vertices + better.report.mesh.improvement.new_vertices);
}

class ManyParts : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Assets, ManyParts,
                         testing::Values("bearing_cap_14k", "hollow_box", "knee_tibial", "sinter_packing",
                                         "wing_in_box"),
                         [](const auto& param) { return param.param; });

TEST_P(ManyParts, ObeyEveryLaw) {
    for (const std::int32_t parts : {16, 32}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        run_and_check(test::asset_path(GetParam()), parts);
    }
}

class CutCollector : public RunListener {
 public:
    void on_progress(const char*, std::size_t, std::size_t) override { ++steps; }
    bool wants_cuts() const override { return true; }
    void on_cut(const Surface& parent, const Cut& cut) override {
        EXPECT_EQ(cut.side.size(), static_cast<std::size_t>(parent.facet_count()));
        EXPECT_EQ(cut.stages.crossed_edges.empty(), cut.loops.empty()) << "between bodies nothing is crossed";
        ++cuts;
    }
    int cuts = 0, steps = 0;
};

TEST(RunLaws, ListenerChangesNothing) {
    for (const std::string asset : {"hollow_box", "knee_femoral"}) {
        SCOPED_TRACE(asset);
        CutCollector listener;
        const FinishedRun with = run_and_check(test::asset_path(asset), 5, &listener);
        const FinishedRun without = run_and_check(test::asset_path(asset), 5);
        EXPECT_EQ(listener.cuts, 4);
        EXPECT_GT(listener.steps, 5);
        EXPECT_EQ(with.report.mesh.hash, without.report.mesh.hash);
    }
}

class Transformed : public testing::TestWithParam<std::string> {
 protected:
    Transformed() : surface_(test::asset_surface(GetParam()).arrays()) {}

    std::string written() const {
        test::write_off(folder_.file("input.off"), surface_.vertices, surface_.facets);
        return folder_.file("input.off");
    }

    test::TemporaryFolder folder_;
    SurfaceArrays surface_;
};
INSTANTIATE_TEST_SUITE_P(Assets, Transformed, testing::Values("hollow_box", "cylinder", "pipe_with_holes"),
                         [](const auto& param) { return param.param; });

TEST_P(Transformed, PowersOfTwoLeaveTheTopology) {
    const FinishedRun original = run_and_check(written(), 3);
    for (const int exponent : {-20, 9}) {
        SCOPED_TRACE(exponent);
        SurfaceArrays scaled = surface_;
        for (Vec3& p : scaled.vertices) p *= std::ldexp(1.0, exponent);
        test::write_off(folder_.file("scaled.off"), scaled.vertices, scaled.facets);
        const FinishedRun run = run_and_check(folder_.file("scaled.off"), 3);
        ASSERT_EQ(run.parts.size(), original.parts.size());
        for (std::size_t i = 0; i < run.parts.size(); ++i) {
            EXPECT_EQ(run.parts[i].mesh.tets, original.parts[i].mesh.tets);
            EXPECT_EQ(run.parts[i].global_id, original.parts[i].global_id);
        }
    }
}

TEST_P(Transformed, RigidMotionKeepsTheLaws) {
    const Eigen::AngleAxisd rotation(0.7, Vec3(1, 2, 3).normalized());
    for (Vec3& p : surface_.vertices) p = rotation * p + Vec3(40, -30, 20);
    run_and_check(written(), 8);
}

TEST_P(Transformed, OrderOfVerticesAndFacetsKeepsTheLaws) {
    std::mt19937 random(20);
    std::vector<std::int32_t> order(surface_.vertices.size()), number(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Vec3> vertices;
    for (std::size_t i = 0; i < order.size(); ++i) {
        vertices.push_back(surface_.vertices[order[i]]);
        number[order[i]] = static_cast<std::int32_t>(i);
    }
    surface_.vertices = vertices;
    for (Triangle& t : surface_.facets)
        for (std::int32_t& v : t) v = number[v];
    std::shuffle(surface_.facets.begin(), surface_.facets.end(), random);
    run_and_check(written(), 8);
}

// The checks above must be able to fail.
TEST(RunLaws, EveryDamageIsFound) {
    const test::TemporaryFolder folder;
    test::run_parts(test::asset_path("hollow_box"), folder.file("out"), 3);
    const std::vector<Part> good = test::read_parts(folder.file("out"));
    const SurfaceArrays input = test::asset_surface("hollow_box").arrays();
    ASSERT_EQ(test::broken_laws(good, input), "");
    const auto expect_found = [&](const char* law, const auto& damage) {
        std::vector<Part> parts = good;
        damage(parts);
        EXPECT_NE(test::broken_laws(parts, input).find(law), std::string::npos) << law;
    };
    const auto first_interface_facet = [](const Part& part) {
        return std::find_if(part.neighbour.begin(), part.neighbour.end(), [](NodeId n) { return n.is_valid(); }) -
               part.neighbour.begin();
    };
    expect_found("at different places", [](auto& parts) {
        for (Part& part : parts) part.mesh.vertices[part.facets.back()[0]].x() += 1e-12 * part.id.value();
    });
    expect_found("gaps", [](auto& parts) { parts[0].global_id.back() += 1000000; });
    expect_found("not positive", [](auto& parts) { std::swap(parts[1].mesh.tets[0][0], parts[1].mesh.tets[0][1]); });
    expect_found("not the boundary", [](auto& parts) { parts[1].mesh.tets.pop_back(); });
    expect_found("not the enclosed", [](auto& parts) { parts[2].mesh.tets.pop_back(); });
    expect_found("once in the input", [](auto& parts) { parts[0].neighbour[0] = NodeId(77); });
    expect_found("without a facet of the input", [](auto& parts) { parts[0].patch[0] = 77; });
    expect_found("without a facet of the input", [](auto& parts) { parts[0].facet[0] = 1 << 30; });
    expect_found("other side", [&](auto& parts) { parts[0].neighbour[first_interface_facet(parts[0])] = NodeId(77); });
    expect_found("other side", [&](auto& parts) {
        Triangle& t = parts[0].facets[first_interface_facet(parts[0])];
        std::swap(t[1], t[2]);
    });
}

}  // namespace
}  // namespace kerf
