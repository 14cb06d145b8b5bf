// kerf solve as a user starts it.
#include <array>
#include <cmath>
#include <csignal>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "files/part/vtu_reader.h"
#include "solve/run/useful_ranks.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/mpirun.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

// Runs on the cube [0, 1]^3, whose faces are patches, in five parts.
class KerfSolve : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        const ChildResult result = test::run_kerf({"mesh", test::asset_path("cube"), "-o", mesh(), "-n", "5", "--size",
                                                   "0.16", "--feature-angle", "40", "-q"});
        ASSERT_EQ(result.exit_code, 0) << result.log;
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static std::string mesh() { return folder_->file("cube"); }

    std::string write_case(const std::string& text) const {
        std::ofstream(own_.file("case.toml")) << text;
        return own_.file("case.toml");
    }
    ChildResult solve(const std::string& text, int ranks = 0) const {
        const std::vector<std::string> command = {"solve", mesh(), "--case", write_case(text), "-o", out(), "-q"};
        if (ranks == 0) return test::run_kerf(command);
        std::vector<std::string> all = {test::kerf_program()};
        all.insert(all.end(), command.begin(), command.end());
        return test::run_ranks(ranks, all);
    }
    std::string out() const { return own_.file("out"); }
    nlohmann::json report() const {
        const std::string text = test::bytes_of_file(out() + "/report.json");
        EXPECT_TRUE(is_sealed(text));
        return nlohmann::json::parse(text);
    }
    // Nothing half-written stays.
    void expect_refused(int code, const std::string& text, const std::vector<std::string>& words) const {
        const ChildResult result = solve(text);
        EXPECT_EQ(result.exit_code, code) << result.log;
        for (const std::string& word : words)
            EXPECT_NE(result.log.find(word), std::string::npos) << "'" << word << "' in: " << result.log;
        EXPECT_EQ(own_.names(), std::vector<std::string>{"case.toml"});
    }
    inline static std::unique_ptr<test::TemporaryFolder> folder_;
    test::TemporaryFolder own_;
};

constexpr const char* steel = "[material.steel]\nyoung = 1000\npoisson = 0.25\ndensity = 2\n";
constexpr const char* weight = "[gravity]\nacceleration = [0, 0, -1]\n";
constexpr const char* three_planes =
    "[[support]]\nname = \"left\"\nplane = [1, 0, 0, 0]\nx = 0\n"
    "[[support]]\nname = \"front\"\nplane = [0, 1, 0, 0]\ny = 0\n"
    "[[support]]\nname = \"foot\"\nplane = [0, 0, 1, 0]\nz = 0\n";

