// Runs as a user has them: opened without a trace, under way, made again, compared, saved; and views that are saved.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <imgui.h>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/command_line.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"

namespace kerf::test {
namespace {

namespace fs = std::filesystem;
using namespace view;

// The facets of the input that a node has, or that are drawn around it.
struct OuterFacets {
    std::int64_t count = 0;
    double area = 0;

    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        ++count;
        area += (b - a).cross(c - a).norm() / 2;
    }
};

OuterFacets outer_facets(Driver& driver, NodeId node) {
    std::shared_ptr<const NodeSurface> surface;
    driver.await("a surface", [&] { return (surface = driver.app().session().fetched().surface(node)) != nullptr; });
    OuterFacets outer;
    for (std::size_t f = 0; f < surface->facets.size(); ++f) {
        const auto corner = [&](std::size_t i) -> const Vec3& {
            return surface->vertices[static_cast<std::size_t>(surface->facets[f][i])];
        };
        if (surface->interface_of[f] == no_node) outer.add(corner(0), corner(1), corner(2));
    }
    return outer;
}

OuterFacets context_of(Driver& driver) {
    driver.settle();
    OuterFacets context;
    for (const Layer& layer : driver.app().scene().scene.layers) {
        const std::vector<Corner>& corners = layer.geometry->corners;
        const auto place = [&](std::size_t i) -> Vec3 {
            const std::array<float, 3>& p = corners[i].position;
            return Vec3(p[0], p[1], p[2]) / driver.app().scene().frame.scale;
        };
        for (std::size_t i = 0; layer.kind == LayerKind::context && i < corners.size(); i += 3)
            context.add(place(i), place(i + 1), place(i + 2));
    }
    return context;
}

// The facets of a node and those around it are the surface of the input, each once, with a trace and without one; also
// where straight cuts have split facets, whose pieces have one number.
TEST(Runs, TheContextIsTheRestOfTheSurface) {
    const TemporaryFolder folder;
    const Soup prism = test::prism(7, 1, 5);
    write_off(folder.file("prism.off"), prism.vertices, prism.facets);
    for (const std::string& input : {asset_path("hollow_box"), folder.file("prism.off")}) {
        ASSERT_EQ(run_kerf({"mesh", input, "-q", "-n", "4", "-o", folder.file("run")}).exit_code, 0);
        Driver driver;
        driver.open(folder.file("run"));
        ASSERT_FALSE(driver.document().trace);
        const OuterFacets all = outer_facets(driver, root_node);
        for (const NodeId node : {NodeId(3), NodeId(4), NodeId(6)}) {
            driver.state().node = node;
            const OuterFacets own = outer_facets(driver, node), context = context_of(driver);
            EXPECT_EQ(context.count + own.count, all.count) << input << " " << node.value();
            EXPECT_NEAR(context.area + own.area, all.area, 1e-5 * all.area) << input << " " << node.value();
        }
    }
}

// The list of the worst cells grows with the run.
TEST(Runs, TheWorstCellsAreThoseOfAllParts) {
    const TemporaryFolder folder;
    const std::string output = folder.file("run");
    StartedRun run(test::kerf_program(), {"mesh", asset_path("cube"), "-q", "-o", output, "-n", "4", "--workers", "1",
                                          "--max-volume", "8e-6"});
    ASSERT_TRUE(await([&] { return finished_parts(output) >= 1; }));
    ASSERT_EQ(::kill(run.process(), SIGSTOP), 0);
    Driver driver;
    driver.open(output);
    driver.state().coloring.by = ColorBy::shape;
    driver.state().panels.quality = true;
    driver.await("the first list", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    EXPECT_TRUE(driver.document().progress.running);
    const auto parts_listed = [&] {
        std::set<NodeId> parts;
        for (const WorstCell& cell : *driver.app().session().fetched().worst_cells(ColorBy::shape, 100))
            parts.insert(cell.part);
        return parts;
    };
    const std::set<NodeId> before = parts_listed();
    ::kill(run.process(), SIGCONT);
    driver.await("the end of the run", [&] { return !driver.document().progress.running; });
    EXPECT_EQ(run.wait().exit_code, 0);
    driver.settle();
    driver.await("the list of all", [&] { return !driver.app().session().pending(); });
    EXPECT_LT(before.size(), 4u);
    EXPECT_GT(parts_listed().size(), before.size());
    const MeasureHistogram& histogram = *driver.document().histograms[4];
    EXPECT_NEAR(driver.app().session().fetched().worst_cells(ColorBy::shape, 100)->front().value, histogram.min, 1e-6);
}

// A row is marked as long as its cell is selected.
TEST(Runs, ARowOfTheWorstCellsIsMarkedWithItsCell) {
    Driver::Options options;
    options.parts = 2;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().coloring.by = ColorBy::min_dihedral;
    driver.state().step = {Stage::tetrahedra, -1};
    driver.click("Worst cells");
    driver.await("the list", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    // Beside the text of the number; every second row has the same ground.
    const auto is_marked = [&] {
        driver.move_to(10, 300);
        const Image picture = driver.picture();
        const auto color = [&](const char* label) {
            const ItemRect row = *driver.app().widgets().find(label);
            const auto x = static_cast<std::size_t>(row.right - 2), y = static_cast<std::size_t>(row.top + 3);
            const std::size_t at = 3 * (y * static_cast<std::size_t>(picture.width) + x);
            return std::array{picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
        };
        return color("worst 1") != color("worst 3");
    };
    driver.click("worst 1");
    EXPECT_TRUE(is_marked());
    driver.click("Clear");
    EXPECT_FALSE(is_marked());
}

// A straight cut that is made again has the interface that a run gives it, and its angles.
TEST(Runs, AStraightCutMadeAgainIsThatOfARun) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_kerf({"mesh", asset_path("cylinder"), "-q", "-n", "2", "--contour", "straight", "-o",
                        folder.file("run"), "--trace", folder.file("trace")})
                  .exit_code,
              0);
    Driver driver;
    driver.open(folder.file("run"));
    ASSERT_TRUE(driver.document().trace);
    const CutSummary of_run = *driver.document().tree.find(root_node)->cut;
    ASSERT_EQ(of_run.strategy, CutStrategy::straight);
    ASSERT_LT(of_run.quality.angle_deg, 60);
    driver.state().panels.parameters = true;
    driver.frame();
    driver.click("Re-run cut of node 1");
    driver.await("the cut", [&] { return !driver.app().session().busy(); });
    const CutSummary again = *driver.document().tree.find(root_node)->cut;
    EXPECT_EQ(again.strategy, CutStrategy::straight);
    EXPECT_EQ(again.interface_faces, of_run.interface_faces);
    EXPECT_NEAR(again.quality.angle_deg, of_run.quality.angle_deg, 1e-9);
    EXPECT_NEAR(again.quality.dihedral_deg, of_run.quality.dihedral_deg, 1e-9);
    // Its halves are closed, and can be cut straight, too, although facets have pieces now.
    driver.state().node = NodeId(3);
    driver.settle();
    EXPECT_EQ(driver.document().tree.parts_below(root_node), (std::vector<NodeId>{NodeId(2), NodeId(3)}));
}

// The run before stays, with its cells, and is shown again under the same camera, however the other one came to be.
TEST(Runs, TwoAreComparedUnderOneCamera) {
    Driver::Options options;
    options.parts = 3;
    Driver driver(options);
    driver.open(asset_path("hollow_box"));
    Session& session = driver.app().session();
    ViewState& state = driver.state();
    state.panels.parameters = true;
    state.step = {Stage::tetrahedra, -1};
    const Image first = driver.picture();
    EXPECT_FALSE(driver.app().widgets().find("A"));
    driver.click("parts");
    driver.key(key_of('A'), true);
    driver.type("5");
    driver.key(key_enter);
    driver.click("Run all");
    driver.await("five parts",
                 [&] { return driver.document().tree.parts_below(root_node).size() == 5 && !session.busy(); });
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::part).triangles > 0, true);
    const Camera camera = driver.app().camera();
    const auto second_triangles = driver.drawn(LayerKind::part).triangles;
    driver.click("A");
    EXPECT_TRUE(session.shows_before());
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 3u);
    EXPECT_EQ(session.other_document()->tree.parts_below(root_node).size(), 5u);
    EXPECT_EQ(driver.app().camera(), camera);
    driver.settle();
    EXPECT_LT(driver.drawn(LayerKind::part).triangles, second_triangles) << "fewer interfaces";
    EXPECT_TRUE(session.failures().empty());
    for (const Document* document : {&driver.document(), session.other_document()}) {
        EXPECT_GE(document->cut_seconds, 0);
        EXPECT_GE(document->mesh_seconds, 0);
        EXPECT_GT(document->histograms[0]->p1, document->histograms[0]->min);
        EXPECT_LT(document->histograms[0]->p1, document->histograms[0]->median);
    }
    driver.key(key_of('B'));
    EXPECT_FALSE(session.shows_before());
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::part).triangles, second_triangles);

    // A cut made again takes the place of the later run, and what it was made of can be seen with all its cells.
    driver.click("Re-run cut of node 1");
    driver.await("the cut",
                 [&] { return driver.document().tree.parts_below(root_node).size() == 2 && !session.busy(); });
    EXPECT_FALSE(driver.document().histograms[0]) << "of cells that are gone";
    EXPECT_FALSE(session.pair().can_save()) << "no run has made this";
    driver.click("A");
    driver.settle();
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 5u);
    EXPECT_EQ(driver.drawn(LayerKind::part).triangles, second_triangles);
    EXPECT_TRUE(driver.document().histograms[0]);
}

