// Pictures of every stage, and of every way to look at cells, against those that were looked at and found good.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "run/run/trace.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/sealed_run.h"
#include "support/shapes.h"
#include "support/stamped_part.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"
#include "viewer/words_on_screen.h"

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
        EXPECT_TRUE(is_golden(asset + "-" + name(step), driver));
    }
}

INSTANTIATE_TEST_SUITE_P(Assets, StagesOf, testing::Values("cube", "hollow_box", "knee_tibial", "pipe_with_holes"),
                         [](const auto& test) { return std::string(test.param); });

// Where a contour meets itself in a vertex before its multiple paths are removed, and not after.
TEST(ContourThatMeetsItself, LooksAsItShould) {
    const TemporaryFolder folder;
    const Soup ring = uneven_ring();
    write_off(folder.file("ring.off"), ring.vertices, ring.facets);
    Driver::Options options = small_pictures();
    options.parts = 3;
    options.contour = ContourMethod::edges;
    options.volume = false;
    Driver driver(options);
    driver.show_panels(false);
    driver.open(folder.file("ring.off"));
    for (const Stage stage : {Stage::closed_loops, Stage::paths_removed}) {
        driver.state().step = {stage, -1};
        EXPECT_TRUE(is_golden(std::string("ring-") + name(stage), driver));
    }
}

// Where the first try is no good, the failed places are marked.
TEST(RefusedTries, LookAsTheyShould) {
    Driver::Options options = small_pictures();
    options.parts = 8;
    options.volume = false;
    Driver driver(options);
    driver.show_panels(false);
    driver.open(asset_path("wing_in_box"));
    driver.state().node = NodeId(4);
    driver.settle();
    ASSERT_GE(driver.app().steps().size(), 13u);
    driver.state().step = driver.app().steps()[1];
    ASSERT_EQ(driver.state().step.refused_try, 0);
    EXPECT_TRUE(is_golden("wing_in_box-refused", driver));
    EXPECT_GT(driver.drawn(LayerKind::places).points, 0);
    EXPECT_GT(driver.drawn(LayerKind::refused).segments, 0);
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
    void expect_golden(const std::string& name) { EXPECT_TRUE(is_golden(name, *driver_)); }

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
    state().explosion.amount = 0.6;
    expect_golden("explode");
    state().clip = {true, ClipStyle::cells, Vec3::UnitY(), 0.5, true};
    expect_golden("explode-clip");
    state().clip = {};
    state().step = {Stage::split, -1};
    expect_golden("explode-split");
}

TEST_F(Looks, Shrunk) {
    state().explosion.shrink = 0.3;
    state().clip = {true, ClipStyle::cells, Vec3::UnitX(), 0.4, false};
    expect_golden("shrink");
}

TEST_F(Looks, EveryColouring) {
    for (int i = 0; i < color_by_count; ++i) {
        state().coloring.by = static_cast<ColorBy>(i);
        if (state().coloring.by == ColorBy::rank || state().coloring.by == ColorBy::level ||
            state().coloring.by == ColorBy::patch || state().coloring.by == ColorBy::origin ||
            is_of_surface(state().coloring.by) || is_of_solution(state().coloring.by))
            continue;  // of which this body has one, or none: see below, and solution_test.cpp
        state().clip = {true, ClipStyle::cells, Vec3::UnitY(), 0.5, true};
        expect_golden(std::string("color-") + name(state().coloring.by));
    }
}

TEST_F(Looks, ColouredBoundary) {
    state().coloring.by = ColorBy::min_dihedral;
    expect_golden("color-boundary");
    state().coloring.filter = ValueRange{0, 25};
    expect_golden("filter");
}

TEST_F(Looks, HiddenAndIsolated) {
    state().visibility.hidden = {NodeId(5)};
    expect_golden("hidden");
    state().visibility.hidden = {};
    state().visibility.isolated = NodeId(3);
    expect_golden("isolated");
}

TEST_F(Looks, OfANodeBelow) {
    state().node = NodeId(3);
    state().step = {Stage::contour, -1};
    expect_golden("node-3-contour");
    state().step = {Stage::input, -1};
    state().look.shading = Shading::smooth;
    state().look.edges = false;
    expect_golden("smooth-no-edges");
}

TEST_F(Looks, DarkAndSelected) {
    state().theme = Theme::dark;
    state().selection = {Selection::Kind::cell, NodeId(4), 17, Vec3::Zero()};
    state().explosion.amount = 0.5;
    expect_golden("dark-selection");
}

// The picture with the tolerance, and its words without.
void expect_golden_window(const std::string& name, Driver& driver) {
    EXPECT_TRUE(is_golden(name, driver));
    EXPECT_TRUE(are_golden_words(name, words_on_screen()));
}