Vec3 vector_of(const nlohmann::json& json) {
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

TEST_F(KerfSolve, AUniformTensionIsExact) {
    for (const int order : {1, 2})
        for (const int ranks : {0, 3}) {
            const ChildResult result =
                solve(std::string(steel) + three_planes + "[[load]]\nplane = [1, 0, 0, 1]\ntraction = [10, 0, 0]\n" +
                          "[solver]\nrtol = 1e-13\norder = " + std::to_string(order),
                      ranks);
            ASSERT_EQ(result.exit_code, 0) << result.log;
            const nlohmann::json of_case = report()["solve"]["cases"][0];
            EXPECT_LT((vector_of(of_case["load"]) - Vec3(10, 0, 0)).norm(), 1e-12);
            EXPECT_LT((vector_of(of_case["reactions"][0]["reaction"]) - Vec3(-10, 0, 0)).norm(), 1e-9);
            EXPECT_LT(of_case["imbalance"], 1e-10);
            EXPECT_NEAR(of_case["max_von_mises"]["value"], 10, 1e-8);
            EXPECT_NEAR(of_case["max_displacement"]["value"], 0.01 * std::sqrt(1 + 2 * 0.25 * 0.25), 1e-12);
            EXPECT_LT(of_case["relative_error"], 1e-8);
            EXPECT_EQ(report()["ranks"], std::max(ranks, 1));
        }
}

TEST_F(KerfSolve, FilesHaveTheValues) {
    ASSERT_EQ(solve(std::string(steel) + three_planes +
                    "[[load]]\nplane = [1, 0, 0, 1]\nforce = [10, 0, 0]\n[solver]\nrtol = 1e-12")
                  .exit_code,
              0);
    EXPECT_NE(test::bytes_of_file(out() + "/mesh.pvtu").find("Name=\"Displacement\" NumberOfComponents=\"3\""),
              std::string::npos);
    for (const auto& entry : fs::directory_iterator(out() + "/parts")) {
        const PartCellCounts counts = read_cell_counts(entry.path());
        for (const float stress : read_cell_values(entry.path(), "VonMises", 0, counts.tets + counts.facets))
            EXPECT_NEAR(stress, 10, 1e-5);
        const Part part = read_part(entry.path());
        EXPECT_EQ(part.tet_count(), counts.tets);
    }
}

// Gravity, an oblique pressure and a moved support; P1 and P2, both preconditioners, any ranks.
TEST_F(KerfSolve, LoadsAndReactionsBalanceForAnyRanks) {
    const std::string loads =
        std::string(steel) +
        "[[support]]\npatch = \"face_1\"\nfixed = true\n[[support]]\npoint = [1, 1, 1]\nx = 0.01\n"
        "[[load]]\nbox = [-1, -1, 0.999, 2, 2, 2]\npressure = 3\n"
        "[[load]]\npoint = [1, 0, 1]\nforce = [0, 1, 0]\n[gravity]\nacceleration = [0, 0, -9.81]\n";
    for (const std::string& solver :
         {std::string("order = 1"), std::string("order = 1\npreconditioner = \"icc\""), std::string("order = 2")}) {
        std::vector<double> values;
        for (const int ranks : {0, 2, 3}) {
            ASSERT_EQ(solve(loads + "[solver]\nrtol = 1e-11\n" + solver, ranks).exit_code, 0);
            const nlohmann::json of_case = report()["solve"]["cases"][0];
            EXPECT_LT(of_case["imbalance"], 1e-9);
            EXPECT_LE(of_case["residual"], 1e-11 * 1.1);
            values.push_back(of_case["max_displacement"]["value"]);
        }
        EXPECT_NEAR(values[1] / values[0], 1, 1e-8);
        EXPECT_NEAR(values[2] / values[0], 1, 1e-8);
    }
}

TEST_F(KerfSolve, TheSameRanksGiveTheSameBytes) {
    const std::string text = std::string(steel) + three_planes + "[[load]]\nplane = [1, 0, 0, 1]\nforce = [1, 2, 3]\n";
    std::vector<nlohmann::json> files;
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(solve(text, 2).exit_code, 0);
        files.push_back(report()["files"]);
    }
    EXPECT_EQ(files[0], files[1]);
}

// The report has the new name, and the lines for people tell it.
TEST_F(KerfSolve, AnOldNameOfTheMultigridIsTold) {
    const std::string file = write_case(std::string(steel) + three_planes +
                                        "[[load]]\nplane = [1, 0, 0, 1]\nforce = [1, 2, 3]\n"
                                        "[solver]\npreconditioner = \"gamg\"\n");
    const ChildResult result = test::run_kerf({"solve", mesh(), "--case", file, "-o", out()});
    ASSERT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("note        " + file), std::string::npos) << result.log;
    EXPECT_NE(result.log.find("preconditioner \"gamg\" is \"multigrid\" now."), std::string::npos) << result.log;
    EXPECT_EQ(report()["solve"]["preconditioner"], "multigrid");
}

TEST_F(KerfSolve, CasesAreApart) {
    ASSERT_EQ(solve(std::string(steel) + three_planes +
                    "[[load]]\ncase = \"a\"\nplane = [1, 0, 0, 1]\nforce = [1, 0, 0]\n"
                    "[[load]]\ncase = \"b\"\nplane = [0, 0, 1, 1]\npressure = 2\n")
                  .exit_code,
              0);
    const nlohmann::json cases = report()["solve"]["cases"];
    ASSERT_EQ(cases.size(), 2U);
    EXPECT_NEAR(cases[0]["max_von_mises"]["value"], 1, 1e-5);
    EXPECT_NEAR(cases[1]["max_von_mises"]["value"], 2, 1e-5);
    EXPECT_TRUE(has_cell_values(out() + "/parts/part_0004.vtu", "VonMises a") ||
                has_cell_values(out() + "/parts/part_0005.vtu", "VonMises a"));
}

