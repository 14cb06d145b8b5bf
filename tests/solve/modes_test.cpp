// kerf solve --modes: natural frequencies.
#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/part/vtu_reader.h"
#include "solve/equations/inside/mass_matrix.h"
#include "solve/equations/modes.h"
#include "support/file_contents.h"
#include "support/mpirun.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

// Of fields that are linear, by their values at the nodes.
TEST(MassShares, IntegrateProductsOfPolynomials) {
    for (const int order : {1, 2}) {
        const MassShares shares = mass_shares(order);
        const auto nodes = static_cast<std::size_t>(element_nodes(order));
        // Barycentric coordinate i at the nodes; the integral of two of them is (1 + [i = j]) / 20.
        std::vector<std::array<double, 4>> at(nodes);
        for (std::size_t n = 0; n < nodes; ++n)
            for (std::size_t i = 0; i < 4; ++i)
                at[n][i] = n < 4 ? (n == i ? 1 : 0)
                                 : 0.5 * ((tet_edges[n - 4][0] == static_cast<int>(i) ? 1 : 0) +
                                          (tet_edges[n - 4][1] == static_cast<int>(i) ? 1 : 0));
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                double sum = 0;
                for (std::size_t a = 0; a < nodes; ++a)
                    for (std::size_t b = 0; b < nodes; ++b) sum += shares[a][b] * at[a][i] * at[b][j];
                EXPECT_NEAR(sum, (i == j ? 2 : 1) / 20.0, 1e-15);
            }
    }
}

// A bar of 20 x 2 x 1 with c = sqrt(young / density) = 10.
class Modes : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        const Soup bar = test::box(Vec3(0, 0, 0), Vec3(20, 2, 1));
        test::write_off(folder_->file("bar.off"), bar.vertices, bar.facets);
        const ChildResult result = test::run_kerf({"mesh", folder_->file("bar.off"), "-o", folder_->file("bar"), "-n",
                                                   "3", "--size", "1", "--surface", "remesh", "-q"});
        ASSERT_EQ(result.exit_code, 0) << result.log;
    }
    static void TearDownTestSuite() { folder_.reset(); }
    nlohmann::json solve(const std::string& supports, const std::string& count, int ranks) const {
        std::ofstream(own_.file("case.toml"))
            << "[material.a]\nyoung = 100\npoisson = 0\ndensity = 1\n[solver]\norder = 2\n"
            << supports;
        const ChildResult result =
            test::run_ranks(ranks, {test::kerf_program(), "solve", folder_->file("bar"), "--case",
                                    own_.file("case.toml"), "-o", own_.file("out"), "--modes", count, "-q"});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return nlohmann::json::parse(test::bytes_of_file(own_.file("out/report.json")))["solve"]["modes"];
    }
    inline static std::unique_ptr<test::TemporaryFolder> folder_;
    test::TemporaryFolder own_;
};

// Held across its length, a bar is a rod: (2 n - 1) c / 4 L, exactly without Poisson's effect.
TEST_F(Modes, OfARodAreThoseOfItsWaves) {
    const std::string held =
        "[[support]]\nplane = [1, 0, 0, 0]\nx = 0\n[[support]]\nbox = [-1, -1, -1, 21, 3, 2]\ny = 0\nz = 0\n";
    const auto wave = [](std::size_t n) { return (2 * static_cast<double>(n) + 1) * 10 / 80; };
    const nlohmann::json modes = solve(held, "3", 1);
    ASSERT_EQ(modes.size(), 3);
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(modes[n]["frequency"].get<double>(), wave(n), 5e-3 * wave(n));
    EXPECT_NE(test::bytes_of_file(own_.file("out/mesh.pvtu")).find("Name=\"Mode 3\""), std::string::npos);
    EXPECT_EQ(test::bytes_of_file(own_.file("out/modes.csv")).find("mode,frequency_hz"), 0);
}

