// The tree sorted and folded, the worst interfaces, refused tries, the timeline: as a user works with them.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/model/interface_places.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

using namespace view;

// The text in one line, as often as it is on the screen; lines may be broken anywhere.
int times_on_screen(const std::string& text) {
    const auto without_spaces = [](const std::string& words) {
        std::string letters;
        std::copy_if(words.begin(), words.end(), std::back_inserter(letters), [](char c) { return c != ' '; });
        return letters;
    };
    std::string all;
    for (const std::string& words : words_on_screen()) all += without_spaces(words);
    int times = 0;
    const std::string wanted = without_spaces(text);
    for (std::size_t at = all.find(wanted); at != all.npos; at = all.find(wanted, at + 1)) ++times;
    return times;
}

// A body with many refused tries, cut once for all.
class CutWing : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        Driver::Options options;
        options.parts = 8;
        options.volume = false;
        driver_ = new Driver(options);
        driver_->open(asset_path("wing_in_box"));
    }
    static void TearDownTestSuite() {
        delete driver_;
        driver_ = nullptr;
    }
    void SetUp() override {
        driver_->state() = {};
        driver_->settle();
    }

    // As they are listed from top to bottom.
    static std::vector<NodeId> listed() {
        driver_->settle();
        std::vector<std::pair<float, NodeId>> rows;
        for (const auto& [label, item] : driver_->app().widgets().items())
            if (label.starts_with("node ") && item.visible) rows.emplace_back(item.top, std::stoi(label.substr(5)));
        std::sort(rows.begin(), rows.end());
        std::vector<NodeId> nodes;
        for (const auto& row : rows) nodes.push_back(row.second);
        return nodes;
    }
    static std::vector<NodeId> in_order() {
        std::vector<NodeId> nodes;
        for (const TreeRow* row : driver_->document().tree.in_order()) nodes.push_back(row->id);
        return nodes;
    }
    static Driver* driver_;
};
Driver* CutWing::driver_ = nullptr;

TEST_F(CutWing, SortsByTheHeadOfAColumn) {
    driver_->state().look.surface = driver_->state().look.context = false;  // faster
    driver_->click("Columns");
    for (const char* column : {"column tries", "column angle", "column dihedral", "column ratio"})
        driver_->click(column);
    driver_->click("Columns");  // which closes the list
    EXPECT_EQ(listed(), in_order());
    const std::vector<std::string> heads = words_on_screen();
    for (const char* head : {"node", "tries", "angle", "dihedral", "ratio"})
        EXPECT_EQ(std::count(heads.begin(), heads.end(), head), 1) << head;
    const Tree& tree = driver_->document().tree;
    struct Column {
        const char* head;
        double (*number)(const CutSummary&);
        bool large_first;
    };
    const Column columns[] = {
        {"tries", [](const CutSummary& cut) -> double { return cut.tries; }, true},
        {"angle", [](const CutSummary& cut) { return cut.quality.angle_deg; }, false},
        {"dihedral", [](const CutSummary& cut) { return cut.quality.dihedral_deg; }, false},
        {"ratio", [](const CutSummary& cut) { return cut.interface_area / cut.section_area; }, true},
    };
    for (const Column& column : columns) {
        const std::string head = std::string("sort by ") + column.head;
        for (const bool reversed : {false, true}) {
            driver_->click(head);
            const std::vector<NodeId> nodes = listed();
            ASSERT_EQ(nodes.size(), tree.rows.size());
            std::vector<double> numbers;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const TreeRow& row = *tree.find(nodes[i]);
                EXPECT_EQ(row.leaf(), i >= nodes.size() / 2) << "parts have no cut and come last";
                if (!row.leaf()) numbers.push_back(column.number(*row.cut));
            }
            if (column.large_first != reversed) std::reverse(numbers.begin(), numbers.end());
            EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end())) << head << " " << reversed;
        }
    }
    driver_->click("sort by ratio");
    EXPECT_EQ(listed(), in_order()) << "the third time";
    driver_->click("Columns");
    for (const char* column : {"column tries", "column angle", "column dihedral", "column ratio"})
        driver_->click(column);
    driver_->click("Columns");
    driver_->click("sort by facets");
    EXPECT_NE(listed(), in_order());
    driver_->click("sort by node");
    EXPECT_EQ(listed(), in_order());
}

TEST_F(CutWing, FoldsWhatLiesBelowANode) {
    const std::vector<NodeId> all = listed();
    driver_->click("fold 2");
    EXPECT_EQ(driver_->state().node, root_node) << "it is not chosen by that";
    std::vector<NodeId> left = all;
    std::erase_if(left, [](NodeId node) { return node != NodeId(2) && lies_below(node, NodeId(2)); });
    EXPECT_EQ(listed(), left);
    driver_->click("node 2");
    EXPECT_EQ(listed(), left);
    driver_->key(key_down);
    EXPECT_EQ(driver_->state().node, NodeId(4));
    EXPECT_EQ(listed(), all) << "what is shown is listed";
    driver_->click("fold 1");
    EXPECT_EQ(listed(), std::vector<NodeId>{root_node});
    driver_->click("fold 1");
    EXPECT_EQ(listed(), all);
}

