// What one sees before anything is open, and what a click on it does.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "files/io/surface_formats.h"
#include "support/assets.h"
#include "support/temporary_folder.h"
#include "viewer/driver.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

namespace fs = std::filesystem;
using namespace view;

const fs::path assets = fs::path(asset_path("cube")).parent_path();

Driver::Options with_examples(const fs::path& folder) {
    Driver::Options options;
    options.auto_run = false;
    options.example_folder = folder.string();
    return options;
}

std::vector<std::string> examples_on_screen(Driver& driver) {
    std::vector<std::string> names;
    for (const auto& [name, rect] : driver.app().widgets().items())
        if (name.starts_with("example ")) names.push_back(name);
    return names;
}

bool is_said(const std::string& words) {
    const std::vector<std::string> lines = words_on_screen();
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

// What can be read is named at the start, and in the list of files.
TEST(StartPage, KnowsEveryFormatThatIsRead) {
    const TemporaryFolder folder;
    const std::vector<std::string> formats = {".stl",  ".obj",   ".ply",  ".off",  ".msh",  ".vtu",  ".vtp", ".vtk",
                                              ".mesh", ".smesh", ".poly", ".step", ".iges", ".brep", ".3mf"};
    for (const SurfaceFormat& format : surface_formats()) {
        const std::string ending(format.endings.substr(0, format.endings.find(' ')));
        EXPECT_NE(std::find(formats.begin(), formats.end(), ending), formats.end()) << ending;
    }
    for (const std::string& format : formats) std::ofstream(folder.file("a" + format + ".gz")) << "x";
    std::ofstream(folder.file("a.txt")) << "x";
    Driver driver(with_examples(assets));
    driver.settle();
    for (const std::string& format : formats) {
        std::string upper = format.substr(1);
        for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        EXPECT_TRUE(is_said(format) || is_said(upper)) << format;
    }
    const fs::path before = fs::current_path();
    fs::current_path(fs::path(folder.file("a.txt")).parent_path());
    driver.key(key_of('O'), true);
    driver.settle();
    fs::current_path(before);
    for (const std::string& format : formats) EXPECT_TRUE(is_said("a" + format + ".gz")) << format;
    EXPECT_FALSE(is_said("a.txt"));
}

TEST(StartPage, ShowsEverySurfaceOfTheFolder) {
    Driver driver(with_examples(assets));
    driver.settle();
    const auto surfaces = std::count_if(fs::directory_iterator(assets), fs::directory_iterator(),
                                        [](const auto& entry) { return entry.path().extension() == ".stl"; });
    ASSERT_GT(surfaces, 5);
    EXPECT_EQ(std::ssize(examples_on_screen(driver)), surfaces);
    for (const auto& entry : fs::directory_iterator(assets)) {
        const fs::path picture = assets / "gallery/surfaces" / entry.path().stem().concat(".png");
        EXPECT_TRUE(entry.path().extension() != ".stl" || fs::exists(picture))
            << "draw it by assets/gallery/make_gallery.sh surfaces";
    }
    EXPECT_TRUE(is_said("4.66 k facets")) << "those of the cube";
    driver.click("example Cube");
    driver.await("the cube", [&] { return driver.document().input_facets == 4660; });
    driver.settle();
    EXPECT_TRUE(examples_on_screen(driver).empty());
}

TEST(StartPage, DoesWithoutExamples) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("short.stl")) << "solid";
    std::ofstream(folder.file("notes.txt")) << std::string(200, 'x');
    fs::create_directories(folder.file("gallery/surfaces"));
    std::ofstream(folder.file("gallery/surfaces/no_picture.png")) << "no picture";
    for (const std::string& place : {std::string(), folder.file("missing"), folder.file("")}) {
        Driver driver(with_examples(place));
        driver.settle();
        EXPECT_TRUE(examples_on_screen(driver).empty()) << place;
        EXPECT_FALSE(driver.app().widgets().find("Show me how a cut is made"));
        EXPECT_TRUE(driver.offers("Choose a file..."));
    }
    fs::copy_file(asset_path("cube"), folder.file("no_picture.stl"));
    Driver driver(with_examples(folder.file("")));
    driver.settle();
    EXPECT_EQ(examples_on_screen(driver), std::vector<std::string>{"example No picture"});
    EXPECT_FALSE(driver.picture().rgb.empty());
}

TEST(StartPage, TellsWhatWasOpenBefore) {
    const TemporaryFolder folder;
    Driver::Options options = with_examples("");
    options.config_folder = folder.file("config");
    {
        Driver driver(options);
        driver.open(asset_path("cube"));
    }
    Driver driver(options);
    driver.settle();
    ASSERT_EQ(driver.app().settings().recent.size(), 1u);
    EXPECT_EQ(driver.app().settings().recent.front().sizes, "4.66 k facets");
    EXPECT_TRUE(is_said("cube.stl"));
    EXPECT_TRUE(is_said(driver.app().settings().recent.front().day + ", 4.66 k facets"));
    driver.click("open recent 1");
    driver.await("the cube", [&] { return driver.document().input_facets == 4660; });
}

// Older files have paths alone; what is damaged is no error.
TEST(StartPage, ReadsOlderSettings) {
    const TemporaryFolder folder;
    Driver::Options options = with_examples("");
    options.config_folder = folder.file("");
    std::ofstream(folder.file("viewer.json")) << R"({"recent": ["/some/where/a.stl", {"path": "/b/"}]})";
    {
        Driver driver(options);
        driver.settle();
        ASSERT_EQ(driver.app().settings().recent.size(), 2u);
        EXPECT_TRUE(is_said("a.stl"));
        EXPECT_EQ(driver.app().settings().recent[1].path, "/b/");
        EXPECT_TRUE(is_said("b")) << "a folder has its own name";
    }
    std::ofstream(folder.file("viewer.json")) << R"({"recent": [{"day": 3}], "theme": "dark"})";
    Driver driver(options);
    EXPECT_TRUE(driver.app().settings().recent.empty());
}

TEST(StartPage, ShowsHowACutIsMade) {
    Driver::Options options = with_examples(assets);
    options.auto_run = true;
    options.volume = false;
    Driver driver(options);
    driver.settle();
    driver.click("Show me how a cut is made");
    driver.await("the tour", [&] { return driver.app().widgets().find("Next").has_value(); });
    driver.settle();
    EXPECT_EQ(driver.state().step.stage, Stage::input);
    EXPECT_TRUE(is_said("14,072 triangles"));
    driver.click("Next");
    EXPECT_EQ(driver.state().step.stage, Stage::plane);
}

}  // namespace
}  // namespace kerf::test