// The same, held along two directions askew.
TEST_F(Modes, AreTheSameInAxesOfNodes) {
    const std::string askew =
        "[[support]]\nplane = [1, 0, 0, 0]\nx = 0\n"
        "[[support]]\nbox = [-1, -1, -1, 21, 3, 2]\ndirection = [0, 1, 2]\nalong = 0\n"
        "[[support]]\nbox = [-1, -1, -1, 21, 3, 2]\ndirection = [0, 2, 1]\nalong = 0\n";
    const nlohmann::json modes = solve(askew, "1", 1);
    ASSERT_EQ(modes.size(), 1);
    EXPECT_NEAR(modes[0]["frequency"].get<double>(), 10 / 80.0, 5e-3 * 10 / 80.0);
    // Half of a wave: sin(pi x / 2 L) with x^T M x = 1, so the end moves by sqrt(2 / volume).
    EXPECT_NEAR(modes[0]["max_displacement"]["value"].get<double>(), std::sqrt(2 / 40.0), 1e-3);
}

// Nothing holds it: six rigid motions, then the bending of a slender beam (Timoshenko's is 1 % below Euler's).
TEST_F(Modes, OfAFreeBarBeginWithSixRigidMotions) {
    const nlohmann::json modes = solve("", "7", 2);
    ASSERT_EQ(modes.size(), 7);
    for (std::size_t m = 0; m < 6; ++m) EXPECT_TRUE(modes[m]["rigid"].get<bool>()) << m;
    const double euler = 22.3733 / (2 * std::numbers::pi) / 400 * std::sqrt(100.0 / 12);
    EXPECT_FALSE(modes[6]["rigid"].get<bool>());
    EXPECT_NEAR(modes[6]["frequency"].get<double>(), euler, 0.02 * euler);
}

// Cantilevers of any length bend under their weight and swing as Euler and Bernoulli say: rounding in the stiffness of
// the longest is as large as its least eigenvalue.
TEST(SlenderBeams, AreThoseOfEulerAndBernoulli) {
    for (const double length : {10.0, 200.0, 1000.0}) {
        const test::TemporaryFolder folder;
        const Soup beam = test::box(Vec3(0, 0, 0), Vec3(length, 1, 1));
        test::write_off(folder.file("beam.off"), beam.vertices, beam.facets);
        const ChildResult meshed = test::run_kerf({"mesh", folder.file("beam.off"), "-o", folder.file("beam"), "-n",
                                                   "2", "--size", "1.5", "--surface", "remesh", "-q"});
        ASSERT_EQ(meshed.exit_code, 0) << meshed.log;
        std::ofstream(folder.file("case.toml"))
            << "[material.a]\nyoung = 100\npoisson = 0.3\ndensity = 1\n[solver]\norder = 2\n"
               "[[support]]\nplane = [1, 0, 0, 0]\nfixed = true\n[gravity]\nacceleration = [0, 0, -1e-6]\n";
        const auto solve = [&](std::vector<std::string> more) {
            std::vector<std::string> command = {test::kerf_program(),     "solve", folder.file("beam"), "--case",
                                                folder.file("case.toml"), "-o",    folder.file("out"),  "-q"};
            command.insert(command.end(), more.begin(), more.end());
            const ChildResult solved = test::run_ranks(1, command);
            EXPECT_EQ(solved.exit_code, 0) << solved.log;
            return nlohmann::json::parse(test::bytes_of_file(folder.file("out/report.json")))["solve"];
        };
        const auto bent = solve({})["cases"][0];
        const double euler = 1e-6 * std::pow(length, 4) * 12 / (8 * 100), shear = 1 + 1.04 / (length * length);
        EXPECT_NEAR(bent["max_displacement"]["value"].get<double>(), euler * shear, (5e-3 + 0.2 / length) * euler)
            << length;
        EXPECT_LE(bent["residual"], length < 1000 ? 1.1e-8 : 1e-7) << length;
        if (length == 1000) {
            EXPECT_LT(bent["backward_error"], 0x1p-52) << "what exceeds 1e-8 is rounding";
        }
        if (length < 200) continue;
        const auto modes = solve({"--modes", "4"})["modes"];
        ASSERT_EQ(modes.size(), 4);
        for (std::size_t m = 0; m < 4; ++m) {
            const double root = m < 2 ? 1.8751041 : 4.6940911;
            const double swing = root * root / (2 * std::numbers::pi) / (length * length) * std::sqrt(100.0 / 12);
            EXPECT_NEAR(modes[m]["frequency"].get<double>(), swing, 5e-3 * swing) << length << ", mode " << m + 1;
        }
    }
}

}  // namespace
}  // namespace kerf
