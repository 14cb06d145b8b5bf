// Bodies of several regions in the viewer: opened, shown, made glass, and pulled apart.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "files/io/stl_writer.h"
#include "files/io/surface_reader.h"
#include "support/assets.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"
#include "viewer/model/shown_parts.h"

namespace kerf::test {
namespace {

using namespace view;

constexpr const char* regions[] = {"bone", "cement"};

// Cement in bone, meshed once, with a trace beside it.
class RegionsShown : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        const ChildResult run = run_kerf({"mesh", asset_path("bone"), asset_path("cement"), "-o", run_folder(), "-n",
                                          "6", "--size", "0.8", "-q", "--trace", folder_->file("run.trace")});
        ASSERT_EQ(run.exit_code, 0) << run.log;
        driver_ = new Driver;
        driver_->open(run_folder());
    }
    static void TearDownTestSuite() {
        delete driver_;
        delete folder_;
        driver_ = nullptr;
        folder_ = nullptr;
    }
    void SetUp() override {
        state() = {};
        state().step = {Stage::tetrahedra, -1};
        driver_->settle();
    }
    static std::string run_folder() { return folder_->file("run"); }
    static ViewState& state() { return driver_->state(); }
    static const Document& document() { return driver_->document(); }

    // Of a layer of a part.
    static std::string region_of_layer(const Layer& layer) {
        const std::string* region = region_of(document(), layer.ranges.front().owner);
        return region ? *region : "";
    }
    static std::set<std::string> regions_drawn() {
        std::set<std::string> drawn;
        driver_->settle();
        for (const Layer& layer : driver_->app().scene().scene.layers)
            if (layer.kind == LayerKind::part) drawn.insert(region_of_layer(layer));
        return drawn;
    }

    static TemporaryFolder* folder_;
    static Driver* driver_;
};
TemporaryFolder* RegionsShown::folder_ = nullptr;
Driver* RegionsShown::driver_ = nullptr;

TEST_F(RegionsShown, TheRunIsOpenedWithItsTrace) {
    EXPECT_EQ(document().region_names, (std::vector<std::string>{"bone", "cement"}));
    EXPECT_TRUE(document().trace);
    ASSERT_EQ(document().region_places.size(), 2u);
    EXPECT_EQ(document().region_places[0].holder, RegionIndex::none());
    EXPECT_EQ(document().region_places[1].holder, RegionIndex(0));
    EXPECT_TRUE(document().region_places[0].box.isApprox(document().box));
    const TreeRow& root = document().tree.rows.front();
    EXPECT_EQ(root.regions, 2);
    EXPECT_FALSE(root.centroid) << "several regions have none";
    for (const TreeRow& row : document().tree.rows)
        EXPECT_EQ(row.region.is_valid(), row.id > root_node) << "node " << row.id.value();
}

TEST_F(RegionsShown, ARunOpensInTheirColours) {
    driver_->open(run_folder());
    EXPECT_EQ(state().step.stage, Stage::tetrahedra);
    EXPECT_EQ(state().coloring.by, ColorBy::region);
}

TEST_F(RegionsShown, SayWhyTheyAreDisabled) {
    state().step = {Stage::input, -1};
    driver_->settle();
    EXPECT_FALSE(driver_->offers("show region bone"));
    driver_->click("Show the parts");
    EXPECT_EQ(state().step.stage, Stage::tetrahedra);
    driver_->settle();
    EXPECT_TRUE(driver_->offers("show region bone"));
}

TEST_F(RegionsShown, AreHiddenIsolatedAndShownByTheirButtons) {
    using Names = std::set<std::string>;
    state().coloring.by = ColorBy::region;
    EXPECT_EQ(regions_drawn(), (Names{"bone", "cement"}));
    EXPECT_EQ(driver_->app().facts().legend.categories.size(), 2u);
    EXPECT_EQ(driver_->app().facts().legend.categories[0].text, "bone");
    for (const std::string region : regions) {
        const std::string other = region == "bone" ? "cement" : "bone";
        driver_->click("show region " + region);
        EXPECT_EQ(regions_drawn(), Names{other});
        ASSERT_EQ(driver_->app().facts().legend.categories.size(), 1u);
        EXPECT_EQ(driver_->app().facts().legend.categories[0].text, other);
        driver_->click("show region " + region);
        EXPECT_EQ(regions_drawn().size(), 2u);
        driver_->click("isolate region " + region);
        EXPECT_EQ(regions_drawn(), Names{region});
        driver_->click("show region " + other);  // which is beside the one that is isolated
        EXPECT_EQ(regions_drawn().size(), 2u);
        driver_->click("isolate region " + region);
        driver_->click("Show all");
        EXPECT_EQ(regions_drawn().size(), 2u);
        driver_->click("glass region " + region);
        EXPECT_EQ(state().visibility.glass_regions, std::vector<std::string>{region});
        driver_->click("glass region " + region);
        EXPECT_TRUE(state().visibility.glass_regions.empty());
    }
    driver_->click("Walls alone");
    EXPECT_TRUE(state().visibility.walls);
    driver_->click("Explode as wholes");
    EXPECT_TRUE(state().explosion.regions);
    // A state of another body changes nothing.
    state() = {};
    state().step = {Stage::tetrahedra, -1};
    state().visibility.isolated_region = "skull";
    state().visibility.hidden_regions = {"brain"};
    EXPECT_EQ(regions_drawn().size(), 2u);
}

