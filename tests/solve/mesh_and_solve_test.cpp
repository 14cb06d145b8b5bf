// kerf solve on a surface: mesh, solve, and mesh again where the error is large.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/run_manifest.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/mpirun.h"
#include "support/places.h"
#include "support/program.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class MeshAndSolve : public testing::Test {
 protected:
    // Options for the bracket, whose inner edge is sharp.
    std::vector<std::string> bracket(std::vector<std::string> more) const {
        std::vector<std::string> all = {"solve",  test::asset_path("l_bracket"),
                                        "--case", test::asset_folder() + "/l_bracket_case.toml",
                                        "-o",     out(),
                                        "-n",     "3",
                                        "-q"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::string out() const { return folder_.file("out"); }
    nlohmann::json json_of(const std::string& file) const {
        const std::string text = test::bytes_of_file(out() + "/" + file);
        EXPECT_TRUE(is_sealed(text)) << file;
        return nlohmann::json::parse(text);
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(out() + "/" + name); }

    test::TemporaryFolder folder_;
};

TEST_F(MeshAndSolve, ASurfaceIsMeshedFirst) {
    ASSERT_EQ(test::run_kerf(bracket({"--size", "12"})).exit_code, 0);
    EXPECT_EQ(test::run_kerf({"verify", out() + "/mesh"}).exit_code, 0);
    EXPECT_LT(json_of("solution/report.json")["solve"]["cases"][0]["imbalance"], 1e-8);
    EXPECT_FALSE(exists("solution/size_field.vtu"));
    // The sizes that a user can mesh with on his own.
    const ChildResult again =
        test::run_kerf({"solve", out() + "/mesh", "--case", test::asset_folder() + "/l_bracket_case.toml", "-o",
                        folder_.file("again"), "--target-error", "0.1"});
    ASSERT_EQ(again.exit_code, 0) << again.log;
    EXPECT_NE(again.log.find("--size-field"), std::string::npos) << again.log;
    EXPECT_EQ(test::run_kerf({"mesh", test::asset_path("l_bracket"), "-o", folder_.file("finer"), "-q", "--size-field",
                              folder_.file("again/size_field.vtu")})
                  .exit_code,
              0);
}

// What the case says of the elements is the order of the mesh, so that its edges are curved; the option wins.
TEST_F(MeshAndSolve, TheOrderOfTheCaseIsThatOfTheMesh) {
    const std::string file = folder_.file("case.toml");
    std::ofstream(file) << test::bytes_of_file(test::asset_folder() + "/l_bracket_case.toml")
                        << "[solver]\norder = 2\n";
    const std::vector<std::string> line = {
        "solve", test::asset_path("l_bracket"), "--case", file, "-q", "-n", "2", "--size", "25", "-o"};
    for (const int order : {2, 1}) {
        const std::string folder = out() + std::to_string(order);
        std::vector<std::string> whole = line;
        whole.push_back(folder);
        if (order == 1) whole.insert(whole.end(), {"--order", "1"});
        ASSERT_EQ(test::run_kerf(whole).exit_code, 0);
        const auto json = [&](const char* name) { return nlohmann::json::parse(test::bytes_of_file(folder + name)); };
        EXPECT_EQ(json("/mesh/report.json")["totals"]["order"], order);
        EXPECT_EQ(json("/solution/report.json")["solve"]["order"], order);
    }
}

// The error falls from step to step as fast as the best meshes allow, 1/3 of the order of the cells' number, or nearly.
TEST_F(MeshAndSolve, TheErrorFallsWhereCellsAreFinerWhereItIs) {
    ASSERT_EQ(test::run_kerf(bracket({"--adapt", "5", "--target-error", "0.12"})).exit_code, 0);
    const nlohmann::json report = json_of("report.json"), steps = report["steps"];
    EXPECT_TRUE(report["reached"]);
    ASSERT_GE(steps.size(), 3U);
    for (std::size_t i = 1; i < steps.size(); ++i) {
        const double finer = std::log(steps[i]["nodes"].get<double>() / steps[i - 1]["nodes"].get<double>());
        const double better =
            std::log(steps[i - 1]["relative_error"].get<double>() / steps[i]["relative_error"].get<double>());
        EXPECT_GT(better / finer, 0.29) << i;
        EXPECT_GT(steps[i]["max_von_mises"], steps[i - 1]["max_von_mises"]) << "nearer to the edge";
    }
    EXPECT_LE(steps.back()["relative_error"], 0.12);
    EXPECT_GT(steps[steps.size() - 2]["relative_error"], 0.12);
    // A shorter run into the folder leaves nothing of the longer one.
    ASSERT_EQ(test::run_kerf(bracket({"--adapt", "1", "--target-error", "0.2"})).exit_code, 0);
    EXPECT_EQ(json_of("report.json")["steps"].size(), 2U);
    EXPECT_TRUE(exists("step_2/solution/mesh.pvtu"));
    EXPECT_FALSE(exists("step_3"));
    // But for what is not its own.
    std::ofstream(out() + "/step_1/solution/notes.txt") << "mine";
    ASSERT_EQ(test::run_kerf(bracket({"--size", "20"})).exit_code, 0);
    EXPECT_FALSE(exists("step_1/mesh") || exists("step_1/solution/mesh.pvtu") || exists("step_2") ||
                 exists("report.json"));
    EXPECT_EQ(test::bytes_of_file(out() + "/step_1/solution/notes.txt"), "mine");
    std::filesystem::remove_all(out() + "/step_1");
    EXPECT_TRUE(exists("solution/mesh.pvtu"));
    ASSERT_EQ(test::run_kerf(bracket({"--size", "20", "--adapt", "1"})).exit_code, 0);
    EXPECT_FALSE(exists("solution"));
}

TEST_F(MeshAndSolve, RefusesWhatCannotBe) {
    const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& words) {
        const ChildResult result = test::run_kerf(arguments);
        EXPECT_EQ(result.exit_code, code) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
    };
    std::filesystem::create_directories(out() + "/step_1");
    std::ofstream(out() + "/step_1/notes.txt") << "mine";
    refused(bracket({}), 7, "notes.txt is in the way");
    std::filesystem::remove_all(out());
    refused({"solve", test::asset_path("l_bracket"), "--list-patches"}, 2, "kerf check");
    const std::string own_case = folder_.file("own.toml");
    std::ofstream(own_case) << "mine";
    refused({"solve", test::asset_path("l_bracket"), "--case", own_case, "-o", out(), "--report", own_case}, 7,
            "is the input");
    EXPECT_EQ(test::bytes_of_file(own_case), "mine");
    refused({"solve", test::asset_path("l_bracket"), "--case", folder_.file("none.toml"), "-o", out()}, 7, "none.toml");
    EXPECT_FALSE(std::filesystem::exists(out())) << "the case is read before anything is meshed";
    ASSERT_EQ(test::run_kerf(bracket({"--size", "20"})).exit_code, 0);
    const std::string case_file = test::asset_folder() + "/l_bracket_case.toml";
    for (const char* option : {"--size", "--adapt"})
        refused({"solve", out() + "/mesh", "--case", case_file, "-o", folder_.file("again"), option, "3"}, 2,
                std::string(option) + " is for meshing");
}

