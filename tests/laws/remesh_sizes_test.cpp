// Edges of remeshed surfaces over the lengths that a size field asks for, alone and in runs of one part and of many.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/geometry/box.h"
#include "run/prepare/remeshing.h"
#include "run/run/pipeline.h"
#include "support/places.h"
#include "support/shapes.h"
#include "support/size_fields.h"
#include "support/slice.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "surface/remesh/remesh.h"
#include "surface/remesh/thickness.h"
#include "surface/size/mean_edge.h"
#include "surface/size/size_options.h"

namespace kerf {
namespace {

using namespace test;

// Lengths of edges over the size wanted in their middle, ascending. Each counts once for each of its facets.
std::vector<double> got_over_asked(const SurfaceArrays& surface, const SizeField& field) {
    std::vector<double> ratios;
    for (const Triangle& t : surface.facets)
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = surface.vertices[t[i]], &b = surface.vertices[t[(i + 1) % 3]];
            ratios.push_back((b - a).norm() / field.at((a + b) / 2));
        }
    std::sort(ratios.begin(), ratios.end());
    return ratios;
}

double share_below(const std::vector<double>& ratios, double limit) {
    return static_cast<double>(std::upper_bound(ratios.begin(), ratios.end(), limit) - ratios.begin()) /
           static_cast<double>(ratios.size());
}

RemeshOptions options_for(const SurfaceArrays& surface, const SizeField& field) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.vertices) box.extend(p);
    const double diagonal = box.diagonal().norm();
    return {.deviation = 2e-5 * diagonal,
            .longest = 0.2 * diagonal,
            .growth = field.growth() > 0 ? field.growth() : 0.4,
            .wanted = [&](const Vec3& p, std::int32_t) { return field.at(p); }};
}

SurfaceArrays remeshed(const SurfaceArrays& surface, const SizeField& field) {
    return remesh(surface, options_for(surface, field)).surface;
}

struct Case {
    std::string name;
    Soup soup;
    SizeOptions options;
    std::optional<SizedMesh> background;
};

// A cube of side 10 with a void.
Soup hollow_cube(int n) {
    return join(box(Vec3::Zero(), Vec3(10, 10, 10), n), inside_out(box(Vec3(3, 3, 3), Vec3(7, 7, 7), n)));
}

// Sizes of every kind in bodies whose shape asks for none.
std::vector<Case> cases() {
    std::vector<Case> all;
    const std::vector<double> sizes = {2.0, 0.71, 0.5, 0.3}, finer = {0.5, 0.3};
    for (const double size : slice(sizes, {2.0, 0.71})) {
        all.push_back({"constant", hollow_cube(1), {}, {}});
        all.back().options.size = size;
    }
    for (const double size : slice(finer, {0.5})) {
        all.push_back({"constant, on small facets", hollow_cube(13), {}, {}});
        all.back().options.size = size;
    }
    all.push_back({"a fine sphere", box(Vec3::Zero(), Vec3(10, 10, 10), 1), {}, {}});
    all.back().options.size = 1;
    all.back().options.inside = {"sphere:3,4,10,2=0.2"};
    all.push_back({"a patch at a tenth of the size", box(Vec3::Zero(), Vec3(10, 10, 10), 1), {}, {}});
    Soup& soup = all.back().soup;
    soup.patch_names = {"sides", "fine"};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto is_at_0 = [&](std::int32_t v) { return soup.vertices[static_cast<std::size_t>(v)].x() == 0; };
        soup.patch[f] = std::all_of(soup.facets[f].begin(), soup.facets[f].end(), is_at_0);
    }
    all.back().options.size = 2;
    all.back().options.on = {"fine=0.2"};
    all.push_back({"a background mesh", box(Vec3::Zero(), Vec3(10, 10, 10), 1), {}, {}});
    all.back().background = sized_grid(Vec3::Zero(), Vec3(10, 10, 10), 10, [](const Vec3& p) {
        return 0.4 + 0.2 * std::min((p - Vec3(2, 2, 2)).norm(), (p - Vec3(9, 9, 9)).norm());
    });
    return all;
}

TEST(RemeshedSizes, AreObeyed) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name + " " + std::to_string(c.options.size));
        const SurfaceArrays surface = to_arrays(c.soup);
        const SizeField field = make_size_field(c.options, surface, c.soup.patch_names, c.background);
        const SurfaceArrays result = remeshed(surface, field);
        const std::vector<double> ratios = got_over_asked(result, field);
        EXPECT_GT(share_below(ratios, 1.4) - share_below(ratios, 0.7), 0.9);
        EXPECT_LT(ratios.back(), 1.5);
        const double share = forecast_facets(surface, options_for(surface, field)) / result.facets.size();
        EXPECT_GT(share, 0.8);
        EXPECT_LT(share, 1.2);
    }
}