// Corners of a triangle in any order.
using Place = std::set<std::array<float, 3>>;

// How often a triangle is drawn in each place, by layers of parts that are drawn through or are walls.
TEST_F(RegionsShown, EachFacetIsDrawnOnceThroughGlassAndAsAWall) {
    std::int64_t outer = 0, walls = 0;
    std::map<std::string, std::int64_t> outer_of;
    for (const NodeId part : document().tree.parts_below(root_node)) {
        const auto surface = driver_->app().session().fetched().part_surface(part);
        ASSERT_TRUE(surface);
        for (const NodeId neighbour : surface->neighbour) {
            if (!neighbour.is_valid()) ++outer_of[*region_of(document(), part)], ++outer;
            if (neighbour.is_valid() && *region_of(document(), part) == "cement")
                walls += *region_of(document(), neighbour) == "bone";
        }
    }
    ASSERT_GT(walls, 0);
    for (const bool only_walls : {false, true})
        for (const std::vector<std::string>& glass :
             {std::vector<std::string>{"bone", "cement"}, {"bone"}, {"cement"}, {}}) {
            if (!only_walls && glass.empty()) continue;
            SCOPED_TRACE(std::to_string(only_walls) + " " + (glass.empty() ? "" : glass.front()));
            state().visibility.walls = only_walls;
            state().visibility.glass_regions = glass;
            driver_->settle();
            std::map<Place, int> drawn;
            std::int64_t of_glass = 0;
            for (const Layer& layer : driver_->app().scene().scene.layers) {
                if (layer.kind != LayerKind::part) continue;
                const bool is_glass = view::is_glass(state(), region_of_layer(layer));
                EXPECT_EQ(layer.opacity < 1, is_glass);
                if (!is_glass && !only_walls) continue;
                const std::vector<Corner>& corners = layer.geometry->corners;
                for (std::size_t i = 0; i < corners.size(); i += 3, ++of_glass)
                    ++drawn[{corners[i].position, corners[i + 1].position, corners[i + 2].position}];
            }
            for (const auto& [place, times] : drawn) EXPECT_EQ(times, 1);
            const std::int64_t expected = only_walls          ? walls
                                          : glass.size() == 2 ? outer + walls
                                                              : outer_of[glass.front()];
            EXPECT_EQ(of_glass, expected);
        }
}

// Every part of a region moves as it does, and the two are as far apart as the holder is long.
TEST_F(RegionsShown, MoveAsWholes) {
    state().explosion.amount = 1;
    for (const bool wholes : {true, false}) {
        state().explosion.regions = wholes;
        driver_->settle();
        std::map<std::string, std::set<std::array<float, 3>>> offsets;
        for (const Layer& layer : driver_->app().scene().scene.layers)
            if (layer.kind == LayerKind::part) offsets[region_of_layer(layer)].insert(layer.ranges.front().offset);
        ASSERT_EQ(offsets.size(), 2u);
        EXPECT_EQ(offsets["bone"].size() == 1, wholes);
        if (!wholes) continue;
        const float apart = (*offsets["cement"].begin())[2] - (*offsets["bone"].begin())[2];
        EXPECT_NEAR(apart, document().box.sizes().z() * 2 / document().box.diagonal().norm(), 1e-5);
    }
}

