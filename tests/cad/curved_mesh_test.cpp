// Meshes of second order whose edges follow the faces of CAD files.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "cad/cad_files.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/run_in_process.h"
#include "support/temporary_folder.h"
#ifdef KERF_MPIRUN
#include "support/mpirun.h"
#endif

namespace kerf {
namespace {

using std::numbers::pi;

struct CurvedRun {
    CurveReport curve;
    double straight_volume = 0;

    double volume() const { return straight_volume + curve.volume_gain; }
};

class CurvedCadMesh : public testing::Test {
 protected:
    CurvedRun run(const test::CadShape& shape, double size, Curving curving = Curving::automatic) {
        const std::string path = folder_.file("solid.step");
        test::write_cad(path, shape);
        RunOptions options;
        options.order = 2;
        options.curving = curving;
        options.sizes.size = Length(size);
        Input input;
        const RunReport report = test::run_parts(path, folder_.file("out"), 2, input, nullptr, options);
        EXPECT_EQ(report.exit_code, 0);
        CurvedRun result;
        if (report.curve) result.curve = *report.curve;
        for (const PartReport& part : report.parts) result.straight_volume += part.result.laws.volume;
        return result;
    }
    test::TemporaryFolder folder_;
};

TEST_F(CurvedCadMesh, VolumeOfABallConvergesWithTheFourthPower) {
    const double exact = 4 * pi / 3;
    const CurvedRun coarse = run(test::sphere(1), 0.5), fine = run(test::sphere(1), 0.25);
    for (const CurvedRun& run : {coarse, fine}) {
        EXPECT_EQ(run.curve.curved_edges + run.curve.straightened_edges, run.curve.surface_edges);
        EXPECT_GT(run.curve.worst_scaled_jacobian, 0);
    }
    EXPECT_EQ(fine.curve.straightened_edges, 0);
    const double straight_error = exact - fine.straight_volume, error = std::abs(fine.volume() - exact);
    EXPECT_GT(straight_error, 0.01 * exact) << "vertices lie on the ball";
    EXPECT_LT(error, 2e-4 * exact);
    EXPECT_GT(std::abs(coarse.volume() - exact), 8 * error);
}

TEST_F(CurvedCadMesh, EdgesOfABoxAreStraight) {
    const CurvedRun box = run(test::box({0, 0, 0}, {1, 2, 3}), 1);
    EXPECT_EQ(box.curve.curved_edges, 0);
    EXPECT_GT(box.curve.surface_edges, 0);
    EXPECT_NEAR(box.volume(), 6, 1e-9);
    EXPECT_EQ(run(test::sphere(1), 0.5, Curving::straight).curve.surface_edges, 0);
}

#ifdef KERF_MPIRUN
TEST_F(CurvedCadMesh, IsTheSameForAnyRanks) {
    const std::string path = folder_.file("torus.step");
    test::write_cad(path, test::torus(2, 0.7));
    const auto files_of = [&](int ranks, const char* workers) {
        const std::string out = folder_.file("out");
        const ChildResult run = test::run_ranks(ranks, {KERF_PROGRAM, "mesh", path, "-o", out, "-n", "3", "--workers",
                                                        workers, "--size", "0.5", "--order", "2"});
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
