// Views that were looked at: one goes back to them and on again, whatever they were.
#include "viewer/model/view_history.h"

#include <random>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

using namespace view;

// Each unlike all others; of some only the camera differs from that before.
std::vector<ViewState> random_views(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<ViewState> views(1);
    while (views.size() < count) {
        ViewState view = views.back();
        view.camera.emplace().height = static_cast<double>(views.size());
        if (random() % 2 == 0) view.node = NodeId(1 + random() % 8);
        if (random() % 2 == 0) view.look.edges = !view.look.edges;
        views.push_back(view);
    }
    return views;
}

TEST(ViewHistory, LeadsBackToEveryViewAndOnAgain) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        ViewHistory history;
        const std::size_t count = ViewHistory::most + 20;
        const std::vector<ViewState> views = random_views(count, seed);
        for (std::size_t i = 0; i < count; ++i)
            for (int frame = 0; frame < 2; ++frame) history.note(views[i], "a.stl", static_cast<double>(i));
        const std::size_t first = count - ViewHistory::most;
        ViewState shown = views.back();
        for (std::size_t i = count - 1; i-- > first;) {
            shown = history.go_back(shown).value();
            EXPECT_EQ(shown, views[i]);
            history.note(shown, "a.stl", 1000);
        }
        EXPECT_FALSE(history.has_earlier());
        EXPECT_FALSE(history.go_back(shown));
        for (std::size_t i = first + 1; i < count; ++i) EXPECT_EQ(shown = history.go_on(shown).value(), views[i]);
        EXPECT_FALSE(history.has_later());
        EXPECT_FALSE(history.go_on(shown));
    }
}

TEST(ViewHistory, ForgetsWhatWasLaterThanANewView) {
    ViewHistory history;
    const std::vector<ViewState> views = random_views(4, 1);
    for (int i = 0; i < 3; ++i) history.note(views[i], "a.stl", i);
    const ViewState second = history.go_back(views[2]).value();
    EXPECT_TRUE(history.has_later());
    history.note(views[3], "a.stl", 3);
    EXPECT_FALSE(history.has_later());
    EXPECT_EQ(history.go_back(views[3]), second);
    history.note(views[0], "b.stl", 4);
    EXPECT_FALSE(history.has_earlier() || history.has_later()) << "of another document";
}

TEST(ViewHistory, TakesOneTurnOfAWheelForOneView) {
    ViewHistory history;
    ViewState state;
    history.note(state, "a.stl", 0);
    for (int i = 1; i <= 10; ++i) {
        state.camera.emplace().height = i;
        history.note(state, "a.stl", 5 + 0.1 * i);
    }
    EXPECT_EQ(history.go_back(state), ViewState());
    EXPECT_FALSE(history.has_earlier());
}

TEST(ViewHistory, LeavesPanelsSelectionAndThemeAsTheyAre) {
    ViewHistory history;
    ViewState state;
    history.note(state, "a.stl", 0);
    state.theme = Theme::dark;
    state.panels.tree = false;
    state.selection.kind = Selection::Kind::facet;
    history.note(state, "a.stl", 10);
    EXPECT_FALSE(history.has_earlier()) << "the view is the same";
    state.look.edges = false;
    history.note(state, "a.stl", 20);
    ViewState back = history.go_back(state).value();
    EXPECT_TRUE(back.look.edges);
    back.look.edges = false;
    EXPECT_EQ(back, state);
}

TEST(ViewHistory, IsGoneThroughByKeys) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    ASSERT_FALSE(driver.app().facts().has_earlier) << "nobody has changed anything";
    const ViewState first = driver.state();
    driver.key('1');
    driver.frame(10);
    const ViewState front = driver.state();
    driver.drag(600, 400, 700, 450);
    driver.frame(10);
    const ViewState dragged = driver.state();
    driver.key('E');
    driver.key('U');
    EXPECT_EQ(driver.state(), dragged);
    driver.key('U');
    EXPECT_EQ(driver.state(), front) << "a drag is one change";
    driver.key('U');
    EXPECT_EQ(driver.state(), first);
    EXPECT_FALSE(driver.app().facts().has_earlier);
    for (int i = 0; i < 3; ++i) driver.key('U', false, true);
    EXPECT_FALSE(driver.state().look.edges);
    EXPECT_EQ(driver.state().camera, dragged.camera);
    EXPECT_FALSE(driver.app().facts().has_later);
}

}  // namespace
}  // namespace kerf::test