TEST_F(RegionsShown, WhatIsPickedNamesThem) {
    for (const NodeId part : document().tree.parts_below(root_node)) {
        const auto surface = driver_->app().session().fetched().part_surface(part);
        ASSERT_TRUE(surface);
        const auto wall = std::find_if(surface->neighbour.begin(), surface->neighbour.end(), [&](NodeId other) {
            return other.is_valid() && region_of(document(), other) != region_of(document(), part);
        });
        if (wall == surface->neighbour.end()) continue;
        const auto facet = static_cast<std::int32_t>(wall - surface->neighbour.begin());
        state().selection = {Selection::Kind::facet, part, facet, {}};
        driver_->settle();
        const std::string& text = driver_->app().facts().selection;
        for (const std::string region : regions)
            EXPECT_NE(text.find(" in region '" + region + "'"), std::string::npos) << text;
    }
}

TEST_F(RegionsShown, PicturesNameWhatThereIs) {
    const auto answer = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "screenshot");
        for (const std::string& more :
             {std::string("-o"), folder_->file("a.png"), std::string("--resolution"), std::string("160x120")})
            arguments.push_back(more);
        const ChildResult result = run_kerf(arguments);
        return std::to_string(result.exit_code) + " " + result.log;
    };
    EXPECT_EQ(answer({run_folder(), "--hide-region", "bone", "--glass-region", "cement", "--walls"}), "0 ");
    EXPECT_EQ(answer({run_folder(), "--isolate-region", "cement", "--explode", "1", "--explode-regions"}), "0 ");
    // Patches are seen on surfaces, too, but walls on parts alone.
    const auto blue = [&] {
        std::int64_t count = 0;
        const Image picture = read_png(folder_->file("a.png"));
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3) count += picture.rgb[i] + 60 < picture.rgb[i + 2];
        return count;
    };
    EXPECT_EQ(answer({run_folder(), "--color", "patch"}), "0 ");
    const std::int64_t of_surface = blue();
    EXPECT_EQ(answer({run_folder(), "--color", "patch", "--walls"}), "0 ");
    EXPECT_LT(blue(), of_surface / 2) << "the wall is inside";
    const std::string unknown = answer({run_folder(), "--glass-region", "bone", "--hide-region", "bane"});
    EXPECT_EQ(unknown, "2 kerf: " + run_folder() + " has no region 'bane', but 'bone', 'cement'.\n");
    const std::string one = answer({asset_path("cube"), "-n", "2", "--walls"});
    EXPECT_NE(one.find("has one region, not several"), std::string::npos) << one;
    const std::string mixed = answer({asset_path("cube"), run_folder()});
    EXPECT_NE(mixed.find(run_folder() + " is no surface: open it alone."), std::string::npos) << mixed;
}

TEST(SeveralFiles, AreOneBodyOfSeveralRegions) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open_files({asset_path("bone"), asset_path("cement")});
    const Document& document = driver.document();
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(document.error, "");
        EXPECT_EQ(document.title, "bone.stl + cement.stl");
        EXPECT_FALSE(document.has_problems());
        EXPECT_EQ(document.region_names, (std::vector<std::string>{"bone", "cement"}));
        EXPECT_GT(document.volume, 70);
        EXPECT_TRUE(driver.app().session().failures().empty());
        driver.key('R', true);
        driver.await("the files again", [&] { return document.checked && !driver.app().session().busy(); });
    }
    driver.open(asset_path("cube"));
    EXPECT_EQ(document.title, "cube.stl") << "the others are not opened with it";
    EXPECT_TRUE(document.region_names.empty());
}

// What is wrong where two bodies meet is listed and flown to as of one.
TEST(SeveralFiles, TheirDefectsAreFlownTo) {
    const TemporaryFolder folder;
    Soup cement = read_surface(asset_path("cement"));
    for (Vec3& p : cement.vertices) p.x() += 0.3;
    write_stl(folder.file("shifted.stl"), cement.vertices, cement.facets);
    Driver driver;
    driver.open_files({asset_path("bone"), folder.file("shifted.stl")});
    ASSERT_TRUE(driver.document().has_problems());
    const std::vector<Defect>& defects = driver.document().checked->diagnosis.defects;
    ASSERT_FALSE(defects.empty());
    driver.click("defect 1");
    EXPECT_EQ(driver.state().selection.kind, Selection::Kind::defect);
    EXPECT_EQ(driver.state().selection.place, defects.front().where);
    ASSERT_TRUE(driver.state().camera);
    EXPECT_EQ(driver.state().camera->target, defects.front().where);
    EXPECT_GT(driver.drawn(LayerKind::defects).triangles, 0);
}

}  // namespace
}  // namespace kerf::test