// Materials with the same constants are one; bodies have their own.
TEST_F(KerfSolve, MaterialsBelongToPartsOrBodies) {
    const std::string loads = std::string(three_planes) + "[[load]]\nplane = [1, 0, 0, 1]\ntraction = [10, 3, 0]\n";
    const auto largest = [&] { return report()["solve"]["cases"][0]["max_displacement"]["value"].get<double>(); };
    ASSERT_EQ(solve(steel + loads + "[solver]\nrtol = 1e-11").exit_code, 0);
    const double whole = largest();
    const std::string constants = "young = 1000\npoisson = 0.25\n";
    const nlohmann::json parts = nlohmann::json::parse(test::bytes_of_file(mesh() + "/report.json"))["parts"];
    const std::string some = fmt::format("parts = [{}, {}]\n", parts[0]["id"].get<int>(), parts[3]["id"].get<int>());
    for (const int ranks : {0, 3}) {
        const ChildResult result = solve(
            "[material.some]\n" + some + constants + "[material.rest]\n" + constants + loads + "[solver]\nrtol = 1e-11",
            ranks);
        ASSERT_EQ(result.exit_code, 0) << result.log;
        EXPECT_NEAR(largest() / whole, 1, 1e-8);
    }
    // Two bars, of which the second one is twice as stiff.
    const Soup bars =
        test::join(test::box(Vec3(0, 0, 0), Vec3(1, 1, 1), 3), test::box(Vec3(2, 0, 0), Vec3(3, 1, 1), 3));
    test::write_off(own_.file("bars.off"), bars.vertices, bars.facets);
    ASSERT_EQ(test::run_kerf(
                  {"mesh", own_.file("bars.off"), "-o", own_.file("bars"), "-n", "4", "--feature-angle", "40", "-q"})
                  .exit_code,
              0);
    const ChildResult listed = test::run_kerf({"solve", own_.file("bars"), "--list-patches"});
    const std::string text = test::output_of(listed);
    const std::size_t line = text.find("(3, 0.5, 0.5)"), end = text.find('\n', line);
    ASSERT_NE(line, std::string::npos) << text;
    const std::string patch = text.substr(text.rfind(' ', end) + 1, end - text.rfind(' ', end) - 1);
    const std::string of_bars =
        "[[support]]\nplane = [1, 0, 0, 0]\nx = 0\n[[support]]\nplane = [1, 0, 0, 2]\nx = 0\n"
        "[[support]]\nplane = [0, 1, 0, 0]\ny = 0\n[[support]]\nplane = [0, 0, 1, 0]\nz = 0\n"
        "[[load]]\nplane = [1, 0, 0, 1]\ntraction = [10, 0, 0]\n"
        "[[load]]\nplane = [1, 0, 0, 3]\ntraction = [10, 0, 0]\n[solver]\nrtol = 1e-12";
    const std::string stiff = "[material.stiff]\nyoung = 2000\npoisson = 0.25\npatch = \"" + patch + "\"\n";
    const ChildResult result = test::run_kerf(
        {"solve", own_.file("bars"), "--case",
         write_case("[material.soft]\nyoung = 1000\npoisson = 0.25\n" + stiff + of_bars), "-o", out(), "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.log;
    for (const auto& entry : fs::directory_iterator(out() + "/parts")) {
        const Part part = read_part(entry.path());
        for (const PartValues& values : read_values(entry.path()))
            for (std::size_t v = 0; values.name == "Displacement" && v < part.mesh.vertices.size(); ++v) {
                const double x = part.mesh.vertices[v].x();
                EXPECT_NEAR(values.number(3 * v), x < 1.5 ? 0.01 * x : 0.005 * (x - 2), 1e-9);
            }
    }
}

TEST_F(KerfSolve, ListsPatches) {
    const ChildResult result = test::run_kerf({"solve", mesh(), "--list-patches"});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    const std::string text = test::output_of(result);
    EXPECT_EQ(test::count(text, "face_"), 6);
    EXPECT_NE(text.find("(0.5, 0.5, 1)"), std::string::npos) << text;
    EXPECT_NE(text.find("(0.000, 0.000, 1.000)"), std::string::npos) << text;
}

TEST_F(KerfSolve, RefusesWhatCannotBe) {
    const std::string held = "[[support]]\npatch = \"face_1\"\nfixed = true\n";
    const std::string material = std::string(weight) + steel;
    expect_refused(2, material, {"not held at all", "[[support]]"});
    expect_refused(2, material + "[[support]]\npatch = \"face_10\"\nfixed = true", {"'face_10'", "It has 'face_1'"});
    expect_refused(2, material + "[[support]]\nbox = [5, 5, 5, 6, 6, 6]\nfixed = true", {"selects no triangle"});
    expect_refused(2, material + "[[support]]\nplane = [0, 0, 1, 0]\nz = 0", {"free to"});
    expect_refused(2, material + held + "[[load]]\nplane = [1, 0, 0, 0.4321]\npressure = 1",
                   {"selects no triangle of the surface", "between parts"});
    expect_refused(2, weight + std::string("[material.a]\nyoung = 1\npoisson = 0\ndensity = 1\nparts = [4]\n") + held,
                   {"have no material"});
    expect_refused(2, weight + std::string("[material.a]\nyoung = 1\npoisson = 0\ndensity = 1\nparts = [77]\n") + held,
                   {"part 77"});
    expect_refused(2, "[material.a]\nyoung = 1\npoisson = 0.6\n" + held, {"between -1 and 0.5"});
    expect_refused(9, material + held + "[[load]]\npatch = \"face_2\"\npressure = 1\n[solver]\nmax_iterations = 2",
                   {"not reached", "2 iterations", "Try"});
    expect_refused(2, material + held + "[[load]]\npoint = [1e9, 0, 0]\nforce = [1, 0, 0]",
                   {"away from the body", "units of the mesh"});
    expect_refused(2, material + held + "[solver]\nrtol = 1e-30", {"between 1e-14", "and 1"});
    expect_refused(2,
                   material + held +
                       "[[load]]\npatch = \"face_2\"\npressure = 1\ncase = \"a\"\n[[combination]]\nname = \"b\"\n"
                       "cases = {a = 1}\n[[combination]]\nname = \"b\"\ncases = {a = 2}",
                   {"'b' is a combination already"});
    expect_refused(2, material + held + "[[load]]\npatch = \"face_2\"\npressure = 1e300",
                   {"larger than numbers can be"});
    expect_refused(2, material + held + "[solver]\npetsc = \"nonsense\"", {"'nonsense'"});
    for (const std::string options : {"-pc_type nonsense", "-pc_type lu", "-ksp_type nonsense", "-ksp_rtol nonsense"})
        expect_refused(
            2, material + held + "[[load]]\npatch = \"face_2\"\npressure = 1\n[solver]\npetsc = \"" + options + "\"",
            {"'" + options + "'", "Correct them"});
    expect_refused(2,
                   material + held +
                       "[[load]]\npatch = \"face_2\"\npressure = 1\n[solver]\npreconditioner = \"icc\"\npetsc = "
                       "\"-sub_pc_type nonsense\"",
                   {"'-sub_pc_type nonsense'", "Correct them"});
}

// A case may come from anybody.
TEST_F(KerfSolve, ACaseWritesNothingElsewhere) {
    const std::string text = std::string(steel) +
                             "[[support]]\npatch = \"face_1\"\nfixed = true\n[[load]]\npatch = \"face_2\"\n"
                             "pressure = 1\n[solver]\npetsc = ";
    const std::string file = own_.file("of_another");
    for (const std::string& options : std::vector<std::string>{
             "-ksp_view_solution ascii:" + file, "-ksp_monitor :" + file, "-ksp_view_mat\tascii:" + file,
             "-log_view :" + file, "-options_file " + file, "-objects_dump " + file, "-ksp_view_rhs binary",
             "-ksp_view draw", "-dll_append lib.so", "-prefix_push x_", "-ksp_type cg -info", "-log_view",
             "-pc_type python", "-x_-log_view"})
        expect_refused(2, text + "'" + options + "'", {"petsc "});
    EXPECT_EQ(solve(text + "\"-ksp_type cg -ksp_rtol 1e-9 -ksp_max_it 300 -ksp_error_if_not_converged\"").exit_code, 0);
}

// PETSc may be told to call anything a solution: the residual decides.
TEST_F(KerfSolve, WhatPetscCallsConvergedIsMeasured) {
    const std::string text =
        std::string(steel) +
        "[[support]]\npatch = \"face_1\"\nfixed = true\n[[load]]\npatch = \"face_2\"\npressure = 1\n";
    expect_refused(9, text + "[solver]\npetsc = \"-ksp_type preonly -pc_type none\"",
                   {"not reached the tolerance 1e-08", "'-ksp_type preonly -pc_type none'", "leave that out"});
    expect_refused(9, text + "[solver]\npetsc = \"-ksp_rtol 0.5\"", {"CONVERGED_RTOL", "residual"});
    ASSERT_EQ(solve(text + "[solver]\npetsc = \"-ksp_rtol 1e-10\"").exit_code, 0);
    EXPECT_LE(report()["solve"]["cases"][0]["residual"], 1.1e-10);
}

// Wherever the memory ends, also inside of PETSc.
TEST_F(KerfSolve, OutOfMemoryIsSaid) {
    const std::string text = std::string(weight) + steel + three_planes + "[solver]\norder = 2";
    const std::string command =
        fmt::format("'{}' solve '{}' --case '{}' -o '{}' -q", test::kerf_program(), mesh(), write_case(text), out());
    std::int64_t refused = 0;
    for (const int megabytes : {300, 340, 380, 420, 460, 500, 560, 640, 800}) {
        const ChildResult result =
            test::run_program("/bin/sh", {"-c", fmt::format("ulimit -v {}; exec {}", megabytes * 1000, command)});
        EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 5)
            << megabytes << ": " << result.exit_code << result.log;
        if (result.exit_code == 0) break;
        EXPECT_NE(result.log.find("ut of memory"), std::string::npos) << result.log;
        EXPECT_EQ(own_.names(), std::vector<std::string>{"case.toml"});
        ++refused;
    }
    EXPECT_GT(refused, 0);
}

// Without mpirun, and told on the way as a mesh is.
TEST_F(KerfSolve, StartsItsRanksAndTellsItsProgress) {
    const std::string text =
        std::string(steel) + three_planes + "[[load]]\nplane = [1, 0, 0, 1]\ntraction = [10, 0, 0]\n";
    const auto solve_with = [&](const std::string& ranks) {
        return test::run_kerf({"solve", mesh(), "--case", write_case(text), "-o", out(), "--ranks", ranks});
    };
    const ChildResult result = solve_with("2");
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_EQ(report()["ranks"], 2);
    EXPECT_GE(test::count(result.log, " iterations  "), 2) << result.log;
    EXPECT_LE(test::count(result.log, " iterations  "), 10) << "a line for each tenth";
    fs::remove_all(out());
    const ChildResult refused = solve_with("6");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.log.substr(0, 6), "kerf: ") << "nothing but the reason";
    EXPECT_EQ(test::count(refused.log, "\n"), 1) << refused.log;
    EXPECT_EQ(useful_ranks_of_run(mesh()), 1) << "too small to share";
    EXPECT_EQ(useful_ranks_of_run(own_.file("none")), 1);
    fs::create_directories(own_.file("large"));
    std::ofstream(own_.file("large/report.json")) << R"({"parts": [{}, {}, {}], "totals": {"tets": 1000000}})";
    EXPECT_EQ(useful_ranks_of_run(own_.file("large")), 3);
    std::ofstream(own_.file("large.stl")) << std::string(5'000'000, 'x');
    EXPECT_EQ(useful_ranks_of_surface(own_.file("large.stl"), 0), 4);
    EXPECT_EQ(useful_ranks_of_surface(own_.file("large.stl"), 2), 2);
    EXPECT_EQ(useful_ranks_of_surface(test::asset_path("cube"), 8), 1);
}