// A temporary run is copied to where the user wants it, and is a run like any other; nobody's files are replaced.
TEST(Runs, ATemporaryRunIsSaved) {
    const TemporaryFolder folder;
    const std::string place = folder.file("kept");
    {
        Driver driver;
        driver.open(asset_path("cube"));
        Session& session = driver.app().session();
        driver.state().panels.parameters = true;
        driver.frame();
        const auto save_to = [&](const std::string& path) {
            session.pair().save(path);
            driver.await("the copy", [&] { return !session.busy(); });
        };
        fs::create_directory(folder.file("mine"));
        std::ofstream(folder.file("mine/letter.txt")) << "mine";
        save_to(folder.file("mine"));
        ASSERT_EQ(session.failures().size(), 1u);
        EXPECT_NE(session.failures()[0].find("letter.txt"), std::string::npos) << session.failures()[0];
        EXPECT_EQ(bytes_of_file(folder.file("mine/letter.txt")), "mine");
        std::ofstream(place + ".trace") << "mine";
        save_to(place);
        ASSERT_EQ(session.failures().size(), 1u) << "the other one is no more of interest";
        EXPECT_NE(session.failures()[0].find("kept.trace"), std::string::npos) << session.failures()[0];
        EXPECT_FALSE(fs::exists(place));
        fs::remove(place + ".trace");
        driver.click("Save run...");
        driver.click("Folder");
        driver.key(key_of('A'), true);
        driver.type(place);
        driver.click("Save");
        driver.await("the copy", [&] { return !session.busy(); });
        EXPECT_TRUE(session.failures().empty());
        EXPECT_EQ(driver.document().saved_as, place);
        EXPECT_FALSE(session.pair().can_save());
    }
    EXPECT_EQ(run_kerf({"verify", place}).exit_code, 0);
    Driver driver;
    driver.open(place);
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 4u);
    EXPECT_TRUE(driver.document().trace) << "with every step of its cuts";
}

