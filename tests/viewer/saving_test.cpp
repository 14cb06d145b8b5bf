// What is made in the window stays: runs, meshes, pages and pictures, each by a command that is shown, too.
#include <array>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "base/core/shell_word.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

namespace fs = std::filesystem;
using namespace view;

Driver::Options of_two_parts(bool asks_to_save) {
    Driver::Options options;
    options.parts = 2;
    options.asks_to_save = asks_to_save;
    return options;
}

// Dialogs offer places in the folder where the viewer was started.
class StartedIn {
 public:
    explicit StartedIn(const std::string& folder) { fs::current_path(folder); }
    ~StartedIn() { fs::current_path(before_); }
    StartedIn(const StartedIn&) = delete;
    StartedIn& operator=(const StartedIn&) = delete;

 private:
    fs::path before_ = fs::current_path();
};

void save_by_menu(Driver& driver, const std::string& entry) {
    driver.click("File");
    driver.click(entry);
    driver.settle();
}

ChildResult run_in_shell(const std::string& command) {
    const std::string folder = fs::path(test::kerf_program()).parent_path().string();
    return run_program("/bin/sh", {"-c", "PATH=" + shell_word(folder) + ":$PATH; " + command});
}

// The command that is copied makes the same bytes as the window has made.
TEST(Saving, ExportsAsTheShownCommandDoes) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    Driver driver(of_two_parts(false));
    driver.open(asset_path("cube"));
    save_by_menu(driver, "Export mesh...");
    driver.click("Copy command");
    const std::string command = ImGui::GetClipboardText();
    EXPECT_NE(command.find("cube_run"), std::string::npos)
        << "a mesh in a temporary folder is made once more: " << command;
    driver.click("Save");
    driver.await("the file", [&] { return driver.app().facts().notice.starts_with("saved as"); });
    const std::string bytes = bytes_of_file(folder.file("cube.vtu"));
    fs::remove(folder.file("cube.vtu"));
    EXPECT_EQ(run_in_shell(command).exit_code, 0) << command;
    EXPECT_TRUE(bytes_of_file(folder.file("cube.vtu")) == bytes);

    save_by_menu(driver, "Save report page...");
    driver.click("Save");
    driver.await("the page", [&] { return fs::exists(folder.file("cube.html")); });
    driver.await("its end", [&] { return !driver.app().session().writer().is_writing(); });

    save_by_menu(driver, "Save picture...");
    driver.click("Save");
    driver.await("the picture", [&] { return fs::exists(folder.file("cube.json")); });
    EXPECT_EQ(read_png(folder.file("cube.png")).width, 1280);
}

TEST(Saving, TellsWhyItCannot) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    Driver driver(of_two_parts(false));
    driver.open(asset_path("cube"));
    fs::create_directories(folder.file("cube.vtu/x"));
    save_by_menu(driver, "Export mesh...");
    driver.click("Save");
    driver.await("the end", [&] { return driver.app().facts().notice_is_error; });
    EXPECT_NE(driver.app().facts().notice.find("cube.vtu"), std::string::npos) << driver.app().facts().notice;
}

// A picture has its view beside it, as JSON: neither replaces what somebody else has written.
TEST(Saving, APictureReplacesPicturesAndViewsOfKerfAlone) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    Driver driver(of_two_parts(false));
    driver.open(asset_path("cube"));
    const auto save_picture = [&] {
        save_by_menu(driver, "Save picture...");
        driver.click("Save");
        driver.settle();
        return driver.app().facts().notice;
    };
    for (const char* file : {"cube.json", "cube.png"}) {
        std::ofstream(folder.file(file)) << "mine";
        EXPECT_NE(save_picture().find(file), std::string::npos);
        EXPECT_EQ(bytes_of_file(folder.file(file)), "mine");
        fs::remove(folder.file(file));
    }
    EXPECT_TRUE(save_picture().starts_with("saved as"));
    EXPECT_TRUE(save_picture().starts_with("saved as")) << "its own are replaced";
}

// A run that was saved before keeps its name and its files.
TEST(Saving, OffersANameThatNoRunHas) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    Driver driver(of_two_parts(false));
    driver.state().panels.parameters = true;
    const auto save = [&] {
        driver.open(asset_path("cube"));
        driver.state().panels.parameters = true;
        driver.click("Save run...");
        driver.click("Save");
        driver.await("the copy", [&] { return !driver.document().saved_as.empty(); });
        return fs::path(driver.document().saved_as).filename();
    };
    EXPECT_EQ(save(), "cube_run");
    EXPECT_EQ(save(), "cube_run_2");
}

