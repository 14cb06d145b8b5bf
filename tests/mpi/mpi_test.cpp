// The program under mpirun: the same files for any number of ranks and workers, the same exit code on every rank.
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/host_name.h"
#include "run/prepare/input.h"
#include "support/all_formats.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/mpirun.h"
#include "support/places.h"
#include "support/program.h"
#include "support/region_bodies.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "support/started_run.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"
#include "support/write_off.h"

namespace kerf {
namespace {

using test::count;
using test::mpirun_arguments;
using test::run_ranks;

class MpiRuns : public testing::TestWithParam<std::pair<std::string, int>> {};
INSTANTIATE_TEST_SUITE_P(Assets, MpiRuns,
                         testing::Values(std::pair("hollow_box", 5), std::pair("pipe_with_holes", 8),
                                         std::pair("cube", 2),  // fewer parts than ranks
                                         std::pair("cube", 1)),
                         [](const auto& param) { return param.param.first + std::to_string(param.param.second); });

TEST_P(MpiRuns, PartFilesAreTheSameForAnyRanksAndWorkers) {
    const auto& [asset, parts] = GetParam();
    const test::TemporaryFolder folder;
    const auto arguments = [&, parts = parts, path = test::asset_path(asset)](const std::string& out, int workers) {
        return std::vector<std::string>{"mesh",      path,
                                        "-o",        folder.file(out),
                                        "-n",        std::to_string(parts),
                                        "--workers", std::to_string(workers),
                                        "--format",  test::all_formats()};
    };
    ASSERT_EQ(test::run_kerf(arguments("alone", 1)).exit_code, 0);
    const auto expected = test::result_of_run(folder.file("alone"));
    EXPECT_EQ(test::contents(folder.file("alone/parts")).size(), 2 * static_cast<std::size_t>(parts));
    for (const Format* format : formats())
        EXPECT_TRUE(format->name == std::string("vtu") || expected.contains(fmt::format("export/{}/", format->name)));
    using Shared = std::pair<int, int>;  // ranks, workers of each
    const std::vector<Shared> all = {{1, 2}, {2, 1}, {2, 2}, {3, 2}, {4, 1}, {7, 1}, {7, 2}};
    for (const auto& [ranks, workers] : test::slice(all, {{2, 2}, {7, 1}})) {
        SCOPED_TRACE(testing::Message() << ranks << " ranks, " << workers << " workers");
        std::vector<std::string> command = arguments("ranks", workers);
        command.insert(command.begin(), test::kerf_program());
        const ChildResult result = run_ranks(ranks, command);
        ASSERT_EQ(result.exit_code, 0) << result.log;
        EXPECT_TRUE(test::result_of_run(folder.file("ranks")) == expected);
        EXPECT_EQ(folder.names(), (std::vector<std::string>{"alone", "ranks"}));
    }
}

TEST(MpiRunsOfOrder2, FilesAreTheSameForAnyRanksAndWorkers) {
    const test::TemporaryFolder folder;
    std::map<std::string, std::string> expected;
    for (const auto& [ranks, workers] : {std::pair{1, 1}, {3, 2}}) {
        const ChildResult result = run_ranks(
            ranks, {test::kerf_program(), "mesh", test::asset_path("hollow_box"), "-o", folder.file("run"), "-n", "5",
                    "--workers", std::to_string(workers), "--order", "2", "--format", test::all_formats(2)});
        ASSERT_EQ(result.exit_code, 0) << result.log;
        if (ranks == 1) expected = test::result_of_run(folder.file("run"));
        EXPECT_TRUE(expected.contains("export/msh/mesh_5.msh"));
        EXPECT_TRUE(test::result_of_run(folder.file("run")) == expected);
    }
}

// Of the parts as they are, and joined.
TEST(MpiExports, FilesAreTheSameForAnyRanks) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(test::run_kerf({"mesh", test::asset_path("hollow_box"), "-o", folder.file("run"), "-n", "5"}).exit_code,
              0);
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--into", "3"}, {"--order", "2", "--into", "3"}}) {
        const int order = std::ranges::count(more, "--order") > 0 ? 2 : 1;
        std::map<std::string, std::string> expected;
        for (int ranks = 1; ranks <= 3; ++ranks) {
            SCOPED_TRACE(testing::Message() << ranks << " ranks, " << more.size());
            std::vector<std::string> command = {test::kerf_program(),     "export", folder.file("run"), "--format",
                                                test::all_formats(order), "-o",     folder.file("out")};
            command.insert(command.end(), more.begin(), more.end());
            const ChildResult result = run_ranks(ranks, command);
            ASSERT_EQ(result.exit_code, 0) << result.log;
            if (ranks == 1) expected = test::contents_below(folder.file("out"));
            EXPECT_GT(expected.size(), order == 1 ? 20u : 15u);
            EXPECT_TRUE(test::contents_below(folder.file("out")) == expected);
            std::filesystem::remove_all(folder.file("out"));
        }
    }
}

