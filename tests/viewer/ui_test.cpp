// The user interface as a user works with it: clicks by label, keys, drags, drops. Every step is checked on the state
// and on what is drawn.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <imgui.h>

#include "base/core/words.h"
#include "files/io/surface_reader.h"
#include "run/request/run_request.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

using namespace view;

// The share of the picture that has changed.
double changed(const Image& a, const Image& b) { return compare(a, b).differing; }

// The whole session of a user, one after the other.
TEST(Ui, ASession) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.config_folder = folder.file("config");
    options.screenshot_folder = folder.file("");
    Driver driver(options);
    ViewState& state = driver.state();
    const Image empty = driver.picture();

    // Opens a model by dropping it; it is cut and meshed.
    driver.drop(asset_path("hollow_box"));
    driver.await("the run", [&] {
        return driver.document().tree.parts_below(root_node).size() == 4 && !driver.app().session().busy();
    });
    const Image opened = driver.picture();
    EXPECT_GT(changed(empty, opened), 0.1) << "the body, and the tree beside it";
    // The end of the run goes to the cells and says what came; axes explain the plane of a cut, or come on demand.
    EXPECT_EQ(state.step.stage, Stage::tetrahedra);
    EXPECT_GT(driver.drawn(LayerKind::part).triangles, 0);
    EXPECT_NE(driver.app().facts().notice.find("deg, verified, "), std::string::npos);
    driver.click("step input");
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::surface).triangles, 3786);
    EXPECT_EQ(driver.drawn(LayerKind::axes).segments, 0);
    driver.click("Axes");
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::axes).segments, 3);
    state.look.axes = {};
    driver.click("step plane");
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::axes).segments, 3);

    // Node 3, smoothed contour, by the tree and the timeline.
    driver.click("node 3");
    EXPECT_EQ(state.node, NodeId(3));
    driver.click("step contour");
    EXPECT_EQ(name(state.step), "contour");
    const Image contour = driver.picture();
    EXPECT_GT(changed(opened, contour), 0.05) << "a node instead of the whole, behind glass";
    const Cut* cut = driver.document().trace->find(NodeId(3));
    ASSERT_TRUE(cut);
    EXPECT_EQ(driver.drawn(LayerKind::contour).segments, cut->contour_edges);
    EXPECT_GT(driver.drawn(LayerKind::context).triangles, 0);

    // The same by keys; nothing is made twice.
    driver.key(key_left);
    EXPECT_EQ(name(state.step), "paths-removed");
    driver.settle();
    const std::int64_t made = driver.app().geometry_made();
    driver.key(key_right);
    EXPECT_EQ(name(state.step), "contour");
    EXPECT_EQ(changed(contour, driver.picture()), 0) << "the same step";
    EXPECT_EQ(driver.app().geometry_made(), made);
    driver.key(key_up);
    EXPECT_EQ(state.node, NodeId(5)) << "before 3 in the tree";
    driver.key(key_down);
    EXPECT_EQ(state.node, NodeId(3));

    // Clips.
    driver.click("node 1");
    driver.click("step tetrahedra");
    const Image tetrahedra = driver.picture();
    driver.click("Clip plane");
    EXPECT_TRUE(state.clip.on);
    const Image clipped = driver.picture();
    EXPECT_GT(changed(tetrahedra, clipped), 0.05) << "half of the body is gone";
    EXPECT_GT(driver.drawn(LayerKind::cells).triangles, 0);
    driver.click("Snap to cut of node 1");
    const TreeRow& root = *driver.document().tree.find(root_node);
    EXPECT_LT((state.clip.normal - root.plane()->normal).norm(), 1e-12);
    const Image snapped = driver.picture();
    EXPECT_GT(changed(clipped, snapped), 0.005) << "another half, seen from the same side";

    // Explodes, by dragging the slider.
    const ItemRect slider = *driver.app().widgets().find("Explode");
    const float y = (slider.top + slider.bottom) / 2;
    driver.drag(slider.left + 8, y, (slider.left + slider.right) / 2, y);
    EXPECT_GT(state.explosion.amount, 0.2);
    EXPECT_LT(state.explosion.amount, 0.8);
    const Image exploded = driver.picture();
    EXPECT_GT(changed(snapped, exploded), 0.05) << "parts are elsewhere";

    // Picks a cell; its numbers go to the clipboard.
    driver.click("Cell");
    EXPECT_EQ(state.pick, PickMode::cell);
    const Rectangle scene = driver.app().scene_area();
    const auto pick_somewhere = [&] {
        for (int i = 1; i < 16 && state.selection.kind == Selection::Kind::none; ++i)
            driver.click_at(scene.x + scene.width * static_cast<float>(i) / 16, scene.y + scene.height * 0.5f);
    };
    pick_somewhere();
    ASSERT_EQ(state.selection.kind, Selection::Kind::cell);
    driver.settle();
    EXPECT_NE(driver.app().facts().selection.find("cell " + std::to_string(state.selection.index)), std::string::npos);
    EXPECT_EQ(driver.drawn(LayerKind::selection).segments, 6);
    driver.click("Copy");
    EXPECT_EQ(ImGui::GetClipboardText(), driver.app().facts().selection);
    EXPECT_GT(changed(exploded, driver.picture()), 0.002) << "the outlined cell, and what is said of it";
    driver.key(key_escape);
    EXPECT_EQ(state.selection.kind, Selection::Kind::none);

    // A picture.
    driver.key(key_f12);
    driver.settle();
    const Image saved = read_png(folder.file("kerf-001.png"));
    EXPECT_EQ(saved.width, options.width);
    const ViewState read = state_from_json(bytes_of_file(folder.file("kerf-001.json")), "kerf-001.json");
    EXPECT_EQ(read.node, state.node);
    EXPECT_EQ(read.explosion.amount, state.explosion.amount);
    ASSERT_TRUE(read.camera);
    // The body fits into a picture without panels, which has another shape.
    EXPECT_LT((read.camera->target - driver.app().camera().target).norm(),
              0.01 * driver.document().box.diagonal().norm());
}

