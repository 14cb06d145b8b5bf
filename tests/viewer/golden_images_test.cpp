// Pictures of every stage, and of every way to look at cells, against those that were looked at and found good.
#include <filesystem>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"

namespace kerf::test {
namespace {

using namespace view;

Driver::Options small_pictures() {
    Driver::Options options;
    options.width = 480;
    options.height = 360;
    return options;
}

class StagesOf : public testing::TestWithParam<const char*> {};

TEST_P(StagesOf, LookAsTheyShould) {
    const std::string asset = GetParam();
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(asset_path(asset));
    const std::vector<Step> steps = driver.app().steps();
    ASSERT_EQ(name(steps.back()), "tetrahedra");
    EXPECT_GE(steps.size(), 12u);
    for (const Step& step : steps) {
        driver.state().step = step;
        EXPECT_TRUE(is_golden(asset + "-" + name(step), driver.picture()));
    }
}

INSTANTIATE_TEST_SUITE_P(Assets, StagesOf, testing::Values("cube", "hollow_box", "knee_tibial", "pipe_with_holes"),
                         [](const auto& test) { return std::string(test.param); });

// Where the first try is no good, the failed places are marked.
TEST(RefusedTries, LookAsTheyShould) {
    Driver::Options options = small_pictures();
    options.parts = 8;
    options.volume = false;
    Driver driver(options);
    driver.show_panels(false);
    driver.open(asset_path("wing_in_box"));
    driver.state().node = 4;
    driver.settle();
    ASSERT_GE(driver.app().steps().size(), 13u);
    driver.state().step = driver.app().steps()[1];
    ASSERT_EQ(driver.state().step.refused_try, 0);
    EXPECT_TRUE(is_golden("wing_in_box-refused", driver.picture()));
    EXPECT_GT(driver.drawn("places").points, 0);
    EXPECT_GT(driver.drawn("refused").segments, 0);
}

/// One body for all ways to look at it.
class Looks : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        driver_ = new Driver(small_pictures());
        driver_->show_panels(false);
        driver_->open(asset_path("hollow_box"));
    }
    static void TearDownTestSuite() {
        delete driver_;
        driver_ = nullptr;
    }
    void SetUp() override {
        driver_->state() = {};
        driver_->state().step = {Stage::tetrahedra, -1};
    }
    ViewState& state() { return driver_->state(); }
    void expect_golden(const std::string& name) { EXPECT_TRUE(is_golden(name, driver_->picture())); }

    static Driver* driver_;
};
Driver* Looks::driver_ = nullptr;

TEST_F(Looks, ClipStyles) {
    for (const ClipStyle style : {ClipStyle::cells, ClipStyle::smooth, ClipStyle::layer}) {
        state().clip = {true, style, Vec3(1, 0.4, 0.2).normalized(), 0.45, false};
        expect_golden(std::string("clip-") + name(style));
    }
    state().clip.style = ClipStyle::cells;
    state().clip.flipped = true;
    expect_golden("clip-flipped");
}

TEST_F(Looks, ClipStylesOfASurface) {
    state().step = {Stage::input, -1};
    for (const ClipStyle style : {ClipStyle::cells, ClipStyle::smooth, ClipStyle::layer}) {
        state().clip = {true, style, Vec3::UnitX(), 0.5, false};
        expect_golden(std::string("clip-surface-") + name(style));
    }
}

TEST_F(Looks, Exploded) {
    state().explode = 0.6;
    expect_golden("explode");
    state().clip = {true, ClipStyle::cells, Vec3::UnitY(), 0.5, true};
    expect_golden("explode-clip");
    state().clip = {};
    state().step = {Stage::split, -1};
    expect_golden("explode-split");
}

TEST_F(Looks, Shrunk) {
    state().shrink = 0.3;
    state().clip = {true, ClipStyle::cells, Vec3::UnitX(), 0.4, false};
    expect_golden("shrink");
}

TEST_F(Looks, EveryColouring) {
    for (int i = 0; i < color_by_count; ++i) {
        state().color = static_cast<ColorBy>(i);
        state().clip = {true, ClipStyle::cells, Vec3::UnitY(), 0.5, true};
        expect_golden(std::string("color-") + name(state().color));
    }
}

