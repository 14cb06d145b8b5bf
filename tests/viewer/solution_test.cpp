// Solutions in the viewer: what is opened, what is drawn, what is said of a place.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "viewer/golden_image.h"
#include "viewer/model/inside/solution.h"
#include "viewer/scene/inside/shapes.h"
#include "viewer/scene/selection.h"
#include "viewer/solved_cube.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

using namespace view;

TEST_F(SolvedCube, IsFoundByItsFolderAndTheOneAbove) {
    for (const char* name : {"out", "out/solution"}) {
        const auto solution = find_solution(folder_->file(name));
        ASSERT_TRUE(solution) << name;
        EXPECT_EQ(solution->mesh, folder_->file("out/mesh"));
        ASSERT_EQ(solution->cases.size(), 4u) << "two cases, two modes";
        EXPECT_EQ(solution->cases[1].name, "fast");
    }
    EXPECT_FALSE(find_solution(folder_->file("out/mesh")));
    write_solution(folder_->file("out/mesh"), folder_->file("astray"), "../nowhere", {""});
    EXPECT_THROW(find_solution(folder_->file("astray")), Error);
}

TEST_F(SolvedCube, IsSeenByItsStressUntilSomebodyChooses) {
    const auto picture = [](const std::string& path, const std::vector<std::string>& more) {
        const std::string png = folder_->file("seen.png");
        std::vector<std::string> all = {"screenshot", folder_->file(path), "-o", png, "--resolution", "320x240"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(run_kerf(all).exit_code, 0);
        return bytes_of_file(png);
    };
    EXPECT_EQ(picture("out", {}), picture("out", {"--color", "von-mises"}));
    EXPECT_EQ(picture("out", {"--color", "part"}), picture("out/mesh", {"--color", "part"}));
    EXPECT_EQ(picture("out", {"--stage", "input"}), picture("out/mesh", {"--stage", "input"}));
    EXPECT_EQ(picture("out/mesh", {}), picture("out/mesh", {"--stage", "tetrahedra"})) << "a finished run";
    for (const bool is_solution : {false, true}) {
        driver_->open(folder_->file(is_solution ? "out" : "out/mesh"));
        driver_->settle();
        EXPECT_EQ(driver_->state().coloring.by, is_solution ? ColorBy::von_mises : ColorBy::part);
        EXPECT_EQ(driver_->app().scene().legend.title.find("von Mises") != std::string::npos, is_solution)
            << driver_->app().scene().legend.title;
    }
}

// Values are linear in x, and so they are in every corner of every triangle, on the surface and in sections.
TEST_F(SolvedCube, HasTheValuesOfItsVertices) {
    ViewState& state = driver_->state();
    for (const bool clipped : {false, true})
        for (int i = static_cast<int>(ColorBy::displacement); i < color_by_count; ++i) {
            state.coloring.by = static_cast<ColorBy>(i);
            state.clip = {clipped, ClipStyle::smooth, Vec3(1, 1, 1).normalized(), 0.5, false};
            driver_->settle();
            const double slope =
                state.coloring.by <= ColorBy::von_mises ? 1 : i - static_cast<int>(ColorBy::stress_xx) + 1;
            std::int64_t corners = 0;
            for_corners([&](const Vec3& p, float value) {
                EXPECT_NEAR(value, slope * p.x(), 1e-5) << name(state.coloring.by);
                ++corners;
            });
            EXPECT_GT(corners, 100);
        }
    state.coloring.by = ColorBy::error;
    driver_->settle();
    for_corners([&](const Vec3&, float value) { EXPECT_EQ(value, 1); });
}

TEST_F(SolvedCube, IsDrawnWhereItMoves) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::displacement;
    state.deformation.factor = 0.5;
    state.deformation.load_case = 1;
    for (const bool clipped : {false, true}) {
        state.clip = {clipped, ClipStyle::cells, Vec3::UnitY(), 0.5, false};
        driver_->settle();
        double farthest = 0;
        for_corners([&](const Vec3& p, float value) {  // x + 0.5 * 2x, and the displacement is 2x
            EXPECT_NEAR(value, p.x(), 1e-5);
            farthest = std::max(farthest, p.x());
        });
        EXPECT_NEAR(farthest, 2, 1e-5);
    }
    EXPECT_NE(driver_->app().scene().legend.title.find("case fast, deformed 0.5 x"), std::string::npos)
        << driver_->app().scene().legend.title;
}

TEST_F(SolvedCube, IsolinesAreWhereTheirValuesAre) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::von_mises;
    state.coloring.isolines = true;
    state.coloring.range = ValueRange{0, 1};
    driver_->settle();
    const BuiltScene& built = driver_->app().scene();
    std::int64_t lines = 0;
    for (const Layer& layer : built.scene.layers)
        for (const Segment& segment : layer.geometry->segments) {
            const double from = segment.from[0] / built.frame.scale + built.frame.center.x(),
                         to = segment.to[0] / built.frame.scale + built.frame.center.x();
            EXPECT_NEAR(from, std::round(10 * from) / 10, 1e-5);
            EXPECT_NEAR(from, to, 1e-5);
            ++lines;
        }
    EXPECT_GT(lines, 100);
    state.coloring.isolines = false;
    driver_->settle();
    EXPECT_EQ(driver_->drawn(LayerKind::isolines).segments, 0);
}