// What the shape asks for may be finer.
TEST(RemeshedSizes, AreNotExceededOnCurvedBodies) {
    for (const Soup& soup : {torus(1, 0.4, 40, 16), prism(40, 1, 2), icosphere(3)})
        for (const double size : slice(std::vector<double>{0.2, 0.07}, {0.2})) {
            const SurfaceArrays surface = to_arrays(soup);
            SizeOptions options;
            options.size = size;
            const SizeField field = make_size_field(options, surface, soup.patch_names, {});
            const std::vector<double> ratios = got_over_asked(remeshed(surface, field), field);
            EXPECT_GT(share_below(ratios, 1.4), 0.99);
        }
}

// A size is the mean edge of the mesh within 5 %, or 6 where sizes differ, or a bound that less than one edge in a
// hundred exceeds, whether facets are divided or remeshed. Ratios are to what the field asks, so that cells are
// counted, too: for a bound there are four times as many.
TEST(Sizes, AreMeanEdgesOrBounds) {
    const TemporaryFolder folder;
    const Soup soup = box(Vec3::Zero(), Vec3(10, 8, 6), 1);
    write_off(folder.file("input.off"), soup.vertices, soup.facets);
    for (const Remeshing remeshing : {Remeshing::where_needed, Remeshing::always})
        for (const bool is_graded : {false, true}) {
            std::int64_t cells_of_mean = 0;
            for (const SizeMeaning meaning : {SizeMeaning::mean, SizeMeaning::bound}) {
                SCOPED_TRACE(testing::Message()
                             << static_cast<int>(meaning) << static_cast<int>(remeshing) << is_graded);
                RunRequest options;
                options.input = folder.file("input.off");
                options.output = folder.file("out");
                options.workers.program = test::worker_program();
                options.workers.count = 2;
                options.parts = 2;
                options.remeshing = remeshing;
                options.sizes.size = 1;
                options.sizes.meaning = meaning;
                if (is_graded) options.sizes.inside = {"sphere:3,4,5,1=0.5"};
                SingleRank rank;
                const RunReport report = run(options, 2, rank);
                ASSERT_EQ(report.exit_code, 0);
                EXPECT_NEAR(report.mesh.sizes.mean(), 1, is_graded ? 0.06 : 0.05);
                const double beyond = report.mesh.sizes.share_from(1 / options.sizes.mean_over_size());
                if (meaning == SizeMeaning::mean) {
                    cells_of_mean = report.mesh.tets;
                    EXPECT_GT(beyond, 0.3);
                } else {
                    EXPECT_LT(beyond, 0.01);
                    EXPECT_GT(report.mesh.tets, 3 * cells_of_mean);
                }
            }
        }
}

// The surface is remeshed before it is cut: it is the same in one part and in many, and all obey the field.
TEST(RemeshedSizes, AreObeyedInOnePartAndInMany) {
    const TemporaryFolder folder;
    const Soup soup = box(Vec3::Zero(), Vec3(10, 10, 10), 1);
    write_off(folder.file("input.off"), soup.vertices, soup.facets);
    std::vector<RunReport> reports;
    for (const std::int32_t parts : {1, 8}) {
        SCOPED_TRACE(parts);
        RunRequest options;
        options.input = folder.file("input.off");
        options.output = folder.file("out");
        options.workers.program = test::worker_program();
        options.workers.count = 2;
        options.parts = parts;
        options.remeshing = Remeshing::always;
        options.sizes.size = 0.5;
        options.sizes.inside = {"sphere:3,4,10,1=0.15"};
        SingleRank rank;
        const RunReport& report = reports.emplace_back(run(options, 2, rank));
        ASSERT_EQ(report.exit_code, 0);
        EXPECT_TRUE(report.verification.passed);
        ASSERT_EQ(report.mesh.sizes.by_patch.size(), 1U);
        EXPECT_GT(report.mesh.sizes.inside.share_obeyed(), 0.9);
        EXPECT_GT(report.mesh.sizes.by_patch.front().edges.share_obeyed(), 0.9);
        if (parts > 1) {
            EXPECT_GT(report.mesh.sizes.interfaces.share_obeyed(), 0.9);
        }
    }
    EXPECT_EQ(reports[0].input.facets, reports[1].input.facets);
    EXPECT_EQ(reports[0].input.area, reports[1].input.area);
}