// Left of the number of a node of the third level there are lines from the top of its row to the bottom.
TEST_F(CutWing, LevelsHaveLines) {
    const Image picture = driver_->picture();
    const auto lines_left_of = [&](int node) {
        const ItemRect number = *driver_->app().widgets().find("node " + std::to_string(node));
        int lines = 0;
        for (int x = 2; x < static_cast<int>(number.left) - 16; ++x) {
            bool is_line = true;
            for (int y = static_cast<int>(number.top) + 1; y < static_cast<int>(number.bottom) - 1; ++y)
                is_line &= std::abs(picture.pixel(x, y)[0] - picture.pixel(x - 2, y)[0]) > 8 &&
                           std::abs(picture.pixel(x, y)[0] - picture.pixel(x + 2, y)[0]) > 8;
            lines += is_line;
        }
        return lines;
    };
    EXPECT_EQ(lines_left_of(3), 1);
    EXPECT_EQ(lines_left_of(5), 2);
    EXPECT_EQ(lines_left_of(9), 3);
}

TEST_F(CutWing, AClickOnTheWorstInterfaceFliesThere) {
    const auto smallest = [&](double InterfaceQuality::*angle) {
        const auto& cuts = driver_->document().trace->cuts;
        return *std::min_element(cuts.begin(), cuts.end(), [&](const Cut& a, const Cut& b) {
            return (a.made() ? a.quality.*angle : 180) < (b.made() ? b.quality.*angle : 180);
        });
    };
    driver_->click("Worst interfaces");
    const double height = driver_->app().camera().height;
    for (const bool by_angle : {false, true}) {
        driver_->click(by_angle ? "By angle" : "By dihedral");
        driver_->click("worst interface 1");
        const Cut cut = smallest(by_angle ? &InterfaceQuality::angle_deg : &InterfaceQuality::dihedral_deg);
        EXPECT_EQ(driver_->state().node, cut.node);
        EXPECT_EQ(name(driver_->state().step), "interface");
        driver_->settle();
        const auto surface = driver_->app().session().fetched().surface(cut.node);
        ASSERT_TRUE(surface);
        const std::optional<InterfacePlace> worst =
            by_angle ? smallest_angle(cut.interface) : smallest_dihedral(cut.interface, *surface);
        ASSERT_TRUE(worst);
        EXPECT_NEAR(worst->angle_deg, by_angle ? cut.quality.angle_deg : cut.quality.dihedral_deg, 1e-9)
            << "as the kernel has measured it";
        EXPECT_EQ(driver_->app().camera().target, worst->where);
        EXPECT_LT(driver_->app().camera().height, height / 2);
    }
    driver_->click("Worst interfaces");
}

// A run of one part has nothing to cut and a part to choose.
TEST(TreeOfOnePart, IsShownOnceItHasRun) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    EXPECT_EQ(driver.document().options.parts, 4) << "what the run is to have is known before it";
    EXPECT_GT(times_on_screen("has not been cut yet"), 0);
    EXPECT_FALSE(driver.app().widgets().find("node 1"));
    RunRequest run;
    run.parts = 1;
    driver.app().session().start_run(run, true);
    driver.await("the run", [&] { return !driver.app().session().busy(); });
    driver.settle();
    EXPECT_EQ(times_on_screen("has not been cut yet"), 0);
    EXPECT_TRUE(driver.app().widgets().find("node 1"));
    EXPECT_TRUE(driver.app().widgets().find("step tetrahedra"));
}

TEST(RefusedTry, PlacesAreFlownToAndPairsDrawn) {
    Driver::Options options;
    options.parts = 16;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("wing_in_box"));
    ViewState& state = driver.state();
    std::ptrdiff_t pairs = 0;
    for (const Cut& cut : driver.document().trace->cuts)
        for (std::size_t i = 0; i < cut.tries.size() && pairs == 0; ++i) {
            pairs = std::ssize(cut.tries[i].collisions);
            state.node = cut.node;
            state.step = {Stage::plane, static_cast<std::int32_t>(i)};
        }
    ASSERT_GT(pairs, 1) << "choose an asset with a try that was refused for an intersection";
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::colliding).triangles, pairs);
    EXPECT_EQ(driver.drawn(LayerKind::collided).triangles, pairs);
    const std::vector<FailurePlace> places = failure_places(driver.document(), state.node, state.step);
    ASSERT_EQ(std::ssize(places), pairs);
    EXPECT_FALSE(driver.offers("previous place"));
    const double height = driver.app().camera().height;
    driver.click("next place");
    EXPECT_EQ(driver.app().camera().target, places[0].where);
    EXPECT_LT(driver.app().camera().height, height);
    EXPECT_EQ(times_on_screen("place 1 of " + std::to_string(pairs)), 1);
    driver.click("next place");
    EXPECT_EQ(driver.app().camera().target, places[1].where);
    driver.click("previous place");
    EXPECT_EQ(driver.app().camera().target, places[0].where);
}