// Nobody loses a mesh by opening another file or closing the window.
TEST(Saving, AsksBeforeAMeshIsLost) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    std::ofstream(folder.file("box.stl")) << to_ascii_stl(box({0, 0, 0}, {3, 2, 1}, {3, 2, 1}));
    Driver driver(of_two_parts(true));
    driver.open(asset_path("cube"));
    const std::string cube = driver.document().path;
    driver.drop(folder.file("box.stl"));
    driver.click("Stay here");
    EXPECT_EQ(driver.document().path, cube);
    EXPECT_FALSE(driver.app().facts().asks_to_save);
    driver.drop(folder.file("box.stl"));
    EXPECT_TRUE(driver.app().facts().asks_to_save);
    driver.click("Let it go");
    driver.await("the box", [&] {
        return driver.document().path == folder.file("box.stl") && driver.app().session().pair().can_save();
    });

    driver.app().desk().quit();
    EXPECT_FALSE(driver.app().desk().wants_to_quit());
    driver.settle();
    driver.click("Save it...");
    driver.settle();
    driver.click("Save");
    driver.await("the end", [&] { return driver.app().desk().wants_to_quit(); });
    EXPECT_EQ(run_kerf({"verify", folder.file("box_run"), "-q"}).exit_code, 0);
}

// Both runs of two that are compared, and a third one takes no place of an unsaved one in silence.
TEST(Saving, AsksForTheRunThatIsNotShown) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    Driver driver(of_two_parts(true));
    driver.open(asset_path("cube"));
    driver.state().panels.parameters = true;
    driver.settle();
    const std::string first = driver.document().folder;
    const auto has_ended = [&] { return driver.document().folder != first && driver.document().verified.has_value(); };
    driver.click("Run all");
    driver.await("the second run", has_ended);
    driver.settle();
    driver.click("Run all");
    driver.frame();
    ASSERT_EQ(driver.app().facts().at_stake, std::vector{UnsavedWork::other_run});
    driver.click("Stay here");
    EXPECT_FALSE(driver.app().session().busy());
    driver.app().desk().quit();
    driver.settle();
    EXPECT_EQ(driver.app().facts().at_stake, (std::vector{UnsavedWork::run, UnsavedWork::other_run}));
    driver.click("Save them...");
    driver.settle();
    driver.click("Save");
    driver.await("the other question", [&] { return driver.app().facts().asks_to_save; });
    EXPECT_EQ(driver.app().facts().at_stake, std::vector{UnsavedWork::other_run});
    driver.click("Save it...");
    driver.settle();
    driver.click("Save");
    driver.await("the end", [&] { return driver.app().desk().wants_to_quit(); });
    for (const char* saved : {"cube_run", "cube_run_2"})
        EXPECT_EQ(run_kerf({"verify", folder.file(saved), "-q"}).exit_code, 0) << saved;
}

TEST(Saving, AsksBeforeARepairedSurfaceIsLost) {
    const TemporaryFolder folder;
    const StartedIn here(folder.file(""));
    Soup box_with_hole = box({0, 0, 0}, {3, 2, 1}, {3, 2, 1});
    box_with_hole.facets.pop_back();
    std::ofstream(folder.file("box.stl")) << to_ascii_stl(box_with_hole);
    Driver::Options of_surface = of_two_parts(true);
    of_surface.auto_run = false;
    Driver driver(of_surface);
    driver.open(folder.file("box.stl"));
    driver.app().desk().quit();
    EXPECT_TRUE(driver.app().desk().wants_to_quit()) << "nothing is lost yet";
    InputOptions options = driver.document().options.input_options;
    options.repairs.plan = "holes";
    driver.app().session().repairs().repair(options);
    driver.await("the repair", [&] { return driver.document().unrepaired && !driver.app().session().busy(); });
    driver.drop(asset_path("cube"));
    ASSERT_EQ(driver.app().facts().at_stake, std::vector{UnsavedWork::surface});
    driver.click("Save it...");
    driver.settle();
    driver.click("Save");
    driver.await("the cube", [&] { return driver.document().path == asset_path("cube"); });
    EXPECT_TRUE(fs::exists(folder.file("box_repaired.obj")));
}

// Two runs of other times are compared like two of this window, under one camera.
TEST(Saving, TwoRunsAreOpenedToBeCompared) {
    const TemporaryFolder folder;
    const auto run = [&](const char* name, const char* parts) {
        EXPECT_EQ(run_kerf({"mesh", asset_path("cube"), "-o", folder.file(name), "-n", parts, "-q"}).exit_code, 0);
        return folder.file(name);
    };
    const std::string a = run("a", "2"), b = run("b", "3");
    Driver driver;
    driver.open_files({a, b});
    ASSERT_TRUE(driver.document().error.empty()) << driver.document().error;
    EXPECT_EQ(driver.document().path, b);
    ASSERT_TRUE(driver.app().session().other_document());
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 3u);
    EXPECT_GT(driver.drawn(LayerKind::part).triangles, 0);
    EXPECT_TRUE(driver.offers("B"));
    const Vec3 target = driver.app().camera().target;
    driver.key(key_of('B'));
    driver.settle();
    EXPECT_EQ(driver.document().path, a);
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 2u);
    EXPECT_GT(driver.drawn(LayerKind::part).triangles, 0);
    EXPECT_EQ(driver.app().camera().target, target);
}

