// Panels that are resized, and handles in the scene.
#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/temporary_folder.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

using namespace view;

void drag_item(Driver& driver, const std::string& label, float dx, float dy) {
    driver.settle();
    const auto rect = driver.app().widgets().find(label);
    ASSERT_TRUE(rect) << label;
    const float x = (rect->left + rect->right) / 2, y = (rect->top + rect->bottom) / 2;
    driver.drag(x, y, x + dx, y + dy);
}

TEST(Panels, AreAsWideAsTheUserWantsAndStaySo) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.auto_run = true;
    options.volume = false;
    options.config_folder = folder.file("config");
    Rectangle resized;
    {
        Driver driver(options);
        driver.open(asset_path("hollow_box"));
        const Rectangle before = driver.app().scene_area();
        drag_item(driver, "left splitter", -80, 0);
        drag_item(driver, "right splitter", 60, 0);
        drag_item(driver, "timeline splitter", 0, -70);
        resized = driver.app().scene_area();
        EXPECT_NEAR(resized.x, before.x - 80, 2);
        EXPECT_NEAR(resized.width, before.width + 140, 3);
        EXPECT_NEAR(resized.height, before.height - 70, 2);
    }
    Driver driver(options);
    driver.open(asset_path("hollow_box"));
    EXPECT_EQ(driver.app().scene_area().x, resized.x) << "remembered";
    EXPECT_EQ(driver.app().scene_area().width, resized.width);
    EXPECT_EQ(driver.app().scene_area().height, resized.height);
}

TEST(Panels, LeaveTheSceneItsRoom) {
    Driver driver;
    driver.open(asset_path("hollow_box"));
    const Rectangle suggested = driver.app().scene_area();
    drag_item(driver, "left splitter", 1200, 0);
    drag_item(driver, "right splitter", -1200, 0);
    drag_item(driver, "timeline splitter", 0, -800);
    EXPECT_GE(driver.app().scene_area().width, 0.15f * 1280);
    EXPECT_GE(driver.app().scene_area().height, 0.4f * 800);
    for (const char* label : {"left splitter", "right splitter", "timeline splitter"}) {
        driver.settle();
        const auto rect = driver.app().widgets().find(label);
        ASSERT_TRUE(rect);
        driver.move_to((rect->left + rect->right) / 2, (rect->top + rect->bottom) / 2);
        for (int i = 0; i < 2; ++i) {
            driver.press();
            driver.release();
        }
        driver.frame(1);
    }
    EXPECT_EQ(driver.app().scene_area().x, suggested.x) << "two clicks: as the window suggests";
    EXPECT_EQ(driver.app().scene_area().width, suggested.width);
    EXPECT_EQ(driver.app().scene_area().height, suggested.height);
}

TEST(ClipHandles, MoveAndTurnThePlaneAndNothingElse) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().clip.on = true;
    driver.state().clip.normal = Vec3::UnitX();
    driver.settle();
    const auto arrow = [&] {
        driver.settle();
        const auto from = driver.app().widgets().find("move clip plane");
        const auto to = driver.app().widgets().find("turn clip plane");
        return Eigen::Vector2f(to->left - from->left, to->top - from->top);
    };
    const Eigen::Vector2f along = arrow().normalized() * 60;
    const ViewState before = driver.state();
    drag_item(driver, "move clip plane", along.x(), along.y());
    EXPECT_GT(driver.state().clip.position, before.clip.position + 0.05);
    EXPECT_EQ(driver.state().clip.normal, before.clip.normal);
    drag_item(driver, "move clip plane", -along.x(), -along.y());
    EXPECT_NEAR(driver.state().clip.position, before.clip.position, 0.02) << "and back";

    const Eigen::Vector2f direction = arrow();
    drag_item(driver, "turn clip plane", 40, 40);
    EXPECT_LT(driver.state().clip.normal.x(), 0.995);
    EXPECT_NEAR(driver.state().clip.normal.norm(), 1, 1e-9);
    EXPECT_NE(arrow(), direction) << "the arrow follows";
    EXPECT_EQ(driver.state().camera, before.camera);
    EXPECT_EQ(driver.state().selection, before.selection);

    driver.state().clip.flipped = true;
    const double flipped_from = driver.state().clip.position;
    const Eigen::Vector2f back = arrow().normalized() * 60;
    drag_item(driver, "move clip plane", back.x(), back.y());
    EXPECT_LT(driver.state().clip.position, flipped_from) << "the arrow points to what is hidden";
}

// The cut face is seen as soon as there is one, unless somebody wants the other half.
TEST(ClipPlane, ShowsTheHalfWhoseCutFaceIsSeen) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.key(key_of('1'));
    driver.click("Clip Y");
    EXPECT_TRUE(driver.state().clip.flipped) << "the front looks along Y";
    driver.key(key_of('9'));
    driver.key(key_of('C'));
    driver.key(key_of('C'));
    EXPECT_TRUE(driver.state().clip.on);
    EXPECT_FALSE(driver.state().clip.flipped);
    driver.click("Flip");
    driver.click("Clip plane");
    driver.click("Clip plane");
    EXPECT_TRUE(driver.state().clip.flipped) << "as was asked for";
}

// The cut is made where its plane was put, and the run before stays.
TEST(CutHandle, MovesThePlaneOfACut) {
    Driver::Options options;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("cylinder"));
    driver.state().step = {Stage::plane, -1};
    driver.settle();
    const Plane before = driver.document().trace->find(root_node)->plane;
    const Camera camera = driver.app().camera();
    const Eigen::Vector2d seen = *seen_from_target(camera, before.origin + 0.05 * camera.height * before.normal) -
                                 *seen_from_target(camera, before.origin);
    const Eigen::Vector2f along = Eigen::Vector2d(seen.x(), -seen.y()).normalized().cast<float>() * 60;
    drag_item(driver, "move cut", along.x(), along.y());
    driver.await("the cut", [&] { return driver.app().session().pair().can_swap(); });
    const Plane& after = driver.document().trace->find(root_node)->plane;
    const double pixels = static_cast<double>(driver.app().scene_area().height);
    const double moved = 60 / (seen.norm() * pixels) * 0.05 * camera.height;  // as it is seen near the plane
    EXPECT_NEAR(before.distance(after.origin), moved, 0.15 * moved);
    EXPECT_GT(std::abs(after.normal.dot(before.normal)), 1 - 1e-6);
    ASSERT_TRUE(driver.app().session().other_document());
    EXPECT_EQ(driver.app().session().other_document()->trace->find(root_node)->plane.origin, before.origin);
}

}  // namespace
}  // namespace kerf::test