// What the histogram is brushed over is what is shown, and a click on a bad cell goes there.
TEST(Ui, ShowsSomeCellsAndTheWorst) {
    Driver::Options options;
    options.parts = 2;
    Driver driver(options);
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.coloring.by = ColorBy::min_dihedral;
    driver.click("Worst cells");
    ASSERT_TRUE(driver.document().histograms[0]);
    const MeasureHistogram& histogram = *driver.document().histograms[0];

    // From the first bin that is not empty to the middle of all that are not.
    const auto is_used = [](std::int64_t count) { return count > 0; };
    const auto first = std::find_if(histogram.all.begin(), histogram.all.end(), is_used) - histogram.all.begin();
    const auto last = histogram.all.rend() - std::find_if(histogram.all.rbegin(), histogram.all.rend(), is_used);
    const auto bins = static_cast<float>(last - first), middle = std::floor(bins / 2);
    driver.drag_over("histogram", 0.5f / bins, (middle + 0.5f) / bins);
    ASSERT_TRUE(state.coloring.filter);
    EXPECT_EQ(state.coloring.filter->low, histogram.edges[static_cast<std::size_t>(first)]);
    EXPECT_EQ(state.coloring.filter->high,
              histogram.edges[static_cast<std::size_t>(first) + static_cast<std::size_t>(middle) + 1]);
    driver.settle();
    EXPECT_GT(driver.drawn(LayerKind::cells).triangles, 0);
    driver.click("Clear filter");
    EXPECT_FALSE(state.coloring.filter);

    driver.await("the worst cells", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    const WorstCell worst = driver.app().session().fetched().worst_cells(state.coloring.by, 100)->front();
    EXPECT_NEAR(worst.value, histogram.min, 1e-4 * histogram.min);
    const double height = driver.app().camera().height;
    driver.click("worst 1");
    EXPECT_EQ(state.selection, (Selection{Selection::Kind::cell, worst.part, worst.cell, worst.center}));
    EXPECT_EQ(driver.app().camera().target, worst.center);
    EXPECT_LT(driver.app().camera().height, height / 4);
}

TEST(Ui, HidesAndIsolatesFromTheTree) {
    Driver::Options options;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    ViewState& state = driver.state();
    state.step = {Stage::split, -1};
    const auto drawn_halves = [&] {
        driver.settle();
        return std::pair(driver.drawn(LayerKind::half, NodeId(2)).triangles,
                         driver.drawn(LayerKind::half, NodeId(3)).triangles);
    };
    const std::int64_t below = driver.document().tree.find(NodeId(2))->facets,
                       above = driver.document().tree.find(NodeId(3))->facets;
    EXPECT_EQ(drawn_halves(), std::pair(below, above));
    driver.click("isolate 3");
    EXPECT_EQ(state.visibility.isolated, NodeId(3));
    EXPECT_EQ(drawn_halves(), std::pair(std::int64_t{0}, above));
    driver.click("isolate 3");
    EXPECT_FALSE(state.visibility.isolated);
    driver.click("show 3");
    EXPECT_EQ(state.visibility.hidden, std::vector<NodeId>{NodeId(3)});
    EXPECT_EQ(drawn_halves(), std::pair(below, std::int64_t{0}));
    driver.click("isolate 2");
    driver.click("Show all");
    EXPECT_TRUE(state.visibility.hidden.empty() && !state.visibility.isolated);
    EXPECT_EQ(drawn_halves(), std::pair(below, above));
}

TEST(Ui, LooksFromTheEndsOfTheGizmo) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    for (const auto& [label, back] : {std::pair("view x", Vec3(1, 0, 0)), std::pair("view -x", Vec3(-1, 0, 0)),
                                      std::pair("view y", Vec3(0, 1, 0)), std::pair("view -y", Vec3(0, -1, 0)),
                                      std::pair("view z", Vec3(0, 0, 1)), std::pair("view -z", Vec3(0, 0, -1))}) {
        driver.key(key_home);  // where no end hides another
        driver.click(label);
        EXPECT_LT((driver.app().camera().back() - back).norm(), 1e-9) << label;
    }
}