TEST_P(MpiRuns, TracesAreTheSameForAnyRanks) {
    const auto& [asset, parts] = GetParam();
    const test::TemporaryFolder folder;
    std::string expected;
    for (int ranks = 1; ranks <= 3; ++ranks) {
        SCOPED_TRACE(testing::Message() << ranks << " ranks");
        const std::string trace = folder.file("ranks_" + std::to_string(ranks));
        const ChildResult result =
            run_ranks(ranks, {test::kerf_program(), "decompose", test::asset_path(asset), "-o", folder.file("out"),
                              "-n", std::to_string(parts), "--trace", trace});
        ASSERT_EQ(result.exit_code, 0) << result.log;
        const std::string bytes = test::bytes_of_file(trace);
        if (ranks == 1) expected = bytes;
        EXPECT_FALSE(bytes.empty());
        EXPECT_TRUE(bytes == expected);
    }
}

// Ranks that hold regions of their own, and such as share one.
class MpiRegions : public testing::Test {
 protected:
    void expect_same_for_any_ranks_and_workers(const std::vector<std::string>& files, const char* parts,
                                               const char* contour) const {
        std::map<std::string, std::string> expected;
        std::string expected_trace;
        using Shared = std::pair<int, int>;  // ranks, workers of each
        for (const auto& [ranks, workers] : {Shared{1, 2}, {2, 1}, {3, 2}, {8, 1}}) {
            SCOPED_TRACE(testing::Message() << contour << ", " << ranks << " ranks");
            std::vector<std::string> command = {test::kerf_program(), "mesh"};
            command.insert(command.end(), files.begin(), files.end());
            for (const std::string& word :
                 {std::string("-o"), folder_.file("out"), std::string("-n"), std::string(parts),
                  std::string("--workers"), std::to_string(workers), std::string("--contour"), std::string(contour),
                  std::string("--trace"), folder_.file("trace")})
                command.push_back(word);
            const ChildResult result = run_ranks(ranks, command);
            ASSERT_EQ(result.exit_code, 0) << result.log;
            if (ranks == 1) expected = test::result_of_run(folder_.file("out"));
            if (ranks == 1) expected_trace = test::bytes_of_file(folder_.file("trace"));
            EXPECT_TRUE(test::result_of_run(folder_.file("out")) == expected);
            EXPECT_TRUE(test::bytes_of_file(folder_.file("trace")) == expected_trace);
        }
        EXPECT_EQ(test::run_kerf({"verify", folder_.file("out")}).exit_code, 0);
    }

    test::TemporaryFolder folder_;
};

TEST_F(MpiRegions, FilesAndTracesAreTheSameForAnyRanksAndWorkers) {
    const std::array<std::int32_t, 3> cubes = {7, 7, 7};
    test::write_tets(folder_.file("grains.mesh"), cubes, test::grains(cubes, 5, 2));
    for (const char* contour : {"min-cut", "straight"})
        expect_same_for_any_ranks_and_workers({folder_.file("grains.mesh")}, "13", contour);
}