// Colours end where nearly all values do; the legend says how far they go.
TEST_F(SolvedCube, ColoursSpanMostOfTheStresses) {
    const auto legend = [&](ColorBy color) {
        driver_->state().coloring.by = color;
        driver_->settle();
        return driver_->app().scene().legend;
    };
    const auto is_said = [&](const std::string& text) {
        const std::vector<std::string> words = words_on_screen();
        return std::find(words.begin(), words.end(), text) != words.end();
    };
    std::vector<double> values;
    const Legend von_mises = legend(ColorBy::von_mises);
    for_corners([&](const Vec3&, float value) { values.push_back(value); });
    const auto share_up_to = [&](double limit) {
        return static_cast<double>(std::count_if(values.begin(), values.end(), [&](double v) { return v <= limit; })) /
               static_cast<double>(values.size());
    };
    EXPECT_GE(share_up_to(von_mises.values->high), 0.99);
    EXPECT_LT(share_up_to(von_mises.values->high - 1e-9), 0.99);
    EXPECT_EQ(von_mises.percentile, 99);
    EXPECT_EQ(von_mises.values->low, 0);
    EXPECT_EQ(von_mises.extremes->high, 1);
    EXPECT_TRUE(is_said("Colours span 99 % of the values drawn"));
    EXPECT_TRUE(is_said("largest 1"));
    EXPECT_TRUE(is_said("least 0"));
    driver_->state().coloring.percentile = 75;
    EXPECT_LT(legend(ColorBy::stress_xx).values->high, 0.9) << "at both ends";
    EXPECT_GT(legend(ColorBy::stress_xx).values->low, 0.1);
    driver_->state().coloring.percentile = 100;
    EXPECT_EQ(legend(ColorBy::von_mises).values->high, 1);
    EXPECT_EQ(legend(ColorBy::von_mises).percentile, 100);
    driver_->state().coloring.percentile = 99;
    EXPECT_EQ(legend(ColorBy::displacement).values->high, 1) << "it is smooth";
    driver_->state().coloring.range = ValueRange{0, 0.5};
    EXPECT_EQ(legend(ColorBy::von_mises).extremes->high, 1) << "beyond a range that is given";
    EXPECT_FALSE(is_said("Colours span 99 % of the values drawn"));
    EXPECT_TRUE(legend(ColorBy::min_dihedral).goes_above) << "which no extremes say";
    EXPECT_FALSE(legend(ColorBy::min_dihedral).goes_below);
    driver_->state().coloring.range = ValueRange{170, 180};
    EXPECT_TRUE(legend(ColorBy::min_dihedral).goes_below);
    EXPECT_FALSE(legend(ColorBy::min_dihedral).goes_above);
    driver_->state().coloring.range = {};
    EXPECT_FALSE(legend(ColorBy::min_dihedral).goes_above || legend(ColorBy::min_dihedral).goes_below);
}

TEST_F(SolvedCube, TellsWhatIsAtAPlace) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::von_mises;
    driver_->settle();
    const NodeId part(2);
    const auto surface = driver_->app().session().fetched().part_surface(part);
    ASSERT_TRUE(surface);
    const Selection vertex = {Selection::Kind::vertex, part, 0, surface->vertices[0]};
    const std::string text = describe_selection(driver_->app().session(), vertex, 0);
    EXPECT_NE(text.find(fmt::format("von Mises {:.6g}", surface->vertices[0].x())), std::string::npos) << text;
    EXPECT_NE(text.find("stress XX"), std::string::npos);
}

TEST_F(SolvedCube, LooksAsItShould) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::von_mises;
    state.coloring.isolines = true;
    state.deformation.factor = 0.3;
    state.look.edges = false;
    EXPECT_TRUE(is_golden("solution", *driver_));
}

TEST_F(SolvedCube, IsAPictureByOneCommand) {
    const std::string png = folder_->file("a.png");
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = {"screenshot", folder_->file("out/solution"), "-o", png, "--resolution",
                                        "320x240"};
        all.insert(all.end(), more.begin(), more.end());
        return run_kerf(all);
    };
    EXPECT_EQ(
        run({"--color", "von-mises", "--deform", "auto", "--isolines", "--range", "0", "1", "--load-case", "fast"})
            .exit_code,
        0);
    const ChildResult no_case = run({"--load-case", "slower"});
    EXPECT_EQ(no_case.exit_code, 2);
    EXPECT_NE(no_case.log.find("It has 'slow', 'fast'"), std::string::npos) << no_case.log;
    EXPECT_EQ(run({"--deform", "much"}).exit_code, 2);
    EXPECT_EQ(run({"--range", "2", "1"}).exit_code, 2);
    const ChildResult no_solution = run_kerf(
        {"screenshot", folder_->file("out/mesh"), "-o", png, "--resolution", "320x240", "--color", "displacement"});
    EXPECT_EQ(no_solution.exit_code, 2);
    EXPECT_NE(no_solution.log.find("There is no solution"), std::string::npos) << no_solution.log;
}

TEST(Deformation, IsARoundNumber) {
    EXPECT_DOUBLE_EQ(good_deformation(0.001, 1), 50);
    EXPECT_DOUBLE_EQ(good_deformation(0.0011, 1), 20);
    EXPECT_DOUBLE_EQ(good_deformation(3, 1), 0.01);
    EXPECT_EQ(good_deformation(0, 1), 0);
}

}  // namespace
}  // namespace kerf::test