// One table of words: the title over the scene and beside the steps, the button, the legend, and the command line.
TEST(Ui, AStageIsCalledTheSameEverywhere) {
    Driver::Options options;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    std::set<std::string> in_legends;
    const std::vector<Step> steps = driver.app().steps();  // which the app makes anew
    for (const Step& step : steps) {
        driver.state().step = step;
        driver.settle();
        const std::vector<std::string> words = words_on_screen();
        const auto times = [&](const std::string& text) { return std::count(words.begin(), words.end(), text); };
        const bool is_of_cut = step.stage >= Stage::plane && step.stage < Stage::split;
        EXPECT_EQ(times("Cut of the whole body: " + in_words(name(step))), is_of_cut ? 1 : 0);
        EXPECT_EQ(times("Node 1: " + title(step)), 1);
        EXPECT_GE(times(title(step)), 1) << "the button";
        EXPECT_EQ(step_from_name(name(step)), step);
        EXPECT_EQ(in_words(name(step)),
                  std::string(1, static_cast<char>(std::tolower(title(step)[0]))) + title(step).substr(1));
        if (times(in_words(name(step))) == 1) in_legends.insert(name(step));
    }
    EXPECT_EQ(in_legends,
              (std::set<std::string>{"plane", "crossed-edges", "hanging-removed", "closed-loops", "paths-removed",
                                     "contour", "projected", "triangulation", "interface"}));
}

TEST(Ui, MouseMovesTheCamera) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    const Rectangle scene = driver.app().scene_area();
    const float x = scene.x + scene.width / 2, y = scene.y + scene.height / 2;
    const Camera start = driver.app().camera();

    driver.drag(x, y, x + 100, y);
    const Camera turned = driver.app().camera();
    EXPECT_GT((turned.back() - start.back()).norm(), 0.1);
    EXPECT_EQ(turned.target, start.target);

    driver.drag(x, y, x + 60, y, 2);
    const Camera panned = driver.app().camera();
    EXPECT_EQ(panned.back(), turned.back());
    EXPECT_GT((panned.target - turned.target).norm(), 0.01);

    // What was panned before is no drag now.
    driver.click_at(x, y);
    EXPECT_EQ(driver.state().selection.kind, Selection::Kind::facet);

    // The eye comes closer to the surface, but never goes through it.
    for (int i = 0; i < 60; ++i) driver.wheel(x, y, 1);
    EXPECT_LT(driver.app().camera().height, panned.height / 100);
    EXPECT_GT(driver.drawn(LayerKind::surface).triangles, 0);
    driver.state().selection = {};
    driver.click_at(x, y);
    EXPECT_EQ(driver.state().selection.kind, Selection::Kind::facet) << "still before the surface";
    driver.key(key_home);

    driver.key(key_of('7'));
    EXPECT_LT((driver.app().camera().back() - Vec3::UnitZ()).norm(), 1e-9);
    driver.key(key_of('5'));
    EXPECT_FALSE(driver.app().camera().perspective);
    driver.key(key_home);
    EXPECT_EQ(driver.app().camera().target, start.target);
    EXPECT_EQ(driver.app().camera().height, start.height);
    EXPECT_FALSE(driver.state().camera);
}

