// The guided tour of a cut: its texts as laws over the cuts of several runs, and its buttons.
#include "viewer/model/tour.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/number_text.h"
#include "support/assets.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/model/timeline.h"

namespace kerf::test {
namespace {

using namespace view;

Driver::Options run_of(std::int32_t parts, ContourMethod contour, bool volume) {
    Driver::Options options;
    options.parts = parts;
    options.contour = contour;
    options.volume = volume;
    return options;
}

struct Case {
    const char* asset;
    std::int32_t parts;
    ContourMethod contour;
    bool volume;
};
constexpr Case cases[] = {
    {"cube", 4, ContourMethod::min_cut, true},         {"hollow_box", 3, ContourMethod::edges, false},
    {"knee_tibial", 4, ContourMethod::min_cut, false}, {"cylinder", 2, ContourMethod::straight, false},
    {"l_bracket", 5, ContourMethod::min_cut, false},
};

void expect_sentences(const std::string& text, const std::string& where) {
    ASSERT_FALSE(text.empty()) << where;
    EXPECT_EQ(text.find_first_of("{}"), std::string::npos) << where << ": " << text;
    EXPECT_EQ(text.back(), '.') << where << ": " << text;
    EXPECT_EQ(text.find("  "), std::string::npos) << where << ": " << text;
    EXPECT_LT(text.size(), 330u) << where << ": it is to be read at a glance";
}

// Each stage of each cut has its text, and the figures in it are those of this cut.
TEST(Tour, TellsEveryStageOfEveryCut) {
    for (const Case& c : cases) {
        Driver driver(run_of(c.parts, c.contour, c.volume));
        driver.open(asset_path(c.asset));
        const Document& document = driver.document();
        ASSERT_TRUE(document.trace) << c.asset;
        std::size_t cuts = 0;
        for (const Cut& cut : document.trace->cuts) {
            if (!cut.made()) continue;
            ++cuts;
            ASSERT_EQ(node_of_tour(document, cut.node), cut.node);
            std::set<Stage> stages;
            for (const TourStop& stop : stops_of_tour(document, cut.node)) {
                stages.insert(stop.stage);
                expect_sentences(tell(document, cut.node, stop),
                                 fmt::format("{}, node {}, {}", c.asset, cut.node.value(), name(stop.stage)));
            }
            for (const Stage stage : {Stage::input, Stage::plane, Stage::contour, Stage::interface, Stage::split})
                EXPECT_TRUE(stages.contains(stage)) << name(stage);
            const auto tells = [&](Stage stage, std::size_t count) {
                const std::string text = tell(document, cut.node, {stage});
                return text.find(grouped(static_cast<std::int64_t>(count)) + " ") != std::string::npos;
            };
            EXPECT_TRUE(tells(Stage::contour, static_cast<std::size_t>(cut.contour_edges)));
            EXPECT_TRUE(tells(Stage::interface, cut.interface.triangles.size()));
            EXPECT_TRUE(cut.stages.crossed_edges.empty() ||
                        tells(Stage::crossed_edges, cut.stages.crossed_edges.size()));
            const TreeRow& below = *document.tree.find(child_of(cut.node, 0));
            EXPECT_NE(tell(document, cut.node, {Stage::split}).find(fmt::format("{:.4g}", below.volume)),
                      std::string::npos);
        }
        EXPECT_GE(cuts, static_cast<std::size_t>(c.parts - 1)) << c.asset;
    }
}

// Where the eye is, it sees the plane from the side that the text means, and what matters is in the picture.
TEST(Tour, LooksAtEveryStageFromBeforeThePlane) {
    Driver driver(run_of(4, ContourMethod::min_cut, false));
    driver.open(asset_path("cube"));
    const Document& document = driver.document();
    for (const Cut& cut : document.trace->cuts)
        for (const TourStop& stop : stops_of_tour(document, cut.node)) {
            const TourView view = view_of_stop(document, cut.node, stop, nullptr, driver.state());
            EXPECT_NEAR(view.back.norm(), 1, 1e-12);
            EXPECT_GT(view.back.dot(cut.plane.normal), 0.2) << name(stop.stage);
            EXPECT_EQ(view.state.step, Step{stop.stage});
            for (const Vec3& p : cut.interface.points) EXPECT_TRUE(view.box.contains(p)) << name(stop.stage);
        }
}

TEST(Tour, GoesThroughTheStagesAndBackToWhatWasSeen) {
    Driver driver(run_of(4, ContourMethod::min_cut, true));
    driver.open(asset_path("cube"));
    driver.state().node = NodeId(3);
    driver.state().coloring.by = ColorBy::level;
    driver.settle();
    const ViewState before = driver.state();
    driver.key(key_of('T'));
    driver.settle();
    ASSERT_TRUE(driver.offers("Next"));
    EXPECT_FALSE(driver.offers("Back"));
    const std::vector<TourStop> stops = stops_of_tour(driver.document(), NodeId(3));
    ASSERT_GT(stops.size(), 6u);
    for (std::size_t i = 0; i < stops.size(); ++i) {
        EXPECT_EQ(driver.state().step, Step{stops[i].stage}) << i;
        EXPECT_EQ(driver.state().clip.on, i + 1 == stops.size()) << "all parts first, then what is in them";
        EXPECT_EQ(driver.state().node, NodeId(3));
        if (i + 1 < stops.size()) driver.click("Next");
    }
    EXPECT_FALSE(driver.offers("Next"));
    driver.click("Back");
    EXPECT_EQ(nearest_stop(stops, driver.state()), stops.size() - 2);
    driver.key(key_left);
    EXPECT_EQ(driver.state().step, Step{stops[stops.size() - 3].stage});
    driver.key(key_right);
    EXPECT_EQ(nearest_stop(stops, driver.state()), stops.size() - 2);
    driver.click("End");
    driver.settle();
    EXPECT_EQ(driver.state(), before);
    EXPECT_FALSE(driver.app().widgets().find("Next"));
    driver.key(key_of('T'));
    driver.settle();
    driver.key(key_escape);
    EXPECT_EQ(driver.state(), before);
}

// Another node ends it, and what is seen then stays.
TEST(Tour, EndsWhereAnotherNodeIsChosen) {
    Driver driver(run_of(4, ContourMethod::min_cut, false));
    driver.open(asset_path("cube"));
    driver.key(key_of('T'));
    driver.settle();
    driver.click("node 3");
    driver.settle();
    EXPECT_EQ(driver.state().node, NodeId(3));
    EXPECT_FALSE(driver.app().widgets().find("Next"));
}

// A part was not cut: the first cut is shown. A surface that nobody has cut is cut first.
TEST(Tour, FindsACut) {
    Driver::Options options = run_of(2, ContourMethod::min_cut, true);
    options.auto_run = false;
    Driver driver(options);
    EXPECT_FALSE(node_of_tour(driver.document(), root_node));
    driver.open(asset_path("cube"));
    driver.key(key_of('T'));
    driver.await("a cut", [&] { return driver.app().widgets().find("Next").has_value(); });
    driver.settle();
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 2u);
    EXPECT_EQ(driver.state().step.stage, Stage::input);
    EXPECT_EQ(node_of_tour(driver.document(), NodeId(2)), root_node);
    EXPECT_EQ(node_of_tour(driver.document(), NodeId(99)), root_node);
}

}  // namespace
}  // namespace kerf::test
