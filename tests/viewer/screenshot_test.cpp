// kerf screenshot and kerf view as a user starts them.
#include <csignal>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/started_run.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/golden_image.h"

namespace kerf::test {
namespace {

const TemporaryFolder& folder() {
    static const TemporaryFolder all;
    return all;
}

ChildResult screenshot(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "screenshot");
    for (const char* more : {"-o", "--resolution"})
        arguments.emplace_back(more), arguments.emplace_back(more[1] == 'o' ? folder().file("a.png") : "320x240");
    std::filesystem::remove(folder().file("a.png"));
    return run_kerf(arguments);
}

TEST(Screenshot, OfASurfaceARunAndATraceShowTheSameCut) {
    const std::string run = folder().file("run"), trace = folder().file("cuts.trace");
    ASSERT_EQ(run_kerf({"mesh", asset_path("cylinder"), "-o", run, "-n", "4", "-q", "--trace", trace}).exit_code, 0);
    const auto picture = [](const std::string& input, const std::string& stage) {
        const ChildResult result = screenshot({input, "--node", "1", "--stage", stage, "-n", "4"});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        EXPECT_EQ(output_of(result), "");
        return read_png(folder().file("a.png"));
    };
    const view::Image plane = picture(asset_path("cylinder"), "plane");
    EXPECT_EQ(plane.width, 320);
    EXPECT_EQ(plane.rgb, picture(trace, "plane").rgb);
    EXPECT_EQ(plane.rgb, picture(run, "plane").rgb);
    // A run has no contours, but its halves.
    EXPECT_EQ(picture(asset_path("cylinder"), "contour").rgb, picture(trace, "contour").rgb);
    EXPECT_LE(compare(picture(trace, "split"), picture(run, "split")).differing, most_differing);
    ASSERT_EQ(screenshot({run, "--stage", "tetrahedra", "--clip", "x=0.4", "--explode", "0.4", "--color",
                          "min-dihedral", "--ui"})
                  .exit_code,
              0);
}

TEST(Screenshot, ShowsTheSideThatIsAskedFor) {
    const auto picture = [](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {asset_path("hollow_box"), "--surface", "split"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult result = screenshot(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return read_png(folder().file("a.png")).rgb;
    };
    const auto usual = picture({}), front = picture({"--view", "front"});
    EXPECT_EQ(picture({"--view", "iso"}), usual);
    EXPECT_EQ(picture({"--up", "z"}), usual);
    EXPECT_NE(front, usual);
    EXPECT_NE(picture({"--view", "top"}), front);
    EXPECT_NE(picture({"--view", "iso", "--up", "y"}), usual);
}

// A folder of kerf decompose has no cells: its parts are shown, coloured and pulled apart unless somebody wants
// something else.
TEST(Screenshot, OfDecomposedPartsPullsThemApart) {
    const std::string run = folder().file("decomposed");
    ASSERT_EQ(run_kerf({"decompose", asset_path("cylinder"), "-o", run, "-n", "4", "-q"}).exit_code, 0);
    const auto picture = [&](std::vector<std::string> more) {
        more.insert(more.begin(), run);
        const ChildResult result = screenshot(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return read_png(folder().file("a.png"));
    };
    const view::Image usual = picture({});
    EXPECT_EQ(usual.rgb, picture({"--stage", "parts", "--explode", "0.4"}).rgb);
    EXPECT_EQ(usual.rgb, picture({"--color", "part", "--explode", "0.4"}).rgb);
    const view::Image together = picture({"--explode", "0"});
    EXPECT_EQ(together.rgb, picture({"--stage", "parts"}).rgb);
    EXPECT_GT(compare(usual, together).differing, 20 * most_differing);
    EXPECT_GT(compare(together, picture({"--stage", "input"})).differing, 20 * most_differing) << "parts have colours";
    const ChildResult cells = screenshot({run, "--color", "min-dihedral"});
    EXPECT_EQ(cells.exit_code, 2);
    EXPECT_NE(cells.log.find("kerf mesh makes them"), std::string::npos) << cells.log;
}

// Without a camera of its own a cut is looked at, as large as the picture allows.
TEST(Screenshot, LooksAtTheClipPlane) {
    const auto picture = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {asset_path("cylinder"), "--no-legend"});
        const ChildResult result = screenshot(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return read_png(folder().file("a.png"));
    };
    std::ofstream(folder().file("from_left.json")) << R"({"back": [-1, 0, 0], "up": [0, 0, 1], "height": 100})";
    std::ofstream(folder().file("state.json")) << R"({"clip": {"on": true, "position": 0.5, "flipped": true}})";
    const view::Image faced = picture({"--clip", "-x=0.5"});
    EXPECT_GT(compare(faced, picture({"--state", folder().file("state.json"), "--no-legend"})).differing,
              20 * most_differing)
        << "seen from the corner";
    const view::Image by_hand =
        picture({"--clip", "-x=0.5", "--camera", folder().file("from_left.json"), "--no-legend"});
    EXPECT_GT(compare(faced, by_hand).differing, 20 * most_differing) << "a camera that is given wins";
}

// What a mesh has behind the plane is its cells, not the inner side of its surface.
TEST(Screenshot, ShowsCellsWhereAMeshIsCutOpen) {
    const std::string run = folder().file("cut_open");
    ASSERT_EQ(run_kerf({"mesh", asset_path("cylinder"), "-o", run, "-n", "2", "-q"}).exit_code, 0);
    const auto picture = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {run, "--clip", "x=0.5"});
        const ChildResult result = screenshot(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return read_png(folder().file("a.png"));
    };
    const view::Image usual = picture({});
    EXPECT_EQ(usual.rgb, picture({"--stage", "tetrahedra"}).rgb);
    EXPECT_GT(compare(usual, picture({"--stage", "input"})).differing, 20 * most_differing);
}

// Pictures before and after remeshing, each by one command.
TEST(Screenshot, ShowsTheSurfaceBeforeAndAfterRemeshing) {
    const std::string prism = folder().file("prism.stl");
    std::ofstream(prism) << to_ascii_stl(test::prism(24, 1, 4));
    const auto picture = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {prism, "-n", "2", "--no-legend"});
        const ChildResult result = screenshot(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return read_png(folder().file("a.png"));
    };
    const view::Image before = picture({"--surface", "remesh", "--stage", "before-remeshing"});
    EXPECT_LE(compare(before, picture({"--surface", "split", "--stage", "input", "--features"})).differing, 0.1);
    const view::Image deviation = picture({"--surface", "remesh", "--color", "deviation"});
    EXPECT_GT(compare(before, deviation).differing, 20 * most_differing);
    const ChildResult kept = screenshot({prism, "--surface", "split", "--color", "deviation"});
    EXPECT_EQ(kept.exit_code, 2);
    EXPECT_NE(kept.log.find("--surface remesh"), std::string::npos) << kept.log;
    EXPECT_EQ(screenshot({prism, "--surface", "split", "--stage", "before-remeshing"}).exit_code, 2);
    EXPECT_EQ(screenshot({prism, "--surface", "nicely"}).exit_code, 2);
}

// Options of a config file mend as --repair does, so there is a surface before them.
TEST(Screenshot, ShowsTheSurfaceBeforeRepairsOfAnyOption) {
    Soup cut = box(Vec3::Zero(), Vec3(1, 2, 3), 4);
    std::vector<char> is_end;
    for (const Triangle& t : cut.facets)
        is_end.push_back(std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return cut.vertices[v].z() == 3; }));
    drop_facets(cut, is_end);
    drop_unused_vertices(cut);
    const std::string open = folder().file("open_box.off"), config = folder().file("caps.toml");
    write_off(open, cut.vertices, cut.facets);
    const auto picture = [&](const std::string& option) {
        std::ofstream(config) << option << "\n";
        const ChildResult result = screenshot({open, "--config", config, "--stage", "before-repair"});
        EXPECT_EQ(result.exit_code, 0) << option << ": " << result.log;
        return result.exit_code == 0 ? read_png(folder().file("a.png")).rgb : std::vector<std::uint8_t>();
    };
    const auto named = picture("repair = \"caps\"");
    EXPECT_EQ(picture("cap = true"), named);
    EXPECT_EQ(picture("fill-holes = 16"), named);
    EXPECT_FALSE(picture("thicken = 0.1").empty()) << "seen from farther away, since walls are thick";
}