TEST_F(KerfSolve, CancelledRanksOfItsOwnAreGone) {
    const std::string text = std::string(steel) + three_planes + "[solver]\norder = 2";
    test::StartedRun run(test::kerf_program(),
                         {"solve", mesh(), "--case", write_case(text), "-o", out(), "--ranks", "2"});
    std::vector<pid_t> ranks;
    ASSERT_TRUE(test::await([&] {
        ranks = test::descendants_of(run.process(), "kerf-solve");
        return ranks.size() == 2;
    }));
    ASSERT_EQ(::kill(run.process(), SIGINT), 0);
    const ChildResult result = run.wait();
    EXPECT_EQ(result.exit_code, 130) << result.log;
    for (const pid_t rank : ranks) EXPECT_TRUE(test::await([&] { return test::has_ended(rank); }));
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(KerfSolve, RefusesMoreRanksThanParts) {
    const ChildResult result = solve(std::string(weight) + steel + three_planes, 6);
    EXPECT_EQ(result.exit_code, 2) << result.log;
    EXPECT_EQ(test::count(result.log, "6 ranks are more than the 5 parts"), 1) << result.log;
}

TEST_F(KerfSolve, RefusesFoldersThatAreNone) {
    const std::string text = std::string(weight) + steel + three_planes;
    const auto code = [&](const std::vector<std::string>& arguments) { return test::run_kerf(arguments).exit_code; };
    EXPECT_EQ(code({"solve", own_.file("none"), "--case", write_case(text), "-o", out()}), 7);
    EXPECT_EQ(code({"solve", mesh(), "--case", own_.file("none"), "-o", out()}), 7);
    EXPECT_EQ(code({"solve", mesh(), "--case", write_case(text), "-o", mesh()}), 2);
    EXPECT_EQ(code({"solve", mesh(), "--case", write_case(text), "-o", mesh() + "/stress"}), 2);
    EXPECT_EQ(code({"solve", mesh(), "--case", write_case(text)}), 2);
    EXPECT_EQ(code({"solve", mesh()}), 2);
    EXPECT_EQ(code({"solve", "--help"}), 0);
    std::ofstream(own_.file("precious")) << "mine";
    EXPECT_EQ(code({"solve", mesh(), "--case", write_case(text), "-o", own_.file("precious")}), 7);
    EXPECT_EQ(test::bytes_of_file(own_.file("precious")), "mine");
    // What an interrupted mesh has finished is not taken for a solution's.
    fs::create_directories(out() + ".kerf-partial/work");
    const std::string unfinished = RunFolder::saved_run_file(out());
    std::ofstream(unfinished) << "options";
    EXPECT_EQ(code({"solve", mesh(), "--case", write_case(text), "-o", out()}), 7);
    EXPECT_EQ(test::bytes_of_file(unfinished), "options");
}

TEST_F(KerfSolve, SurroundingsDoNotMatter) {
    std::ofstream(own_.file(".petscrc")) << "-ksp_max_it 1\n";
    const std::string text = std::string(steel) + three_planes + "[[load]]\nplane = [1, 0, 0, 1]\nforce = [1, 0, 0]\n";
    const ChildResult result = test::run_program(
        "/usr/bin/env", {"-C", own_.file(""), "HOME=" + own_.file(""), "PETSC_OPTIONS=-ksp_max_it 1",
                         test::kerf_program(), "solve", mesh(), "--case", write_case(text), "-o", out(), "-q"});
    EXPECT_EQ(result.exit_code, 0) << result.log;
}

}  // namespace
}  // namespace kerf