// A file for each region.
TEST_F(MpiRegions, FilesAndTracesOfLinkedOnesAreTheSame) {
    const Complex complex = make_complex(test::linked_rings_in_box(1));
    std::vector<std::string> files;
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
        const SurfaceArrays surface = complex.arrays_of(region);
        files.push_back(folder_.file(complex.region_names()[static_cast<std::size_t>(region.value())] + ".off"));
        test::write_off(files.back(), surface.vertices, surface.facets);
    }
    expect_same_for_any_ranks_and_workers(files, "7", "min-cut");
}

// A straight cut splits facets of neighbours, too, which other ranks hold.
class MpiStraightCuts : public testing::Test {
 protected:
    void expect_same_for_any_ranks(const std::string& command, const std::string& input, std::int32_t parts) const {
        std::map<std::string, std::string> expected;
        for (int ranks = 1; ranks <= 3; ++ranks) {
            SCOPED_TRACE(testing::Message() << command << ", " << ranks << " ranks");
            const ChildResult result =
                run_ranks(ranks, {test::kerf_program(), command, input, "-o", folder_.file("out"), "-n",
                                  std::to_string(parts), "--surface", "split"});
            ASSERT_EQ(result.exit_code, 0) << result.log;
            const std::string report = test::bytes_of_file(folder_.file("out/report.json"));
            EXPECT_NE(report.find("\"rung\":\"straight\""), std::string::npos);
            auto files = test::contents(folder_.file("out/parts"));
            EXPECT_GE(files.size(), static_cast<std::size_t>(parts));
            files.merge(test::contents(folder_.file("out")));  // what joins them
            files.erase("report.json");
            if (ranks == 1) expected = files;
            EXPECT_TRUE(files == expected);
        }
    }
    std::string written(const Soup& soup) const {
        test::write_off(folder_.file("surface.off"), soup.vertices, soup.facets);
        return folder_.file("surface.off");
    }

 private:
    test::TemporaryFolder folder_;
};

TEST_F(MpiStraightCuts, PartFilesAreTheSameForAnyRanks) {
    expect_same_for_any_ranks("mesh", written(test::plate_with_hole(24)), 6);
    expect_same_for_any_ranks("mesh", written(test::porous_frame(2, 1)), 5);
}

TEST_F(MpiStraightCuts, PartFilesAreTheSameWhereCutsAlongEdgesCameBefore) {
    expect_same_for_any_ranks("decompose", test::asset_path("hollow_box"), 200);
}

// Ranks that share nothing but the output folder: each pair has temporary files and a working directory of its own.
TEST(MpiHosts, ShareTheOutputFolderOnly) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> command = {"mesh", test::asset_path("hollow_box"), "-o", folder.file("out"), "-n",
                                              "5"};
    ASSERT_EQ(test::run_kerf(command).exit_code, 0);
    const auto expected = test::contents(folder.file("out/parts"));
    std::ofstream(folder.file("hosts")) << "localhost slots=4\n";
    std::vector<std::string> arguments = {
        "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", KERF_MPIRUN, "--oversubscribe", "--hostfile",
        folder.file("hosts")};
    for (const std::string host : {"one", "two"}) {
        std::filesystem::create_directory(folder.file(host));
        for (const std::string& argument :
             {std::string("-n"), std::string("2"), std::string("-wdir"), folder.file(host), std::string("/usr/bin/env"),
              "TMPDIR=" + folder.file(host), test::kerf_program()})
            arguments.push_back(argument);
        arguments.insert(arguments.end(), command.begin(), command.end());
        if (host == "one") arguments.push_back(":");
    }
    const ChildResult result = test::run_program("/usr/bin/env", arguments);
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(result.log.find("4 ranks"), std::string::npos) << result.log;
    EXPECT_TRUE(test::contents(folder.file("out/parts")) == expected);
}