// What went wrong before is not what is said of what went well.
TEST(Runs, AnOldErrorLeavesTheStatusBar) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.screenshot_folder = folder.file("missing");
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    Session& session = driver.app().session();
    session.pair().redo_cut(root_node, {});
    ASSERT_EQ(session.failures().size(), 1u);
    RunRequest run;
    run.parts = 2;
    session.start_run(run, false);
    driver.await("the run", [&] { return !session.busy(); });
    EXPECT_TRUE(session.failures().empty());

    // A picture that could not be saved is an error, with a way out; the next one that is takes it away.
    driver.key(key_f12);
    driver.settle();
    EXPECT_TRUE(driver.app().facts().notice_is_error);
    EXPECT_NE(driver.app().facts().notice.find("not saved"), std::string::npos);
    EXPECT_NE(driver.app().facts().notice.find("Start the viewer in"), std::string::npos);
    EXPECT_NE(driver.app().facts().notice.find("kerf-001.png"), std::string::npos);
    driver.frame(100);
    EXPECT_TRUE(driver.app().facts().notice_is_error) << "nobody has read it";
    fs::create_directory(folder.file("missing"));
    driver.key(key_f12);
    driver.settle();
    EXPECT_FALSE(driver.app().facts().notice_is_error);
    EXPECT_TRUE(fs::exists(folder.file("missing/kerf-001.png")));
}