// The ranks in a report, as if so many had made it: the rank of each part in turn.
void write_ranks(const std::string& folder, int ranks) {
    const std::string report = folder + "/report.json";
    std::string text = bytes_of_file(report);
    const std::string key = "\"rank\":";
    int rank = 0;
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
        const std::size_t digit = text.find_first_of("0123456789", at);
        text.replace(digit, 1, std::to_string(rank++ % ranks));
    }
    ASSERT_GE(rank, ranks);
    write_text_file(report, text);
    seal_run(folder);
}

TEST(Colourings, OfSeveralRanksLevelsAndPatches) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("box.stl")) << to_ascii_stl(box({0, 0, 0}, {3, 2, 1}, {12, 8, 4}));
    ASSERT_EQ(run_kerf({"mesh", folder.file("box.stl"), "-o", folder.file("run"), "-n", "3", "-q"}).exit_code, 0);
    write_ranks(folder.file("run"), 3);
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(folder.file("run"));
    driver.state().step = {Stage::tetrahedra, -1};
    // The part of rank 1 lies beyond the clip plane.
    for (const auto& [color, categories] : {std::pair(ColorBy::rank, 2), {ColorBy::level, 2}, {ColorBy::patch, 7}}) {
        driver.state().coloring.by = color;
        driver.state().clip = {color != ColorBy::patch, ClipStyle::cells, Vec3::UnitY(), 0.5, true};
        EXPECT_TRUE(is_golden(std::string("color-") + name(color), driver));
        EXPECT_EQ(std::ssize(driver.app().facts().legend.categories), categories) << name(color);
    }
}

// The cells of a report, as if half of those of the first part had been stamped, and those of the last made by TetGen.
TEST(Colourings, OfCoreShellAndOtherMesher) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("box.stl")) << to_ascii_stl(box({0, 0, 0}, {3, 2, 1}, {12, 8, 4}));
    ASSERT_EQ(
        run_kerf({"mesh", folder.file("box.stl"), "-o", folder.file("run"), "-n", "2", "-q", "--mesher", "tetgen"})
            .exit_code,
        0);
    stamp_first_part(folder.file("run"), 300);
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(folder.file("run"));
    driver.state().step = {Stage::tetrahedra, -1};
    driver.state().coloring.by = ColorBy::origin;
    driver.state().clip = {true, ClipStyle::cells, Vec3::UnitY(), 0.5, true};
    EXPECT_TRUE(is_golden("color-origin", driver));
    const auto legend = [&] {
        std::string words;
        for (const auto& category : driver.app().facts().legend.categories) words += category.text + "; ";
        return words;
    };
    EXPECT_EQ(legend(), "core: stamped cells; shell around the core; TetGen; ");
    const auto description = [&](NodeId part, std::int32_t cell) {
        driver.state().selection = {Selection::Kind::cell, part, cell, Vec3::Zero()};
        driver.settle();
        return driver.app().facts().selection;
    };
    EXPECT_NE(description(NodeId(2), 299).find("of the core"), std::string::npos);
    EXPECT_NE(description(NodeId(2), 300).find("of the shell"), std::string::npos);
    EXPECT_EQ(description(NodeId(3), 0).find("of the shell"), std::string::npos);
    driver.state().visibility.isolated = NodeId(3);
    driver.settle();
    EXPECT_EQ(legend(), "TetGen; ") << "only what is shown";
    driver.state().visibility.isolated = NodeId(2);
    driver.settle();
    EXPECT_EQ(legend(), "core: stamped cells; shell around the core; ");
}

// Before and after, how far they are from each other, how fine it was to be, and where it is sharp. The surface that
// was cut is none of the remesher's, so that pictures stay when that gets better.
TEST(RemeshedSurface, LooksAsItShould) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("prism.stl")) << to_ascii_stl(prism(6, 1, 4));
    std::ofstream(folder.file("fine.stl")) << to_ascii_stl(twisted_cylinder(36, 20, 1, 4, 0.5));
    const std::string file = folder.file("run.trace");
    ASSERT_EQ(run_kerf({"decompose", folder.file("fine.stl"), "-o", folder.file("run"), "-n", "2", "-q", "--trace",
                        file, "--surface", "split", "--size", "0.6", "--size-in", "sphere:1,0,4,0.5=0.1"})
                  .exit_code,
              0);
    Trace trace = read_trace(file);
    EXPECT_FALSE(trace.remeshed);
    trace.remeshed = true;
    trace.input = folder.file("prism.stl");
    write_trace(file, trace);
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(file);
    ViewState& state = driver.state();
    state.look.features = true;
    for (const Stage stage : {Stage::before_remeshing, Stage::input}) {
        state.step = {stage, -1};
        EXPECT_TRUE(is_golden(std::string("remeshing-") + name(stage), driver));
    }
    state.coloring.by = ColorBy::size;
    EXPECT_TRUE(is_golden("color-size", driver));
    state.coloring.by = ColorBy::deviation;
    EXPECT_TRUE(is_golden("color-deviation", driver));
    state.step = {Stage::split, -1};
    state.explosion.amount = 0.5;
    EXPECT_TRUE(is_golden("color-deviation-split", driver));
}