TEST_F(CutWing, TriesAreDescribedInWords) {
    std::set<std::string> words;
    for (const Cut& cut : driver_->document().trace->cuts)
        for (std::size_t i = 0; i < cut.tries.size(); ++i) {
            const std::string text =
                describe_step(driver_->document(), cut.node, {Stage::plane, static_cast<std::int32_t>(i)});
            EXPECT_EQ(text.find("axis 0"), text.npos) << text;
            const CutTry& attempt = cut.tries[i];
            if (attempt.axis == 0 && attempt.step == 0 && attempt.repair == 1)
                words.insert(text.substr(text.find(": first axis")));
            if (attempt.axis == 0 && attempt.step == 1 && attempt.repair == 0)
                words.insert(text.substr(text.find(": first axis")));
        }
    EXPECT_TRUE(words.contains(": first axis, the plane in its first place, after 1 repair."));
}

TEST_F(CutWing, NothingIsPulledApartWhereThereIsOnePiece) {
    for (const Stage stage : {Stage::input, Stage::plane, Stage::contour, Stage::interface}) {
        driver_->state().step = {stage, -1};
        driver_->settle();
        EXPECT_FALSE(driver_->offers("Explode")) << name(stage);
    }
    const ItemRect slider = *driver_->app().widgets().find("Explode");
    driver_->move_to((slider.left + slider.right) / 2, (slider.top + slider.bottom) / 2);
    driver_->frame();
    driver_->frame();
    EXPECT_EQ(times_on_screen("only the halves (Split) and the parts (Tetrahedra) can be pulled apart"), 1);
    driver_->state().step = {Stage::split, -1};
    driver_->settle();
    EXPECT_TRUE(driver_->offers("Explode"));
}

TEST_F(CutWing, AllOfTheTextOfAStepIsSeen) {
    for (const NodeId node : {root_node, NodeId(4)}) {
        driver_->state().node = node;
        driver_->settle();
        const std::vector<Step> steps = driver_->app().steps();
        for (const Step& step : steps) {
            if (step.refused_try > 4) continue;
            driver_->state().step = step;
            driver_->settle();
            const std::string text = describe_step(driver_->document(), node, step);
            EXPECT_EQ(times_on_screen(text), step.refused_try < 0 ? 1 : 2) << text;  // of tries in the scene, too
        }
    }
}

TEST(Timeline, IsReadableInTheSmallestWindow) {
    Driver::Options options;
    options.width = 900;
    options.height = 560;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("hollow_box"));
    const std::vector<Step> steps = driver.app().steps();
    for (const Step& step : steps) {
        driver.state().step = step;
        driver.settle();
        EXPECT_EQ(times_on_screen(describe_step(driver.document(), root_node, step)), step.refused_try < 0 ? 1 : 2)
            << name(step);
        const std::vector<std::string> words = words_on_screen();
        for (const Step& other : steps)
            EXPECT_TRUE(other.refused_try >= 0 || std::count(words.begin(), words.end(), title(other)) > 0)
                << title(other) << ": the button in full";
    }
}

TEST(Timeline, StraightContoursAreCalledSo) {
    Driver::Options options;
    options.parts = 2;
    options.volume = false;
    options.contour = ContourMethod::straight;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().step = {Stage::contour, -1};
    driver.settle();
    int times = 0;
    for (const std::string& words : words_on_screen()) {
        times += words.find("Straight contour: ") != words.npos;
        EXPECT_EQ(words.find("moothed"), words.npos) << words;
    }
    EXPECT_EQ(times, 1);
}

TEST(Timeline, OffersToRecordStagesThatAreMissing) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_kerf({"decompose", asset_path("cube"), "-o", folder.file("run"), "-n", "2", "-q"}).exit_code, 0);
    Driver driver;
    driver.open(folder.file("run"));
    ASSERT_FALSE(driver.document().trace);
    const std::vector<std::string> words = words_on_screen();
    EXPECT_EQ(std::count(words.begin(), words.end(), "No stages were recorded."), 1);
    driver.click("Re-run cut");
    driver.await("the stages", [&] { return driver.document().trace && !driver.app().session().busy(); });
    driver.settle();
    EXPECT_FALSE(driver.app().widgets().find("Re-run cut"));
    EXPECT_GT(driver.app().steps().size(), 8u);
    EXPECT_TRUE(std::filesystem::exists(folder.file("run/report.json"))) << "the run that was open is still there";
}

}  // namespace
}  // namespace kerf::test