TEST(Screenshot, IsTheSameEveryTime) {
    std::string bytes;
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(screenshot({asset_path("cube")}).exit_code, 0);
        const std::string now = bytes_of_file(folder().file("a.png"));
        EXPECT_TRUE(bytes.empty() || bytes == now);
        bytes = now;
    }
}

TEST(Screenshot, ShowsABadSurfaceWithItsProblems) {
    write_off(folder().file("open.off"), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}});
    const ChildResult shown = screenshot({folder().file("open.off"), "--ui"});
    EXPECT_EQ(shown.exit_code, 0) << shown.log;
    const ChildResult cut = screenshot({folder().file("open.off"), "--stage", "contour"});
    EXPECT_EQ(cut.exit_code, 3);
    EXPECT_NE(cut.log.find("kerf check"), std::string::npos) << cut.log;
}

TEST(Screenshot, SaysWhatIsWrong) {
    const auto expect = [](const std::vector<std::string>& arguments, int code, const std::string& word) {
        const ChildResult result = screenshot(arguments);
        EXPECT_EQ(result.exit_code, code) << result.log;
        EXPECT_NE(result.log.find(word), std::string::npos) << result.log;
        EXPECT_FALSE(std::filesystem::exists(folder().file("a.png")));
    };
    expect({folder().file("nowhere.stl")}, 7, "nowhere.stl");
    expect({asset_path("cube"), "--node", "9", "--stage", "contour", "-n", "2"}, 2, "no node 9");
    expect({asset_path("cube"), "--node", "2", "--stage", "contour", "-n", "2"}, 2, "input");
    expect({asset_path("cube"), "--clip", "node=2", "-n", "2"}, 2, "not cut");
    expect({asset_path("cube"), "--stage", "sawing"}, 2, "sawing");
    expect({asset_path("cube"), "--clip", "x=nan"}, 2, "clip plane");
    expect({asset_path("cube"), "--stage", "tetrahedra", "--isolate", "99", "-n", "2"}, 2, "no node 99");
    expect({asset_path("cube"), "--filter", "1", "2"}, 2, "--filter");
    expect({asset_path("cube"), "--hide-patch", "lid*"}, 2, "the patch 'lid*', which the surface does not have");
    expect({asset_path("cube"), "--color", "shape", "--filter", "2", "1"}, 2, "--filter");
    expect({asset_path("cube"), "--stage", "split", "-n", "100000"}, 2, "too few");
    std::ofstream(folder().file("word.stl")) << "solid x\nfacet normal 0 0 up\n";
    expect({folder().file("word.stl")}, 3, "word.stl");
    for (const std::string option : {"--explode", "--shrink", "--timeout"})
        expect({asset_path("cube"), option, "nan"}, 2, "");
    std::filesystem::copy_file(asset_path("cube"), folder().file("a.stl"));
    const std::string before = bytes_of_file(folder().file("a.stl"));
    const ChildResult onto_input = run_kerf({"screenshot", folder().file("a.stl"), "-o", folder().file("a.stl")});
    EXPECT_EQ(onto_input.exit_code, 7) << onto_input.log;
    EXPECT_TRUE(bytes_of_file(folder().file("a.stl")) == before);
    const ChildResult no_png = run_kerf({"screenshot", asset_path("cube"), "-o", folder().file("a.svg")});
    EXPECT_EQ(no_png.exit_code, 2) << no_png.log;
    const ChildResult unwritable = run_kerf({"screenshot", asset_path("cube"), "-o", "/proc/a.png"});
    EXPECT_EQ(unwritable.exit_code, 7) << unwritable.log;
}