// Pixel by pixel the id buffer names the facet that a ray from the eye meets first.
TEST(Ui, PicksTheFacetThatIsSeen) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cylinder"));
    const auto surface = driver.app().session().fetched().surface(root_node);
    ASSERT_TRUE(surface);
    const Rectangle scene = driver.app().scene_area(), body = body_area(driver.state(), scene);
    const Camera camera = driver.app().camera();
    const Vec3 eye = camera.target + camera.distance() * camera.back();
    int picked = 0;
    for (int i = 1; i < 12; ++i)
        for (int j = 1; j < 12; ++j) {
            const float x = std::floor(scene.x + scene.width * static_cast<float>(i) / 12);
            const float y = std::floor(scene.y + scene.height * static_cast<float>(j) / 12);
            driver.state().selection = {};
            driver.click_at(x, y);
            const Selection& s = driver.state().selection;
            // The ray through the pixel's centre.
            const double px = (x + 0.5 - body.x - body.width / 2) / scene.height;
            const double py = -(y + 0.5 - body.y - body.height / 2) / scene.height;
            const Vec3 to = camera.target + camera.height * (px * camera.right() + py * camera.up());
            const Vec3 ray = to - eye;
            double nearest = 1e300;
            std::int32_t expected = -1;
            for (std::size_t f = 0; f < surface->facets.size(); ++f) {
                const Triangle& t = surface->facets[f];
                const Vec3& a = surface->vertices[static_cast<std::size_t>(t[0])];
                Eigen::Matrix3d m;
                m << surface->vertices[static_cast<std::size_t>(t[1])] - a,
                    surface->vertices[static_cast<std::size_t>(t[2])] - a, -ray;
                const Vec3 q = m.inverse() * (eye - a);
                if (q.x() >= 0 && q.y() >= 0 && q.x() + q.y() <= 1 && q.z() > 0 && q.z() < nearest) {
                    nearest = q.z();
                    expected = static_cast<std::int32_t>(f);
                }
            }
            EXPECT_EQ(s.kind == Selection::Kind::facet ? s.index : -1, expected) << x << ", " << y;
            picked += expected >= 0;
        }
    EXPECT_GT(picked, 10);
}

// Whatever the help of kerf mesh has, but files that a run writes besides its result.
TEST(Ui, HasEveryOptionUnderTheHeadingsOfTheHelp) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().panels.display = false;
    driver.state().panels.parameters = true;
    driver.settle();
    RunRequest run;
    const auto expect_options_of = [&](const std::string& heading) {
        for (const OptionField& field : option_fields(run)) {
            if (field.group != heading) continue;
            const bool is_file = field.name == "report" || field.name == "events" || field.name == "trace";
            EXPECT_EQ(driver.app().widgets().find(field.name).has_value(), !is_file) << field.name;
        }
    };
    for (const char* heading : {option_group::cuts, option_group::sizes}) {
        expect_options_of(heading);
        driver.click(heading);
    }
    for (const char* heading : option_group::all) {
        EXPECT_FALSE(driver.app().widgets().find("parts") || driver.app().widgets().find("attempts")) << heading;
        driver.click(heading);
        expect_options_of(heading);
        driver.click(heading);
    }
}

// Lengths and counts are written as on the command line; what is no number stays in sight, with the reason, and no run
// starts.
TEST(Ui, ReadsNumbersAsTheCommandLineDoes) {
    Driver::Options options;
    options.auto_run = false;
    options.volume = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().panels.parameters = true;
    driver.frame();
    const auto put = [&](const std::string& field, const std::string& text) {
        driver.click(field);
        driver.key(key_of('A'), true);
        driver.type(text);
        driver.key(key_enter);
    };
    put("cells", "5k");
    EXPECT_TRUE(driver.offers("Only cut"));
    put("cells", "0");
    put("size", "30%");
    put("parts", "2x");
    EXPECT_FALSE(driver.offers("Only cut"));
    put("parts", "2");
    driver.click("Only cut");
    driver.await("the run", [&] { return driver.document().trace && !driver.app().session().busy(); });
    EXPECT_EQ(driver.document().options.sizes.size.text(), "30%");
    EXPECT_EQ(driver.document().options.parts, 2);
}

