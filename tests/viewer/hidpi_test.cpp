// Screens with several pixels a unit of the window, and with larger fonts; and what the settings keep of the window.
#include <fstream>

#include <gtest/gtest.h>
#include <imgui.h>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/temporary_folder.h"
#include "viewer/app/settings.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

using namespace view;

Driver::Options options_of_screen(float pixels_per_unit, float scale) {
    Driver::Options options;
    options.width = 1000;
    options.height = 640;
    options.pixels_per_unit = pixels_per_unit;
    options.scale = scale;
    options.auto_run = false;
    return options;
}

struct Place {
    float x, y;
};
Place middle_of(const Rectangle& r) { return {std::floor(r.x + r.width / 2), std::floor(r.y + r.height / 2)}; }

// What a hand does on one screen: the same on all of them.
struct Work {
    Image picture;
    std::int64_t facet = -1;  // under the middle of the scene
    Camera camera;            // after a drag
    bool edges = true;        // after a click at their item
};

Work work(const Driver::Options& options) {
    Driver driver(options);
    driver.open(asset_path("cylinder"));
    Work done;
    done.picture = driver.picture();
    const auto [x, y] = middle_of(driver.app().scene_area());
    driver.click_at(x, y);
    driver.settle();
    if (driver.state().selection.kind == Selection::Kind::facet) done.facet = driver.state().selection.index;
    driver.click("Edges");
    done.edges = driver.state().look.edges;
    const float side = 0.2f * driver.app().scene_area().height;
    driver.drag(x, y, std::round(x + side), std::round(y + side));
    done.camera = driver.app().camera();
    return done;
}

TEST(HiDpi, TheMouseHitsWhatItPointsAtInPixelsAndInUnits) {
    const Work plain = work(options_of_screen(1, 1)), fine = work(options_of_screen(2, 2));
    EXPECT_EQ(fine.picture.width, 2 * plain.picture.width);
    EXPECT_EQ(fine.picture.height, 2 * plain.picture.height);
    EXPECT_GE(plain.facet, 0);
    EXPECT_EQ(fine.facet, plain.facet);
    EXPECT_FALSE(plain.edges);
    EXPECT_FALSE(fine.edges);
    EXPECT_LT(fine.camera.turn.angularDistance(plain.camera.turn), 0.01);
    EXPECT_GT(plain.camera.turn.angularDistance(Camera().turn), 0.1);

    // X11 counts in pixels and macOS does not: what is drawn is the same.
    Driver::Options in_pixels = options_of_screen(1, 2);
    in_pixels.width *= 2;
    in_pixels.height *= 2;
    const Work same = work(in_pixels);
    EXPECT_TRUE(fine.picture.rgb == same.picture.rgb);
    EXPECT_EQ(fine.facet, same.facet);
}

TEST(HiDpi, AWindowMovesBetweenScreens) {
    Driver driver(options_of_screen(1, 1));
    driver.open(asset_path("cube"));
    const Image plain = driver.picture();
    const float letter = ImGui::GetFontSize();
    for (const float scale : {2.f, 1.5f}) {
        driver.move_to_screen(scale, scale);
        EXPECT_EQ(driver.picture().width, std::lround(scale * 1000));
        EXPECT_NEAR(ImGui::GetFontSize(), scale * letter, 0.6);
        const bool edges = driver.state().look.edges;
        driver.click("Edges");
        EXPECT_NE(driver.state().look.edges, edges);
    }
    driver.move_to_screen(1, 1);
    driver.move_to(1, 1);
    EXPECT_TRUE(driver.picture().rgb == plain.rgb);
}

// A hand that trembles moves over more pixels where they are smaller.
TEST(HiDpi, AClickMayMoveAsFarAsElsewhere) {
    for (const float scale : {1.f, 2.f}) {
        Driver driver(options_of_screen(scale, scale));
        driver.open(asset_path("cube"));
        const auto [x, y] = middle_of(driver.app().scene_area());
        driver.drag(x, y, x + 3 * scale, y);
        driver.settle();
        EXPECT_NE(driver.state().selection.kind, Selection::Kind::none) << "at scale " << scale;
        EXPECT_FALSE(driver.state().camera) << "at scale " << scale;
    }
}

TEST(HiDpi, SizesThatNoWindowHasCountAsOne) {
    const FrameSize size = frame_size_of_window(2000, 1000, 1000, 500, 2);
    EXPECT_EQ(size.width, 2000);
    EXPECT_EQ(size.pixels_per_unit_x, 2);
    EXPECT_EQ(size.pixels_per_unit_y, 2);
    const FrameSize iconified = frame_size_of_window(0, 0, 0, 0, 0);
    EXPECT_EQ(iconified.width, 1);
    EXPECT_EQ(iconified.height, 1);
    EXPECT_EQ(iconified.pixels_per_unit_x, 1);
    EXPECT_EQ(iconified.scale, 1);
    EXPECT_EQ(frame_size_of_window(10, 10, 10, 10, 99).scale, 8);
}

TEST(WindowSettings, KeepSizeAndScale) {
    const TemporaryFolder folder;
    {
        Driver::Options options = options_of_screen(2, 2);
        options.config_folder = folder.file("config");
        Driver driver(options);
        driver.frame();
        driver.app().frame(frame_size_of_window(0, 0, 0, 0, 2), true);  // iconified
    }
    const WindowSize window = load_settings(folder.file("config")).window;
    EXPECT_EQ(window.width, 2000);
    EXPECT_EQ(window.height, 1280);
    EXPECT_EQ(window.scale, 2);
}

TEST(WindowSettings, BadValuesAreNotBelievedAndSpoilNoOthers) {
    const TemporaryFolder folder;
    const auto loaded = [&](const std::string& window) {
        std::ofstream(folder.file("viewer.json")) << R"({"theme": "dark", "window": )" << window << "}";
        const Settings settings = load_settings(folder.file(""));
        EXPECT_EQ(settings.theme, Theme::dark) << window;
        return settings.window;
    };
    const WindowSize good = loaded(R"({"width": 3000, "height": 2000, "scale": 1.5})"), usual;
    EXPECT_EQ(good.width, 3000);
    EXPECT_EQ(good.height, 2000);
    EXPECT_EQ(good.scale, 1.5);
    for (const char* bad :
         {"7", "null", "[]", "{}", R"({"width": 3000, "height": 2000})",
          R"({"width": 3000, "height": 2000, "scale": 0})", R"({"width": -3, "height": 2000, "scale": 1})",
          R"({"width": 3000, "height": 1e300, "scale": 1})", R"({"width": "3000", "height": 2000, "scale": 1})",
          R"({"width": 150, "height": 1000, "scale": 8})"}) {
        const WindowSize window = loaded(bad);
        EXPECT_EQ(window.width, usual.width) << bad;
        EXPECT_EQ(window.height, usual.height) << bad;
        EXPECT_EQ(window.scale, usual.scale) << bad;
    }
}

}  // namespace
}  // namespace kerf::test