// Each of several, too.
TEST(Screenshot, ReplacesPicturesOfItsOwnAlone) {
    const auto draw = [](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> all = {"screenshot",        asset_path("cube"), "-o",
                                        folder().file(name), "--resolution",     "64x48"};
        all.insert(all.end(), more.begin(), more.end());
        return run_kerf(all);
    };
    for (const char* time : {"first", "again"}) EXPECT_EQ(draw("own.png", {}).exit_code, 0) << time;
    std::string photo = bytes_of_file(folder().file("own.png"));
    photo.replace(photo.find("Kerf"), 4, "Else");
    std::ofstream(folder().file("photo.png")) << photo;
    std::ofstream(folder().file("many_002.png")) << photo;
    for (const ChildResult& result : {draw("photo.png", {}), draw("many.png", {"--frames", "2"})}) {
        EXPECT_EQ(result.exit_code, 7) << result.log;
        EXPECT_NE(result.log.find("would be lost"), std::string::npos) << result.log;
    }
    EXPECT_EQ(bytes_of_file(folder().file("photo.png")), photo);
}

// A run with a hole in it is no picture of the run.
TEST(Screenshot, MissingAndCutPartFilesAreErrors) {
    const std::string run = folder().file("holed"), part = run + "/parts/part_0002.vtu";
    ASSERT_EQ(run_kerf({"mesh", asset_path("cube"), "-o", run, "-n", "2", "-q"}).exit_code, 0);
    const auto expect_error = [&](const std::string& word) {
        for (const std::vector<std::string>& view :
             {std::vector<std::string>{"--clip", "x=0.5"}, {"--explode", "0.3"}, {}}) {
            std::vector<std::string> arguments = {run};
            arguments.insert(arguments.end(), view.begin(), view.end());
            const ChildResult result = screenshot(arguments);
            EXPECT_EQ(result.exit_code, 7) << result.log;
            EXPECT_NE(result.log.find("part_0002.vtu is " + word), std::string::npos) << result.log;
        }
    };
    std::filesystem::resize_file(part, 5000);
    expect_error("cut short");
    std::filesystem::remove(part);
    expect_error("missing");
}

