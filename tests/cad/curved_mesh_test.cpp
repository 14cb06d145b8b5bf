// Meshes of second order whose edges follow the faces of CAD files.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cad/cad_files.h"
#include "files/io/file_bytes.h"
#include "files/quality/inside/measured_mesh.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#ifdef KERF_MPIRUN
#include "support/mpirun.h"
#endif

namespace kerf {
namespace {

using std::numbers::pi;

struct CurvedRun {
    std::int64_t surface_edges = 0, curved_edges = 0, straightened_edges = 0;
    double worst_scaled_jacobian = 1, straight_volume = 0, volume = 0;
};

class CurvedCadMesh : public testing::Test {
 protected:
    CurvedRun run(const test::CadShape& shape, const char* size, const char* curve = "auto") {
        const std::string path = folder_.file("solid.step"), out = folder_.file("out");
        test::write_cad(path, shape);
        const ChildResult run = test::run_kerf(
            {"mesh", path, "-o", out, "-n", "2", "--workers", "2", "--order", "2", "--size", size, "--curve", curve});
        EXPECT_EQ(run.exit_code, 0) << run.log;
        const nlohmann::json report = nlohmann::json::parse(read_file(out + "/report.json"));
        CurvedRun result;
        result.straight_volume = result.volume = report["totals"]["volume"];
        if (!report.contains("curve")) return result;
        const nlohmann::json& curved = report["curve"];
        result.surface_edges = curved["surface_edges"];
        result.curved_edges = curved["curved_edges"];
        result.straightened_edges = curved["straightened_edges"];
        result.worst_scaled_jacobian = curved["worst_scaled_jacobian"];
        result.volume += curved["volume_gain"].get<double>();
        expect_files_agree(out, curved);
        return result;
    }
    // What others find in the files alone is what the run says.
    static void expect_files_agree(const std::string& out, const nlohmann::json& curved) {
        const ChildResult verified = test::run_kerf({"verify", out});
        EXPECT_EQ(verified.exit_code, 0) << verified.log;
        const MeshQuality quality = MeasurableMesh(out).measure(1);
        ASSERT_TRUE(quality.curved);
        EXPECT_EQ(quality.curved->count, curved["curved_cells"].get<std::int64_t>());
        EXPECT_NEAR(quality.curved->worst_scaled_jacobian, curved["worst_scaled_jacobian"].get<double>(), 2e-3);
    }

    test::TemporaryFolder folder_;
};

TEST_F(CurvedCadMesh, VolumeOfABallConvergesWithTheFourthPower) {
    const double exact = 4 * pi / 3;
    const CurvedRun coarse = run(test::sphere(1), "0.5"), fine = run(test::sphere(1), "0.12");
    for (const CurvedRun& run : {coarse, fine}) {
        EXPECT_EQ(run.curved_edges + run.straightened_edges, run.surface_edges);
        EXPECT_GT(run.worst_scaled_jacobian, 0);
    }
    EXPECT_EQ(fine.straightened_edges, 0);
    const double straight_error = exact - fine.straight_volume, error = std::abs(fine.volume - exact);
    EXPECT_GT(straight_error, 100 * error) << "vertices lie on the ball";
    EXPECT_LT(error, 2e-5 * exact);
    EXPECT_GT(std::abs(coarse.volume - exact), 8 * error);
}

TEST_F(CurvedCadMesh, EdgesOfABoxAreStraight) {
    const CurvedRun box = run(test::box({0, 0, 0}, {1, 2, 3}), "1");
    EXPECT_EQ(box.curved_edges, 0);
    EXPECT_GT(box.surface_edges, 0);
    EXPECT_NEAR(box.volume, 6, 1e-9);
    const CurvedRun straight = run(test::sphere(1), "0.5", "straight");
    EXPECT_EQ(straight.surface_edges, 0);
    EXPECT_EQ(straight.volume, straight.straight_volume);
}

#ifdef KERF_MPIRUN
TEST_F(CurvedCadMesh, IsTheSameForAnyRanks) {
    const std::string path = folder_.file("torus.step");
    test::write_cad(path, test::torus(2, 0.7));
    const auto files_of = [&](int ranks, const char* workers) {
        const std::string out = folder_.file("out");
        const ChildResult run =
            test::run_ranks(ranks, {test::kerf_program(), "mesh", path, "-o", out, "-n", "3", "--workers", workers,
                                    "--size", "0.5", "--order", "2", "--cad-deflection", "0.003"});
        EXPECT_EQ(run.exit_code, 0) << run.log;
        EXPECT_NE(run.log.find("\ncurved "), std::string::npos) << run.log;
        return test::result_of_run(out);
    };
    const auto files = files_of(1, "2");
    EXPECT_FALSE(files.empty());
    EXPECT_TRUE(files == files_of(2, "1"));
}
#endif

}  // namespace
}  // namespace kerf
