// What other ranks have of a plan is what the first one has. Ranks are threads here.
#include "run/run/plan.h"

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/temporary_folder.h"
#include "support/thread_ranks.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

std::vector<PlannedRun> plans_of_ranks(int size, const RunRequest& request) {
    std::vector<PlannedRun> plans(static_cast<std::size_t>(size));
    test::run_ranks(size, [&](Communicator& ranks) {
        plans[static_cast<std::size_t>(ranks.rank())] = plan_run(request, 2 + ranks.rank(), ranks, nullptr);
    });
    return plans;
}

bool have_same_sizes(const SizeField& a, const SizeField& b, const Vec3& low, double length) {
    if (to_bytes(a) != to_bytes(b)) return false;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = low + length * Vec3(i % 10, i / 10 % 10, i / 100) / 9;
        if (a.at(p) != b.at(p)) return false;
    }
    return true;
}

void expect_same(const PlannedRun& a, const PlannedRun& b) {
    EXPECT_TRUE(to_bytes(option_texts(a.plan.request(), false)) == to_bytes(option_texts(b.plan.request(), false)));
    const DecomposeOptions cuts = a.plan.decompose_options(), others = b.plan.decompose_options();
    EXPECT_EQ(cuts.parts, others.parts);
    EXPECT_EQ(cuts.region_sizes.max_volumes(), others.region_sizes.max_volumes());
    EXPECT_EQ(cuts.cut.volume_weight, others.cut.volume_weight);
    const Vec3 low = Vec3::Constant(-a.input.largest_coordinate);
    const double length = 2 * a.input.largest_coordinate;
    EXPECT_TRUE(have_same_sizes(cuts.cut.size, others.cut.size, low, length));
    EXPECT_TRUE(to_bytes(a.plan.mesher()) == to_bytes(b.plan.mesher()));
    EXPECT_EQ(a.plan.found_size.has_value(), b.plan.found_size.has_value());
    EXPECT_EQ(a.plan.surface_nodes.edges, b.plan.surface_nodes.edges);
    EXPECT_EQ(a.plan.surface_nodes.points, b.plan.surface_nodes.points);
    EXPECT_EQ(a.input.file_hash, b.input.file_hash);
    EXPECT_EQ(a.input.patch_names, b.input.patch_names);
    ASSERT_EQ(a.input.regions.size(), b.input.regions.size());
    for (std::size_t r = 0; r < a.input.regions.size(); ++r)
        EXPECT_EQ(a.input.regions[r].volume, b.input.regions[r].volume) << r;
    EXPECT_EQ(a.input.notes, b.input.notes);
    EXPECT_EQ(std::pair(a.input.facets, a.input.diagonal), std::pair(b.input.facets, b.input.diagonal));
    const bool has_regions = a.input.complex.region_count() > 1;
    EXPECT_EQ(b.input.complex.facet_count(), has_regions ? a.input.complex.facet_count() : 0);
    EXPECT_TRUE(!has_regions || to_bytes(b.input.complex.arrays()) == to_bytes(a.input.complex.arrays()));
}

class PlanOnRanks : public testing::Test {
 protected:
    RunRequest request(const std::string& input) const {
        RunRequest options;
        options.input = input;
        options.output = folder_.file("out");
        options.dry_run = true;
        return options;
    }
    static void expect_same_on_all(const RunRequest& request) {
        const std::vector<PlannedRun> plans = plans_of_ranks(3, request);
        EXPECT_GT(plans[0].input.facets, 0);
        for (const PlannedRun& other : {plans[1], plans[2]}) expect_same(plans[0], other);
    }
    test::TemporaryFolder folder_;
};

TEST_F(PlanOnRanks, IsTheSameForAllWaysToAskForSizes) {
    RunRequest options = request(test::asset_path("hollow_box"));
    expect_same_on_all(options);
    options.sizes.size = Length::percent(5);
    options.deviation = Length::percent(1);
    options.input_options.repairs.weld_tolerance = 1e-9;
    expect_same_on_all(options);
    options.sizes.inside = {"sphere:0,0,0,1=0.1"};
    options.sizes.growth = 0.3;
    expect_same_on_all(options);
    options.sizes.size = 0;
    options.sizes.cells = 20000;
    options.mesher.name = "tetgen";
    expect_same_on_all(options);
}

TEST_F(PlanOnRanks, IsTheSameForARemeshedSurfaceWithNodesOnEdges) {
    RunRequest options = request(test::asset_path("cylinder"));
    options.remeshing = Remeshing::always;
    options.sizes.fineness = Fineness::coarse;
    options.order = 2;
    expect_same_on_all(options);
}

TEST_F(PlanOnRanks, HasTheSurfaceOfRegionsEverywhere) {
    const std::array<std::int32_t, 3> cubes = {4, 4, 4};
    test::write_tets(folder_.file("grains.mesh"), cubes, test::grains(cubes, 3, 2));
    RunRequest options = request(folder_.file("grains.mesh"));
    options.parts = 1;  // a note says that there are more
    options.sizes.size = 0.5;
    const Input input = plans_of_ranks(1, options)[0].input;
    options.sizes.in_region = {input.complex.region_names()[0] + "=0.25"};
    expect_same_on_all(options);
}

TEST_F(PlanOnRanks, AnErrorOfTheFirstRankIsThrownOnAll) {
    test::run_ranks(3, [&](Communicator& ranks) {
        try {
            plan_run(request(folder_.file("missing.stl")), 1, ranks, nullptr);
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::io);
            EXPECT_NE(std::string(error.what()).find("missing.stl"), std::string::npos);
        }
    });
}

}  // namespace
}  // namespace kerf