TEST_F(Looks, ColouredBoundary) {
    state().color = ColorBy::min_dihedral;
    expect_golden("color-boundary");
    state().filter = ValueRange{0, 25};
    expect_golden("filter");
}

TEST_F(Looks, HiddenAndIsolated) {
    state().hidden = {5};
    expect_golden("hidden");
    state().hidden = {};
    state().isolated = 3;
    expect_golden("isolated");
}

TEST_F(Looks, OfANodeBelow) {
    state().node = 3;
    state().step = {Stage::contour, -1};
    expect_golden("node-3-contour");
    state().step = {Stage::input, -1};
    state().shading = Shading::smooth;
    state().edges = false;
    expect_golden("smooth-no-edges");
}

TEST_F(Looks, DarkAndSelected) {
    state().theme = Theme::dark;
    state().selection = {Selection::Kind::cell, 4, 17, Vec3::Zero()};
    state().explode = 0.5;
    expect_golden("dark-selection");
}

TEST(WholeWindow, EmptyOpenedAndAtAStage) {
    Driver driver;
    EXPECT_TRUE(is_golden("ui-empty", driver.picture()));
    driver.state().times = false;
    driver.open(asset_path("cylinder"));
    driver.state().times = false;
    driver.state().node = 3;
    driver.state().step = {Stage::contour, -1};
    EXPECT_TRUE(is_golden("ui-contour", driver.picture()));
    driver.state().node = 1;
    driver.state().step = {Stage::tetrahedra, -1};
    driver.state().color = ColorBy::min_dihedral;
    driver.state().clip.on = true;
    driver.state().selection = {Selection::Kind::cell, 4, 100, Vec3::Zero()};
    EXPECT_TRUE(is_golden("ui-quality", driver.picture()));
    driver.state().theme = Theme::dark;
    driver.state().panels.keys = true;
    EXPECT_TRUE(is_golden("ui-dark-keys", driver.picture()));
}

TEST(WholeWindow, ProblemsOfABadSurface) {
    const TemporaryFolder folder;
    // A cube that lacks a triangle.
    write_off(folder.file("open.off"),
              {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
              {{0, 2, 1},
               {0, 3, 2},
               {4, 5, 6},
               {4, 6, 7},
               {0, 1, 5},
               {0, 5, 4},
               {1, 2, 6},
               {1, 6, 5},
               {2, 3, 7},
               {2, 7, 6},
               {3, 0, 4}});
    Driver driver;
    driver.open(folder.file("open.off"));
    EXPECT_TRUE(is_golden("ui-problems", driver.picture()));
}

// The tolerance lets no difference pass that a user would see.
TEST(GoldenComparison, FailsWhereItMust) {
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(asset_path("cube"));
    const Image picture = driver.picture();
    EXPECT_EQ(compare(picture, driver.picture()).largest, 0) << "two pictures of the same state";
    driver.state().edges = false;
    EXPECT_GT(compare(picture, driver.picture()).differing, 20 * most_differing) << "no edges";
    driver.state().edges = true;
    driver.state().axes = false;
    EXPECT_GT(compare(picture, driver.picture()).differing, 2 * most_differing) << "no axes";
    driver.state().axes = true;
    Camera camera = driver.app().camera();
    orbit(camera, 0.01, 0);
    driver.state().camera = camera;
    EXPECT_GT(compare(picture, driver.picture()).differing, 10 * most_differing) << "turned by two degrees";
    EXPECT_FALSE(is_golden("cube-contour", picture)) << "a picture of another stage";
    EXPECT_FALSE(is_golden("that-nobody-has-made", picture));
    EXPECT_TRUE(std::filesystem::remove(std::string(KERF_GOLDEN_CANDIDATES) + "/that-nobody-has-made.png"));
    EXPECT_TRUE(std::filesystem::remove(std::string(KERF_GOLDEN_CANDIDATES) + "/cube-contour.png"));
}

}  // namespace
}  // namespace kerf::test