TEST(UsualDeviation, IsATwentiethOfTheShortestWantedEdge) {
    const SurfaceArrays ball = test::to_arrays(test::icosphere(2));
    EXPECT_DOUBLE_EQ(usual_deviation(SizeField(), ball, 100), 0.05);
    const double edge = 0.5;
    EXPECT_DOUBLE_EQ(usual_deviation(SizeField(largest_volume_for(edge)), ball, 100), edge / 20);
    SizeOptions finer;
    finer.size = edge;
    finer.inside = {"sphere:0,0,1,0.3=0.1"};
    EXPECT_DOUBLE_EQ(usual_deviation(make_size_field(finer, ball, {}), ball, 100), 0.1 / 20);
    EXPECT_DOUBLE_EQ(usual_deviation(SizeField(largest_volume_for(1e3)), ball, 100), 5) << "as far as is ever allowed";
}

// A round bar of needles: a bound that has nothing to do with the size would ask for many more facets.
TEST(RemeshedInput, IsAsFineAsItIsWanted) {
    Input input;
    input.complex = Complex(test::to_surface(test::prism(48, 1, 3)));
    measure_input(input);
    input.diagonal = box_around(input.complex.arrays().vertices).diagonal().norm();
    input.patch_names = {"below", "sides", "above"};
    RunRequest options;
    options.remeshing = Remeshing::always;
    double coarser = 0;  // facets
    for (const double size : {0.5, 0.25, 0.125}) {
        options.sizes.size = size;
        options.deviation = 0;
        const Input remeshed = remesh_where_asked(input, options);
        EXPECT_DOUBLE_EQ(remeshed.remeshed->deviation, size / 20);
        EXPECT_LE(remeshed.remeshed->distance_from_input, size / 20);
        const auto facets = static_cast<double>(remeshed.facets);
        EXPECT_GT(facets, 1.2 * coarser) << size;
        if (coarser > 0) {
            EXPECT_LT(facets, 5 * coarser) << size;
        }
        coarser = facets;
        options.deviation = Length::percent(0.002);
        if (size == 0.5) {
            EXPECT_GT(static_cast<double>(remesh_where_asked(input, options).facets), 2 * facets);
        }
    }
}

TEST(WallEdges, AreBoundedAndHopelesslyThinWallsAskForNothing) {
    const WallEdges edges = {.per_thickness = 0.5, .shortest = 1e-3, .longest = 0.3};
    EXPECT_DOUBLE_EQ(edges.of(1), 0.3);
    EXPECT_DOUBLE_EQ(edges.of(0.1), 0.2);
    EXPECT_DOUBLE_EQ(edges.of(1e-4), 1e-3);
    EXPECT_DOUBLE_EQ(edges.of(1e-6), 0.3);
}

// Three bodies, each with one reason for finer edges than asked for.
TEST(FinerShares, NameTheReason) {
    const auto shares = [](const Soup& body, double deviation, double longest) {
        RemeshOptions options = {.deviation = deviation, .longest = longest};
        const Remeshed result = remesh(test::to_arrays(body), options);
        const FinerShares& finer = result.report.finer;
        const FacetsByReason& by = result.report.facets_by;
        const auto facets = std::ssize(result.surface.facets);
        EXPECT_EQ(by.asked + by.bound + by.features + by.walls, facets);
        for (const auto& [share, count] :
             {std::pair(finer.bound, by.bound), {finer.features, by.features}, {finer.walls, by.walls}}) {
            EXPECT_EQ(share > 0, count > 0);
        }
        return finer;
    };
    const FinerShares ball = shares(test::icosphere(4), 1e-3, 1), coarse_ball = shares(test::icosphere(4), 1e-3, 0.05);
    EXPECT_GT(ball.bound, 0.95);
    EXPECT_EQ(ball.features + ball.walls, 0);
    EXPECT_LT(coarse_ball.sum(), 0.01) << "the bound allows that";
    const FinerShares plate = shares(test::box(Vec3::Zero(), Vec3(2, 2, 0.05), {20, 20, 1}), 1e-3, 0.5);
    EXPECT_GT(plate.walls, 0.6);
    EXPECT_EQ(plate.bound, 0);
    const FinerShares bar = shares(test::box(Vec3::Zero(), Vec3(2, 0.2, 0.2), {10, 1, 1}), 1e-3, 0.5);
    EXPECT_GT(bar.features + bar.walls, 0.5);
    EXPECT_EQ(bar.bound, 0);
}

}  // namespace
}  // namespace kerf