TEST(Ui, ChangesOptionsRunsAgainAndCompares) {
    Driver driver;
    driver.open(asset_path("cylinder"));
    EXPECT_EQ(driver.document().tree.parts_below(root_node).size(), 4u);
    driver.state().panels.parameters = true;
    driver.frame();
    driver.click("parts");
    driver.key(key_of('A'), true);
    driver.type("6");
    driver.key(key_enter);
    driver.app().state().camera = driver.app().camera();
    driver.click("Run all");
    driver.await("six parts", [&] {
        return driver.document().tree.parts_below(root_node).size() == 6 && !driver.app().session().busy();
    });
    ASSERT_TRUE(driver.app().session().other_document());
    EXPECT_EQ(driver.app().session().other_document()->tree.parts_below(root_node).size(), 4u);
    driver.settle();
    EXPECT_FALSE(driver.state().camera) << "nobody has moved it since the run began: the body fits again";
}

// The button of a problem does what its text says, and then both surfaces can be seen.
TEST(Ui, RemeshesTheSurfaceAndShowsBoth) {
    const TemporaryFolder folder;
    const Soup prism = test::prism(24, 1, 4);
    std::ofstream(folder.file("prism.stl")) << to_ascii_stl(prism);
    Driver::Options options;
    options.parts = 2;
    options.volume = false;
    options.remeshing = Remeshing::never;
    Driver driver(options);
    driver.open(folder.file("prism.stl"));
    EXPECT_NE(driver.app().steps().front().stage, Stage::before_remeshing);
    driver.click("Problems");
    driver.click("Remesh the surface");
    driver.await("the remeshed surface", [&] { return driver.document().remeshed && !driver.app().session().busy(); });
    EXPECT_EQ(driver.document().options.remeshing, Remeshing::always);
    EXPECT_TRUE(driver.document().notes.empty());
    driver.settle();
    EXPECT_GT(driver.drawn(LayerKind::surface).triangles, 2 * std::ssize(prism.facets));
    driver.click("step before-remeshing");
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::file_surface).triangles, std::ssize(prism.facets));
    EXPECT_EQ(driver.drawn(LayerKind::surface).triangles, 0);
    driver.click("Features");
    driver.settle();
    EXPECT_EQ(driver.drawn(LayerKind::features).segments, 2 * 24);
    driver.state().coloring.by = ColorBy::deviation;
    driver.settle();
    ASSERT_TRUE(driver.app().facts().legend.values);
    EXPECT_EQ(driver.app().facts().legend.title, title(ColorBy::deviation));
    EXPECT_EQ(driver.app().facts().legend.values->low, 0);
    const Rectangle scene = driver.app().scene_area();
    driver.click_at(scene.x + scene.width / 2, scene.y + scene.height / 2);
    driver.settle();
    EXPECT_NE(driver.app().facts().selection.find("the surface before remeshing"), std::string::npos);
}

TEST(Ui, CancelsARun) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("bearing_cap_52k"));
    RunRequest run;
    run.input = asset_path("bearing_cap_52k");
    run.parts = 8;
    run.sizes.size = 0.5;
    driver.app().session().start_run(run, true);
    driver.await("parts", [&] { return driver.document().progress.running && driver.document().progress.parts > 0; });
    driver.click("Cancel");
    driver.await("the end", [&] { return !driver.document().progress.running && !driver.app().session().busy(); });
    EXPECT_NE(driver.document().progress.message.find("cancel"), std::string::npos)
        << driver.document().progress.message;
    driver.settle();
    EXPECT_GT(driver.drawn(LayerKind::surface).triangles, 0) << "the surface is still there";
}