// A run and its copy are the same picture on either side, from wherever one looks.
TEST(Saving, TwoRunsStandSideBySide) {
    const TemporaryFolder folder;
    for (const char* name : {"a", "b"})
        ASSERT_EQ(run_kerf({"mesh", asset_path("l_bracket"), "-o", folder.file(name), "-n", "2", "-q"}).exit_code, 0);
    Driver driver;
    driver.open_files({folder.file("a"), folder.file("b")});
    ASSERT_TRUE(driver.document().error.empty()) << driver.document().error;
    driver.state().look.legend = driver.state().look.scale_bar = false;
    // Pixels of one side that are not the other's, where no words are, and those that are not the background's. A pixel
    // at an edge may be another one, as its place in the window is rounded.
    struct Pixels {
        int other = 0, drawn = 0;
    };
    const auto compare = [&] {
        driver.settle();
        const Image picture = driver.picture();
        const Rectangle left = driver.app().facts().beside->area, right = driver.app().scene_area();
        EXPECT_NEAR(left.x + left.width, right.x, 1);
        Pixels pixels;
        for (int y = static_cast<int>(left.y + left.height / 4); y < left.y + left.height * 3 / 4; ++y)
            for (int x = 0; x < left.width; ++x) {
                const auto at = [&](float column) {
                    const std::uint8_t* rgb = picture.pixel(static_cast<int>(column), y);
                    return std::array{rgb[0], rgb[1], rgb[2]};
                };
                pixels.other += at(left.x + x) != at(right.x + x);
                pixels.drawn += at(left.x + x) != at(left.x + 2);
            }
        return pixels;
    };
    const Pixels fitted = compare();
    EXPECT_LT(fitted.other, fitted.drawn / 200);
    EXPECT_GT(fitted.drawn, 10'000);
    const Camera before = driver.app().camera();
    const Rectangle other = driver.app().facts().beside->area;
    const float x = other.x + other.width / 2, y = other.y + other.height / 2;
    driver.drag(x, y, x + 100, y + 50);
    driver.wheel(x, y, 2);
    EXPECT_NE(driver.app().camera().turn.coeffs(), before.turn.coeffs());
    EXPECT_LT(driver.app().camera().height, before.height);
    const Pixels nearer = compare();
    EXPECT_LT(nearer.other, nearer.drawn / 200);
    EXPECT_GT(nearer.drawn, fitted.drawn);
    // A click on the other run makes it the one of which the panels speak, where it is.
    const std::string shown = driver.document().path;
    driver.click_at(x, y);
    driver.settle();
    EXPECT_NE(driver.document().path, shown);
    EXPECT_EQ(driver.app().scene_area().x, other.x);
    EXPECT_EQ(driver.app().facts().notice, "The panels are about A now.");
    driver.key(key_of('B'), false, true);
    driver.settle();
    EXPECT_FALSE(driver.app().facts().beside);
    EXPECT_GT(driver.app().scene_area().width, other.width + 1);
}

// A patch in the way is hidden under the mouse, by a key or by its menu, and seen again.
TEST(Saving, HidesThePatchUnderTheMouse) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("box.stl")) << to_ascii_stl(box({0, 0, 0}, {3, 2, 1}, {3, 2, 1}));
    Driver driver(of_two_parts(false));
    driver.open(folder.file("box.stl"));
    driver.settle();
    const std::int64_t all = driver.drawn(LayerKind::part).triangles;
    const Rectangle body = driver.app().scene_area();
    driver.move_to(body.x + 0.45f * body.width, body.y + body.height / 2);
    driver.key(key_of('P'));
    driver.settle();
    ASSERT_EQ(driver.state().visibility.hidden_patches.size(), 1u);
    EXPECT_LT(driver.drawn(LayerKind::part).triangles, all);
    const std::vector<std::string> by_key = driver.state().visibility.hidden_patches;
    driver.key(key_of('P'), false, true);
    driver.settle();
    EXPECT_TRUE(driver.state().visibility.hidden_patches.empty());
    // A command that is chosen in a list means the place where the mouse was before.
    driver.key(key_of('K'), true);
    driver.type("hide the patch");
    driver.click("command Hide the patch under the mouse");
    driver.settle();
    EXPECT_EQ(driver.state().visibility.hidden_patches, by_key);
    driver.key(key_of('P'), false, true);
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::part).triangles, all);
    driver.click_at(body.x + 0.45f * body.width, body.y + body.height / 2, 1);
    driver.settle();
    driver.click("Hide this patch");
    EXPECT_EQ(driver.state().visibility.hidden_patches.size(), 1u);
    driver.key(key_of('P'), false, true);
    for (const std::string& patch : driver.document().patch_names)
        if (patch != by_key.front()) driver.state().visibility.hidden_patches.push_back(patch);
    driver.settle();
    driver.move_to(body.x + 0.45f * body.width, body.y + body.height / 2);
    driver.key(key_of('P'));
    EXPECT_EQ(std::ssize(driver.state().visibility.hidden_patches), std::ssize(driver.document().patch_names) - 1);
    EXPECT_NE(driver.app().facts().notice.find("Without this patch"), std::string::npos);
}

}  // namespace
}  // namespace kerf::test