// One that is chosen in the menu is.
TEST(Runs, TheThemeOfOneStartIsNotThatOfTheNext) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.config_folder = folder.file("config");
    {
        Driver driver(options);
        driver.state().theme = Theme::dark;  // as --theme does
        driver.settle();
    }
    EXPECT_EQ(Driver(options).state().theme, Theme::light);
}

// A picture that is asked for before what it is to show is there waits for it.
TEST(Runs, APictureAskedForAtOnceIsThatOfLater) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.screenshot_folder = folder.file("");
    Driver driver(options);
    driver.open(asset_path("bearing_cap_52k"));
    driver.state().step = {Stage::tetrahedra, -1};
    driver.app().press({.key = key_f12});
    driver.frame();
    driver.settle();
    driver.key(key_f12);
    driver.settle();
    EXPECT_TRUE(bytes_of_file(folder.file("kerf-001.png")) == bytes_of_file(folder.file("kerf-002.png")));
}

// The JSON beside a picture says of what and how large it was, so that the command needs nothing else.
TEST(Runs, AViewKnowsWhatItWasMadeOf) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.width = 640;
    options.height = 480;
    options.parts = 3;
    options.volume = false;
    options.screenshot_folder = folder.file("");
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.key(key_of('3'));
    driver.state().node = NodeId(3);
    driver.key(key_f12);
    driver.settle();
    const std::string state = folder.file("kerf-001.json");
    const auto parse = [&](std::vector<const char*> arguments) {
        arguments.insert(arguments.begin(), "kerf");
        return parse_view_command(static_cast<int>(arguments.size()), arguments.data());
    };
    const ViewCommand same = parse({"screenshot", "--state", state.c_str(), "-o", "a.png"});
    EXPECT_EQ(same.print, "");
    EXPECT_EQ(same.input, asset_path("cube"));
    EXPECT_EQ(same.picture.width, 640);
    EXPECT_EQ(same.picture.height, 480);
    EXPECT_EQ(same.run.parts, 3);
    const ViewCommand other =
        parse({"screenshot", "other.stl", "--state", state.c_str(), "--resolution", "800x600", "-o", "a.png"});
    EXPECT_EQ(other.input, "other.stl");
    EXPECT_EQ(other.picture.width, 800);
    EXPECT_EQ(parse({"screenshot", "-o", "a.png"}).exit_code, 2);
    EXPECT_TRUE(parse({"view", "a.stl"}).auto_run);
    EXPECT_FALSE(parse({"view", "a.stl", "--no-run"}).auto_run);

    // Bit for bit, and of another body in its middle.
    const std::string again = folder.file("again.png");
    ASSERT_EQ(run_kerf({"screenshot", "--state", state, "-o", again}).exit_code, 0);
    EXPECT_TRUE(bytes_of_file(again) == bytes_of_file(folder.file("kerf-001.png")));
    ASSERT_EQ(run_kerf({"screenshot", asset_path("bearing_cap_52k"), "--state", state, "-o", again}).exit_code, 0);
    const Image picture = read_png(again);
    const auto at = [&](int x, int y) {
        const std::uint8_t* p = picture.pixel(x, y);
        return std::array{p[0], p[1], p[2]};
    };
    EXPECT_NE(at(320, 240), at(5, 240)) << "the body is where one looks";
}

}  // namespace
}  // namespace kerf::test