TEST(Ui, PlaysThroughTheSteps) {
    Driver driver;
    driver.open(asset_path("cube"));
    driver.key(key_space);
    EXPECT_TRUE(driver.app().facts().playing);
    std::set<std::string> seen;
    for (int i = 0; i < 500 && driver.app().facts().playing; ++i) {
        driver.frame(0.9f);
        seen.insert(std::to_string(driver.state().node.value()) + " " + name(driver.state().step));
    }
    EXPECT_FALSE(driver.app().facts().playing) << "it comes to an end";
    EXPECT_TRUE(seen.contains("1 contour") && seen.contains("3 triangulation") && seen.contains("7 tetrahedra"));
}

TEST(Ui, AClickOnAProblemFliesThere) {
    const TemporaryFolder folder;
    Soup soup = read_surface(asset_path("cube"));
    soup.facets.erase(soup.facets.begin() + 100);
    write_off(folder.file("open.off"), soup.vertices, soup.facets);
    Driver driver;
    driver.open(folder.file("open.off"));
    ASSERT_TRUE(driver.document().has_problems());
    const double height = driver.app().camera().height;
    driver.click("defect 1");
    EXPECT_LT(driver.app().camera().height, height / 2);
    EXPECT_LT((driver.app().camera().target - driver.document().checked->diagnosis.defects[0].where).norm(), 1e-9);
    EXPECT_FALSE(driver.document().trace) << "nothing was run";
}

TEST(Ui, AFileThatIsNoSurfaceSaysSo) {
    const TemporaryFolder folder;
    Driver driver;
    for (const char* text : {"", "hello", "solid x\nfacet normal 0 0"}) {
        std::ofstream(folder.file("bad.stl")) << text;
        driver.open(folder.file("bad.stl"));
        EXPECT_NE(driver.document().error, "") << text;
        EXPECT_FALSE(driver.picture().rgb.empty());
    }
    driver.open(folder.file("missing.stl"));
    EXPECT_NE(driver.document().error.find("missing.stl"), std::string::npos);
    EXPECT_TRUE(driver.app().settings().recent.empty()) << "only what could be opened is offered again";
}

void browse(Driver& driver, const std::string& folder) {
    driver.key(key_of('O'), true);
    driver.click("folder path");
    driver.key(key_of('A'), true);
    driver.type(folder);
    driver.key(key_enter);
}

TEST(Ui, OpensAFileFromTheBrowser) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(asset_path("cube"), folder.file("cube.stl"));
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    browse(driver, folder.file(""));
    driver.click("entry cube.stl");
    driver.click("Open");
    driver.await("the cube", [&] { return driver.document().input_facets == 4660; });
    EXPECT_EQ(driver.document().title, "cube.stl");
}

TEST(Ui, ListsWhatItCanOpen) {
    const TemporaryFolder folder;
    for (const char* name : {"a.stl.gz", "a.STEP", "a.igs", "a.brep", "a.kerftrace", "letter.txt"})
        std::ofstream(folder.file(name)) << "-";
    std::filesystem::create_directories(folder.file("solved/solution"));
    std::ofstream(folder.file("solved/solution/report.json")) << "{}";
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    browse(driver, folder.file(""));
    driver.settle();
    for (const char* name : {"a.stl.gz", "a.STEP", "a.igs", "a.brep", "a.kerftrace", "solved"})
        EXPECT_TRUE(driver.app().widgets().find(std::string("entry ") + name)) << name;
    EXPECT_FALSE(driver.app().widgets().find("entry letter.txt"));
    EXPECT_FALSE(driver.offers("Open this folder")) << "it is no run";
    EXPECT_FALSE(driver.offers("Open"));
    driver.click("folder path");
    driver.key(key_of('A'), true);
    driver.type(folder.file("a.stl.gz"));
    EXPECT_TRUE(driver.offers("Open")) << "what is typed is there";
    driver.click("entry solved");
    driver.click("Open");
    driver.await("what is wrong with it: it was opened, not entered", [&] { return !driver.document().error.empty(); });
}

TEST(Ui, RemembersThemeAndRecentFiles) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.auto_run = false;
    options.config_folder = folder.file("config");
    {
        Driver driver(options);
        driver.open(asset_path("cube"));
        driver.click("View");
        driver.click("Dark theme");
    }
    Driver driver(options);
    EXPECT_EQ(driver.state().theme, Theme::dark);
    ASSERT_FALSE(driver.app().settings().recent.empty());
    EXPECT_TRUE(driver.app().settings().recent.front().path.ends_with("cube.stl"));
}

}  // namespace
}  // namespace kerf::test