TEST(Screenshot, NamesOfAMegabyteAreShort) {
    std::ofstream file(folder().file("named.stl"));
    file << "solid " << std::string(1'000'000, 'x') << R"(
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 1 0 vertex 1 0 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 1 vertex 0 1 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet
endsolid)";
    file.close();
    EXPECT_EQ(screenshot({folder().file("named.stl"), "--color", "patch", "--ui"}).exit_code, 0);
}

// A picture that is no longer wanted takes its run and its folder along.
TEST(Screenshot, EndsItsRunWhenItIsInterrupted) {
    std::ofstream(folder().file("fine.toml")) << "size = 0.4\n";
    StartedRun picture(test::kerf_program(),
                       {"screenshot", asset_path("bearing_cap_52k"), "--stage", "tetrahedra", "-n", "4", "-o",
                        folder().file("b.png"), "--config", folder().file("fine.toml")});
    ASSERT_TRUE(await([&] { return !picture.workers().empty(); }));
    const std::vector<pid_t> workers = picture.workers();
    ::kill(picture.process(), SIGTERM);
    const ChildResult result = picture.wait();
    EXPECT_EQ(result.exit_code, 130) << result.log;
    for (const pid_t worker : workers) EXPECT_TRUE(await([&] { return has_ended(worker); }));
    const std::string left = "kerf-view-" + std::to_string(picture.process());
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::temp_directory_path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(left)) << entry.path();
}

TEST(Help, NamesTheViewersCommands) {
    EXPECT_NE(output_of(run_kerf({"--help"})).find("screenshot"), std::string::npos);
    const ChildResult help = run_kerf({"screenshot", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(output_of(help).find("--clip"), std::string::npos);
}

}  // namespace
}  // namespace kerf::test