// A file of a CAD program says how patches look; one of them it has forgotten.
TEST(Colourings, OfPatchesAreThoseOfTheFile) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("box.stl")) << to_ascii_stl(box({0, 0, 0}, {3, 2, 1}, {12, 8, 4}));
    const std::string file = folder.file("box.trace");
    ASSERT_EQ(
        run_kerf({"decompose", folder.file("box.stl"), "-o", folder.file("run"), "-n", "2", "-q", "--trace", file})
            .exit_code,
        0);
    Trace trace = read_trace(file);
    ASSERT_EQ(trace.patch_names.size(), 6u);
    trace.patch_colours = {{200, 40, 40, 255},  {0, 0, 0, 0},        {40, 120, 200, 255},
                           {40, 120, 200, 255}, {250, 210, 60, 255}, {30, 140, 60, 255}};
    write_trace(file, trace);
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(file);
    driver.state().coloring.by = ColorBy::patch;
    EXPECT_TRUE(is_golden("color-patch-of-file", driver));
    EXPECT_EQ(driver.app().scene().scene.palette.size(), 5u) << "equal ones are one";
}

TEST(WholeWindow, EmptyOpenedAndAtAStage) {
    Driver::Options options;
    options.example_folder = asset_folder();
    Driver driver(options);
    expect_golden_window("ui-empty", driver);
    driver.state().look.times = false;
    driver.open(asset_path("cylinder"));
    driver.state().look.times = false;
    driver.frame(10);  // until the end of the run is no news any more
    driver.state().node = NodeId(3);
    driver.state().step = {Stage::contour, -1};
    expect_golden_window("ui-contour", driver);
    driver.state().node = root_node;
    driver.state().step = {Stage::tetrahedra, -1};
    driver.state().coloring.by = ColorBy::min_dihedral;
    driver.state().clip.on = true;
    driver.state().selection = {Selection::Kind::cell, NodeId(4), 100, Vec3::Zero()};
    expect_golden_window("ui-quality", driver);
    driver.state().theme = Theme::dark;
    driver.state().panels.keys = true;
    expect_golden_window("ui-dark-keys", driver);
    driver.state().panels = {};
    driver.state().panels.display = false;
    driver.state().panels.parameters = true;
    driver.settle();
    EXPECT_TRUE(are_golden_words("ui-parameters", words_on_screen()));
    driver.click("File");
    driver.settle();
    EXPECT_TRUE(are_golden_words("ui-file-menu", words_on_screen()));
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
    expect_golden_window("ui-problems", driver);
}

// The tolerance lets no difference pass that a user would see.
TEST(GoldenComparison, FailsWhereItMust) {
    Driver driver(small_pictures());
    driver.show_panels(false);
    driver.open(asset_path("cube"));
    const Image picture = driver.picture();
    EXPECT_EQ(compare(picture, driver.picture()).largest, 0) << "two pictures of the same state";
    driver.state().look.edges = false;
    EXPECT_GT(compare(picture, driver.picture()).differing, 20 * most_differing) << "no edges";
    driver.state().look.edges = true;
    driver.state().look.axes = true;
    EXPECT_GT(compare(picture, driver.picture()).differing, 2 * most_differing) << "axes";
    driver.state().look.axes = {};
    Camera camera = driver.app().camera();
    orbit(camera, 0.01, 0);
    driver.state().camera = camera;
    EXPECT_GT(compare(picture, driver.picture()).differing, 10 * most_differing) << "turned by two degrees";
    const std::string by = "this test";  // so that its candidates are nobody else's
    for (const char* wrong : {"cube-contour", "that-nobody-has-made"}) {
        EXPECT_FALSE(is_golden(wrong, picture, by));
        EXPECT_TRUE(std::filesystem::remove(candidate_path(wrong, by)));
    }
    EXPECT_TRUE(std::filesystem::remove(std::filesystem::path(candidate_path("", by)).parent_path()));
    EXPECT_FALSE(are_golden_words("that-nobody-has-read", {"Kerf"}));
    const std::filesystem::path words = std::filesystem::path(test::candidate_folder()) / "words";
    EXPECT_TRUE(std::filesystem::remove(words / "that-nobody-has-read.txt"));
}

// Whoever sees it fail on another machine learns why that may be.
TEST(GoldenComparison, NamesADriverThatIsNotThatOfTheGoldenPictures) {
    const std::string other = "Other Renderer (1.2), OpenGL 3.3";
    const auto failure = is_golden("cube-input", Image{1, 1, {0, 0, 0}}, other);
    EXPECT_FALSE(failure);
    EXPECT_NE(std::string(failure.message()).find(other), std::string::npos) << failure.message();
    EXPECT_NE(std::string(failure.message()).find("images/other-renderer-1-2-opengl-3-3"), std::string::npos);
    EXPECT_TRUE(std::filesystem::remove(candidate_path("cube-input", other)));
    EXPECT_TRUE(std::filesystem::remove(std::filesystem::path(candidate_path("cube-input", other)).parent_path()));
}

}  // namespace
}  // namespace kerf::test
