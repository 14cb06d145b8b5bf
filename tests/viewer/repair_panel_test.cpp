// Repairs in the Problems panel, as a user works with them, and their pictures.
#include <filesystem>

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"

namespace kerf::test {
namespace {

using namespace view;

// Half of it has facets with corners of their own, a little apart; two are there twice, one is missing.
Soup damaged_sphere() {
    const Soup whole = icosphere(2);
    Soup soup = whole;
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (std::int32_t& v : soup.facets[f]) {
            const Vec3& p = whole.vertices[static_cast<std::size_t>(v)];
            if (p.x() < 0.1) continue;
            soup.vertices.push_back(p * (1 + 1e-3 * static_cast<double>(f % 3)));
            v = static_cast<std::int32_t>(soup.vertices.size()) - 1;
        }
    soup.facets.insert(soup.facets.end(), soup.facets.begin(), soup.facets.begin() + 2);
    soup.facets.erase(soup.facets.begin() + 100);
    soup.patch.assign(soup.facets.size(), 0);
    return soup;
}

class RepairPanel : public testing::Test {
 protected:
    void SetUp() override { write_off(folder_.file("damaged.off"), soup_.vertices, soup_.facets); }
    void open(int width = 1280, int height = 800) {
        Driver::Options options;
        options.width = width;
        options.height = height;
        options.parts = 2;
        options.volume = false;
        driver_ = std::make_unique<Driver>(options);
        driver_->open(folder_.file("damaged.off"));
        ASSERT_TRUE(driver_->document().has_problems());
    }
    void await_repair() {
        driver_->await("the repair", [&] { return !driver_->app().session().busy(); });
        driver_->settle();
    }
    const std::string& plan() { return driver_->document().options.input_options.repairs.plan; }
    void type_plan(const std::string& text) {
        driver_->click("Steps");
        driver_->key(key_of('A'), true);
        driver_->type(text);
        driver_->settle();
    }
    void weld() {
        type_plan("weld=0.01,clean");
        driver_->click("Repair by these");
        await_repair();
    }