// Each step is told before the next mesh is begun.
TEST_F(MeshAndSolve, StepsAreToldAsTheyCome) {
    std::vector<std::string> command = bracket({"--adapt", "1", "--size", "4"});
    std::erase(command, "-q");
    const ChildResult result = test::run_kerf(command);
    ASSERT_EQ(result.exit_code, 0) << result.log;
    const std::size_t first = result.log.find("step_1/solution"), next = result.log.find(" 100 % ", first),
                      second = result.log.find("step_2/solution", next);
    ASSERT_NE(second, std::string::npos) << "the parts of the next mesh come between: " << result.log;
}

TEST_F(MeshAndSolve, AKilledRankLeavesNothingHalfWritten) {
    ASSERT_EQ(test::run_kerf(bracket({"--size", "3"})).exit_code, 0);
    std::vector<std::string> command = test::mpirun_arguments(2);
    for (const std::string& word :
         {test::kerf_program(), std::string("solve"), out() + "/mesh", std::string("--case"),
          test::asset_folder() + "/l_bracket_case.toml", std::string("-o"), folder_.file("stress"), std::string("-q")})
        command.push_back(word);
    test::StartedRun run("/usr/bin/env", command);
    std::vector<pid_t> solvers;
    ASSERT_TRUE(test::await([&] {
        solvers = test::descendants_of(run.process(), "kerf-solve");
        return solvers.size() == 2 && std::filesystem::exists(folder_.file("stress.kerf-partial"));
    }));
    ASSERT_EQ(::kill(solvers.back(), SIGKILL), 0);
    EXPECT_NE(run.wait().exit_code, 0);
    ASSERT_FALSE(std::filesystem::exists(folder_.file("stress"))) << "the run was faster than the signal";
    const ChildResult again = test::run_program("/usr/bin/env", command);
    EXPECT_EQ(again.exit_code, 0) << again.log;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"out", "stress"}));
}

}  // namespace
}  // namespace kerf
