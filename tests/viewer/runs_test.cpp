// Runs as a user has them: opened without a trace, under way, made again, compared, saved; and views that are saved.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <imgui.h>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

namespace fs = std::filesystem;
using namespace view;

std::int64_t outer_facets(Driver& driver, NodeId node) {
    std::shared_ptr<const NodeSurface> surface;
    driver.await("a surface", [&] { return (surface = driver.app().session().surface(node)) != nullptr; });
    return std::count(surface->interface_of.begin(), surface->interface_of.end(), 0);
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
        const std::int64_t all = outer_facets(driver, 1);
        for (const NodeId node : {3, 4, 6}) {
            driver.state().node = node;
            driver.settle();
            EXPECT_GT(driver.drawn("context").triangles, 0);
            EXPECT_EQ(driver.drawn("context").triangles + outer_facets(driver, node), all) << input << " " << node;
        }
    }
}

// The list of the worst cells grows with the run.
TEST(Runs, TheWorstCellsAreThoseOfAllParts) {
    const TemporaryFolder folder;
    const std::string output = folder.file("run");
    StartedRun run(KERF_PROGRAM, {"mesh", asset_path("cube"), "-q", "-o", output, "-n", "4", "--workers", "1",
                                  "--max-volume", "8e-6"});
    ASSERT_TRUE(await([&] { return finished_parts(output) >= 1; }));
    ASSERT_EQ(::kill(run.process(), SIGSTOP), 0);
    Driver driver;
    driver.open(output);
    driver.state().color = ColorBy::shape;
    driver.state().panels.quality = true;
    driver.await("the first list", [&] { return driver.app().widgets().find("worst 1").has_value(); });
    EXPECT_TRUE(driver.document().progress.running);
    const auto parts_listed = [&] {
        std::set<NodeId> parts;
        for (const WorstCell& cell : *driver.app().session().worst_cells(ColorBy::shape, 100)) parts.insert(cell.part);
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
    EXPECT_NEAR(driver.app().session().worst_cells(ColorBy::shape, 100)->front().value, histogram.min, 1e-6);
}

// A row is marked as long as its cell is selected.
TEST(Runs, ARowOfTheWorstCellsIsMarkedWithItsCell) {
    Driver::Options options;
    options.parts = 2;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().color = ColorBy::min_dihedral;
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
    const CutSummary of_run = *driver.document().tree.find(1)->cut;
    ASSERT_EQ(of_run.rung, Rung::straight);
    ASSERT_LT(of_run.quality.angle_deg, 60);
    driver.state().panels.parameters = true;
    driver.frame();
    driver.click("Re-run cut of node 1");
    driver.await("the cut", [&] { return !driver.app().session().busy(); });
    const CutSummary again = *driver.document().tree.find(1)->cut;
    EXPECT_EQ(again.rung, Rung::straight);
    EXPECT_EQ(again.interface_faces, of_run.interface_faces);
    EXPECT_NEAR(again.quality.angle_deg, of_run.quality.angle_deg, 1e-9);
    EXPECT_NEAR(again.quality.dihedral_deg, of_run.quality.dihedral_deg, 1e-9);
    // Its halves are closed, and can be cut straight, too, although facets have pieces now.
    driver.state().node = 3;
    driver.settle();
    EXPECT_EQ(driver.document().tree.parts_below(1), (std::vector<NodeId>{2, 3}));
}

}  // namespace
}  // namespace kerf::test