class MpiInterruptions : public testing::Test {
 protected:
    std::vector<std::string> command(const std::string& output) const {
        return {"mesh", test::asset_path("cube"), "-o",   folder_.file(output), "-n",
                "9",    "--max-volume",           "1e-6", "--workers",          "1"};
    }
    void expect_same_when_resumed(int ranks) const {
        EXPECT_FALSE(std::filesystem::exists(folder_.file("out")));
        const ChildResult result = run_ranks(ranks, {test::kerf_program(), "mesh", "--resume", folder_.file("out")});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        EXPECT_NE(result.log.find("were finished by an interrupted run"), std::string::npos) << result.log;
        ASSERT_EQ(test::run_kerf(command("alone")).exit_code, 0);
        EXPECT_TRUE(test::contents(folder_.file("out/parts")) == test::contents(folder_.file("alone/parts")));
    }
    // Sends the signal to the last of three ranks when parts are finished and under way. `code`: of mpirun.
    void interrupt(int signal, bool ranks_end_by_themselves) const {
        std::vector<std::string> arguments = mpirun_arguments(3);
        arguments.push_back(test::kerf_program());
        for (const std::string& argument : command("out")) arguments.push_back(argument);
        test::StartedRun run("/usr/bin/env", arguments);
        ASSERT_TRUE(test::await([&] { return test::finished_parts(folder_.file("out")) >= 2; }));
        ASSERT_GT(run.stop_worker(), 0);
        const std::vector<pid_t> ranks = test::descendants_of(run.process(), "kerf"), workers = run.workers();
        ASSERT_EQ(ranks.size(), 3u);
        ASSERT_EQ(::kill(ranks.back(), signal), 0);
        for (const pid_t worker : workers) EXPECT_TRUE(test::await([&] { return test::has_ended(worker); }));
        const ChildResult result = run.wait();
        EXPECT_NE(result.exit_code, 0);
        if (ranks_end_by_themselves) {
            EXPECT_EQ(result.exit_code, 130) << result.log;
            EXPECT_EQ(count(result.log, "kerf: "), 1) << result.log;
        }
        for (const pid_t rank : ranks) EXPECT_TRUE(test::await([&] { return test::has_ended(rank); }));
    }
    test::TemporaryFolder folder_;
};

TEST_F(MpiInterruptions, ASignalToAnyRankEndsAll) {
    ASSERT_NO_FATAL_FAILURE(interrupt(SIGTERM, true));
    expect_same_when_resumed(2);
}

TEST_F(MpiInterruptions, AKilledRankLeavesNoProcessAndLosesOnlyItsParts) {
    ASSERT_NO_FATAL_FAILURE(interrupt(SIGKILL, false));
    expect_same_when_resumed(4);
}

// The second rank has the libraries of another host.
class MpiUnlikeHosts : public testing::Test {
 protected:
    // The shell swallows the code of each rank, so that mpirun neither stops the others nor adds words of its own.
    ChildResult run_with(const std::string& library, const std::vector<std::string>& command) const {
        const std::string script = "'" + test::kerf_program() + "' \"$@\"; echo \"code=$?;\"";
        std::vector<std::string> arguments = mpirun_arguments(1);
        const auto add = [&](const std::vector<std::string>& words) {
            arguments.insert(arguments.end(), words.begin(), words.end());
        };
        add({"/bin/sh", "-c", script, "sh"});
        add(command);
        add({":", "-n", "1", "/usr/bin/env", "LD_PRELOAD=" + library,
             "ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0", "/bin/sh", "-c", script, "sh"});
        add(command);
        return test::run_program("/usr/bin/env", arguments);
    }
    test::TemporaryFolder folder_;
};

// Each cut is made once, so that both sides of it are the same.
TEST_F(MpiUnlikeHosts, PartsOfUnlikeCutsFit) {
    const ChildResult result =
        run_with(KERF_UNLIKE_ANGLES, {"mesh", test::asset_path("hollow_box"), "-o", folder_.file("out"), "-n", "4"});
    EXPECT_EQ(count(test::output_of(result), "code=0;"), 2) << test::output_of(result) << result.log;
    EXPECT_EQ(test::run_kerf({"verify", folder_.file("out")}).exit_code, 0);
}

struct Failure {
    const char* name;
    std::string input, output;
    int exit_code;
    std::string words;  // of the message
};