    const Soup soup_ = damaged_sphere();
    const TemporaryFolder folder_;
    std::unique_ptr<Driver> driver_;
};

TEST_F(RepairPanel, OffersTheStepForEachKindOfDefectAndTheLevels) {
    open();
    for (const char* level : {"exact", "near", "full"}) EXPECT_TRUE(driver_->offers(level)) << level;
    EXPECT_FALSE(driver_->offers("Undo"));
    EXPECT_FALSE(driver_->offers("Repair by these")) << "there are none";
    driver_->click("Repair: stitch,holes");
    await_repair();
    EXPECT_EQ(plan(), "stitch,holes");
    EXPECT_FALSE(driver_->offers("Repair: stitch,holes")) << "it was done";
    driver_->click("exact");
    await_repair();
    EXPECT_EQ(plan(), "stitch,holes,exact");
    EXPECT_FALSE(driver_->offers("exact"));
    driver_->key(key_of('Z'), true);
    driver_->settle();
    EXPECT_EQ(plan(), "stitch,holes");
    driver_->key(key_of('Z'), true);
    driver_->settle();
    EXPECT_EQ(plan(), "");
    driver_->key(key_of('Y'), true);
    driver_->settle();
    EXPECT_EQ(plan(), "stitch,holes");
    driver_->click("Redo");
    driver_->settle();
    EXPECT_EQ(plan(), "stitch,holes,exact");
    type_plan("welt");
    EXPECT_FALSE(driver_->offers("Repair by these")) << "no such step";
}

TEST_F(RepairPanel, ShowsOnePlaceBeforeAndAfter) {
    open();
    driver_->move_to(640, 400);
    weld();
    ASSERT_TRUE(driver_->document().unrepaired);
    const Camera camera = driver_->app().camera();
    EXPECT_GT(driver_->drawn(LayerKind::surface).triangles, 0);
    driver_->click("Before repairs");
    driver_->settle();
    EXPECT_EQ(driver_->drawn(LayerKind::file_surface).triangles, std::ssize(soup_.facets));
    EXPECT_EQ(driver_->drawn(LayerKind::surface).triangles, 0);
    EXPECT_GT(driver_->drawn(LayerKind::defect_places).points, 20);
    EXPECT_EQ(driver_->app().camera(), camera);
    driver_->key(key_of('B'));
    driver_->settle();
    EXPECT_EQ(driver_->drawn(LayerKind::file_surface).triangles, 0);
    EXPECT_EQ(driver_->drawn(LayerKind::surface).triangles, std::ssize(soup_.facets) - 2);
    driver_->click("Colour by distance");
    driver_->settle();
    EXPECT_EQ(driver_->state().coloring.by, ColorBy::deviation);
    ASSERT_TRUE(driver_->app().facts().legend.values);
    EXPECT_GT(driver_->app().facts().legend.values->high, 1e-4);
    EXPECT_LT(driver_->app().facts().legend.values->high, 0.01);
}

TEST_F(RepairPanel, FliesToThePlacesOfEachAction) {
    open();
    weld();
    const auto& steps = driver_->document().checked->ladder.steps;
    std::vector<const RepairAction*> actions;
    for (const StepReport& step : steps)
        for (const RepairAction& action : step.actions) actions.push_back(&action);
    ASSERT_GE(actions.size(), 2u);
    for (std::size_t i = 0; i < actions.size(); ++i) {
        const std::string label = "action " + std::to_string(i + 1);
        for (std::size_t place = 0; place < std::min<std::size_t>(2, actions[i]->places.size()); ++place) {
            driver_->click(label);
            driver_->settle();
            EXPECT_EQ(driver_->state().selection.place, actions[i]->places[place].where) << label;
            EXPECT_EQ(driver_->app().camera().target, actions[i]->places[place].where) << label;
        }
    }
}

TEST_F(RepairPanel, LeavesToTheUserWhetherTheResultIsMeshedOrSaved) {
    Soup whole = soup_;
    const Soup sphere = icosphere(2);
    whole.facets.push_back({0, 0, 0});
    for (std::size_t k = 0; k < 3; ++k) {
        whole.facets.back()[k] = static_cast<std::int32_t>(whole.vertices.size());
        whole.vertices.push_back(sphere.vertices[static_cast<std::size_t>(sphere.facets[100][k])]);
    }
    write_off(folder_.file("damaged.off"), whole.vertices, whole.facets);
    open();
    weld();
    EXPECT_FALSE(driver_->document().trace) << "nobody has asked for it";
    driver_->click("Save to");
    driver_->key(key_of('A'), true);
    driver_->type(folder_.file("saved.stl"));
    driver_->settle();
    driver_->click("Save surface");
    driver_->await("the file", [&] { return !driver_->document().surface_saved_as.empty(); });
    EXPECT_TRUE(std::filesystem::exists(folder_.file("saved.stl")));
    driver_->settle();
    ASSERT_FALSE(driver_->document().has_problems());
    driver_->state().panels.parameters = true;
    driver_->click("parts");
    driver_->key(key_of('A'), true);
    driver_->type("3");
    driver_->key(key_enter);
    driver_->click("Mesh it");
    driver_->await("the run", [&] { return driver_->document().trace && !driver_->app().session().busy(); });
    driver_->settle();
    EXPECT_EQ(driver_->document().options.parts, 3) << "as was typed";
    EXPECT_EQ(driver_->document().tree.parts_below(root_node).size(), 3u);
    EXPECT_EQ(driver_->app().steps().front().stage, Stage::before_repair);
    driver_->click("Problems");
    driver_->click("Undo");
    driver_->settle();
    EXPECT_TRUE(driver_->document().has_problems());
}

TEST_F(RepairPanel, LooksAsItShould) {
    open(480, 360);
    InputOptions options;
    options.repairs.weld_tolerance = 0.01;
    driver_->app().session().repairs().repair(options);
    driver_->show_panels(false);
    await_repair();
    driver_->state().step = {Stage::before_repair, -1};
    EXPECT_TRUE(is_golden("repair-before", *driver_));
    driver_->state().step = {Stage::input, -1};
    driver_->state().coloring.by = ColorBy::deviation;
    EXPECT_TRUE(is_golden("repair-after", *driver_));
}

}  // namespace
}  // namespace kerf::test
