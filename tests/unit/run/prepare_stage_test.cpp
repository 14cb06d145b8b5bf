// What parts are told before they are meshed: the same for any number of ranks.
#include "run/run/prepare_stage.h"

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "run/prepare/gathered_nodes.h"
#include "run/run/cut_stage.h"
#include "support/assets.h"
#include "support/counting_ranks.h"
#include "support/thread_ranks.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

struct Preparation {
    std::vector<Bytes> jobs, reports;  // of all parts, in the order of the tree
    std::int64_t surface_vertices = -1, shared_edges = 0, contacts = 0;
    std::vector<test::Traffic> traffic;  // of each rank in this stage

    void add(PreparedParts prepared) {
        surface_vertices = prepared.surface_vertices;
        EXPECT_EQ(prepared.unmatched_interface_facets, 0);
        EXPECT_EQ(prepared.missing_input_facets, 0);
        for (OwnPart& part : prepared.own) {
            part.report.rank = 0;
            for (const SharedEdgeGroup& group : part.job.shared_edges) shared_edges += std::ssize(group.edges);
            contacts += std::ssize(part.job.contact_vertices);
            jobs.push_back(to_bytes(part.job));
            reports.push_back(to_bytes(part.report));
        }
    }
};

Preparation prepare_on(int size, const std::function<Input()>& read, const RunRequest& request) {
    RunPlan plan;
    plan.choices = choices_of(request);
    std::vector<PreparedParts> of_ranks(size);
    Preparation all;
    all.traffic.resize(size);
    test::run_ranks(size, [&](Communicator& ranks) {
        Input input = read();
        Decomposition own = cut_surface(ranks, input, plan, nullptr);
        const std::vector<TreeNode> nodes = gather_nodes(ranks, own.nodes, "host");
        test::CountingRanks counting(ranks);
        of_ranks[ranks.rank()] = prepare_parts(counting, input, nodes, std::move(own), plan);
        all.traffic[ranks.rank()] = counting.traffic();
    });
    for (PreparedParts& prepared : of_ranks) all.add(std::move(prepared));
    return all;
}

RunRequest in_parts(std::int32_t parts, ContourMethod contour = ContourMethod::min_cut) {
    RunRequest options;
    options.parts = parts;
    options.cut.contour = contour;
    return options;
}

void expect_the_same_for_any_ranks(const char* what, const std::function<Input()>& read, const RunRequest& options) {
    const Preparation alone = prepare_on(1, read, options);
    EXPECT_GT(alone.shared_edges, 0) << what;
    for (const int size : {2, 4, 8}) {
        const Preparation together = prepare_on(size, read, options);
        EXPECT_EQ(together.surface_vertices, alone.surface_vertices) << what << " on " << size;
        EXPECT_TRUE(together.jobs == alone.jobs) << what << " on " << size;
        EXPECT_TRUE(together.reports == alone.reports) << what << " on " << size;
    }
}

// Sizes weigh the load of a forecast as that of a run, so that both begin with nearly the same cut: the interface of
// the forecast stays coarse, and other contours may be refused for it.
TEST(CutSurface, BeginsAForecastAsARun) {
    RunPlan plan;
    plan.choices = choices_of(in_parts(2));
    test::run_ranks(1, [&](Communicator& alone) {
        const auto leaves = [&] {
            Input input = read_input(test::asset_path("hollow_box"));
            return cut_surface(alone, input, plan, nullptr).leaves;
        };
        const std::vector<Leaf> without_sizes = leaves();
        SizeSources sources;
        sources.growth = 0.2;
        sources.spheres.push_back({without_sizes[0].surface.vertices[0], 0.2, 0.05});
        plan.size = SizeField(0.1, sources);
        const std::vector<Leaf> of_run = leaves();
        plan.choices.request.dry_run = true;
        const std::vector<Leaf> of_forecast = leaves();
        ASSERT_EQ(of_run.size(), 2U);
        ASSERT_EQ(of_forecast.size(), 2U);
        EXPECT_GT(std::abs(of_run[0].volume / without_sizes[0].volume - 1), 0.01) << "sizes must matter";
        EXPECT_NEAR(of_forecast[0].volume, of_run[0].volume, 1e-3 * of_run[0].volume);
        EXPECT_LT(of_forecast[0].surface.facets.size(), of_run[0].surface.facets.size());
    });
}

TEST(PrepareParts, TellsPartsTheSameForAnyNumberOfRanks) {
    const auto asset = [](const char* name) { return [name] { return read_input(test::asset_path(name)); }; };
    expect_the_same_for_any_ranks("hollow box", asset("hollow_box"), in_parts(13));
    expect_the_same_for_any_ranks("straight cuts", asset("hollow_box"), in_parts(6, ContourMethod::straight));
    expect_the_same_for_any_ranks("pipe", asset("pipe_with_holes"), in_parts(9));
}

// Parts that touch each other without a facet between them, too.
TEST(PrepareParts, TellsPartsOfRegionsTheSameForAnyNumberOfRanks) {
    std::int64_t contacts = 0;
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        const test::VoxelBody body = test::voxel_body(bodies.cubes, bodies.region);
        const auto read = [&] {
            return make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
        };
        const RunRequest options = in_parts(static_cast<std::int32_t>(body.names.size()) + 3);
        expect_the_same_for_any_ranks(bodies.name, read, options);
        contacts += prepare_on(1, read, options).contacts;
    }
    EXPECT_GT(contacts, 0);
}

// The bytes of the busiest rank fall as its share does; it says something to each other rank a few times.
TEST(PrepareParts, CostsARankLessWhereThereAreMore) {
    const auto read = [] { return read_input(test::asset_path("bearing_cap_14k")); };
    std::map<int, std::int64_t> most_bytes;
    for (const int size : {2, 4, 8})
        for (const test::Traffic& traffic : prepare_on(size, read, in_parts(16)).traffic) {
            most_bytes[size] = std::max(most_bytes[size], traffic.bytes());
            EXPECT_LE(traffic.messages, 10 * size + 30) << size;
        }
    EXPECT_LT(static_cast<double>(most_bytes[8]), 0.6 * static_cast<double>(most_bytes[2]));
}

// Every rank has those of all parts.
TEST(PrepareParts, ReportsOfPartsTakeAFewKilobytes) {
    const auto read = [] { return read_input(test::asset_path("cube")); };
    for (const Bytes& report : prepare_on(1, read, in_parts(2)).reports) EXPECT_LT(report.size(), 4096u);
}

}  // namespace
}  // namespace kerf