TEST(MpiErrors, EveryRankEndsWithTheSameCodeAndOneSpeaks) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.file("empty.stl")).flush();
    const std::vector<Failure> failures = {
        {"missing file", folder.file("missing.stl"), folder.file("out"), 7, "cannot be read"},
        {"empty file", folder.file("empty.stl"), folder.file("out"), 3, "is empty"},
        {"folder below a file", test::asset_path("cube"), folder.file("empty.stl/out"), 7, "Cannot create"}};
    for (const Failure& failure : failures) {
        SCOPED_TRACE(failure.name);
        // The shell swallows the code of each rank, so that mpirun neither stops the others nor adds words of its own.
        const std::string script = "'" + test::kerf_program() + "' mesh '" + failure.input + "' -o '" + failure.output +
                                   "' -n 3; echo \"code=$?;\"";
        const ChildResult result = run_ranks(3, {"/bin/sh", "-c", script});
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_EQ(count(test::output_of(result), "code=" + std::to_string(failure.exit_code) + ";"), 3)
            << test::output_of(result);
        EXPECT_EQ(count(result.log, "kerf: "), 1) << result.log;
        EXPECT_NE(result.log.find(failure.words), std::string::npos) << result.log;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"empty.stl"});
    }
}

// Wherever that happens: also while others wait for the first rank, which needs the most.
TEST(MpiMemory, OfOneRankEndsAllOfThem) {
    const test::TemporaryFolder folder;
    const std::string decompose =
        fmt::format("'{}' decompose '{}' -o '{}' -n 32 --workers 1 --size 0.2 --surface keep", test::kerf_program(),
                    test::asset_path("bearing_cap_52k"), folder.file("out"));
    for (const int megabytes : {220, 250, 280}) {
        SCOPED_TRACE(megabytes);
        const std::string script =
            fmt::format("[ $OMPI_COMM_WORLD_RANK = 1 ] || ulimit -v {}000; exec {}", megabytes, decompose);
        const ChildResult result = run_ranks(2, {"/bin/sh", "-c", script});
        EXPECT_EQ(result.exit_code, 5) << result.log;
        EXPECT_EQ(count(result.log, "kerf: Out of memory."), 1) << result.log;
    }
}

TEST(MpiErrors, EventsThatCannotBeWrittenEndEveryRank) {
    const test::TemporaryFolder folder;
    const ChildResult result = run_ranks(3, {test::kerf_program(), "mesh", test::asset_path("cube"), "-o",
                                             folder.file("out"), "-n", "3", "--events", "/dev/full"});
    EXPECT_EQ(result.exit_code, 7) << result.log;
    EXPECT_EQ(count(result.log, "kerf: "), 1) << result.log;
}

TEST(MpiErrors, TraceThatCannotBeWrittenEndsEveryRank) {
    const test::TemporaryFolder folder;
    const ChildResult result = run_ranks(3, {test::kerf_program(), "decompose", test::asset_path("cube"), "-o",
                                             folder.file("out"), "-n", "3", "--trace", folder.file("no/cube.trace")});
    EXPECT_EQ(result.exit_code, 7) << result.log;
    EXPECT_EQ(count(result.log, "kerf: "), 1) << result.log;
    EXPECT_EQ(folder.names(), std::vector<std::string>());
}

TEST(MpiErrors, ALibraryWithoutThreadsIsRefused) {
    const test::TemporaryFolder folder;
    const ChildResult result =
        run_ranks(2, {"/usr/bin/env", std::string("LD_PRELOAD=") + KERF_SINGLE_THREADED_MPI,
                      "ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0", test::kerf_program(), "mesh",
                      test::asset_path("cube"), "-o", folder.file("out"), "-n", "2"});
    EXPECT_EQ(result.exit_code, 1) << result.log;
    EXPECT_EQ(count(result.log, "kerf: The MPI library"), 1) << result.log;
    EXPECT_TRUE(folder.names().empty());
}

TEST(MpiErrors, UsageErrorsNeedNoAgreement) {
    EXPECT_EQ(
        run_ranks(2, {test::kerf_program(), "mesh", test::asset_path("cube"), "-o", "unused", "-n", "0"}).exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists("unused"));
}

}  // namespace
}  // namespace kerf
