// An installed tree works by itself: from any folder, moved to another place, for users and for programs of others.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/file_contents.h"
#ifdef KERF_MPIRUN
#include "support/mpirun.h"
#endif
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

// Installed once for all tests, and moved then.
class Installed : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        const ChildResult installed =
            test::run_program(KERF_CMAKE, {"--install", test::build_folder(), "--prefix", file("first place")});
        ASSERT_EQ(installed.exit_code, 0) << installed.log;
        fs::rename(file("first place"), file("a copy"));
        fs::create_directory(file("elsewhere"));
        fs::copy_file(test::asset_path("cube"), file("elsewhere/cube.stl"));
    }
    static void TearDownTestSuite() { folder_.reset(); }

    static std::string file(const std::string& name) { return folder_->file(name); }

    // OSMesa keeps what LLVM has compiled.
    static ChildResult kerf_elsewhere(const std::string& arguments, const std::string& tree = "a copy") {
        return test::run_program("/bin/sh", {"-c", "cd '" + file("elsewhere") + "' && ASAN_OPTIONS=detect_leaks=0 '" +
                                                       file(tree + "/bin/kerf") + "' " + arguments});
    }

    static inline std::unique_ptr<test::TemporaryFolder> folder_;
};

TEST_F(Installed, FindsItsWorker) {
    const ChildResult meshed = kerf_elsewhere("mesh cube.stl -o out -n 2 --workers 1 -q");
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    EXPECT_EQ(kerf_elsewhere("verify out").exit_code, 0);
    fs::create_directories(file("alone/bin"));
    fs::copy_file(file("a copy/bin/kerf"), file("alone/bin/kerf"));
    EXPECT_NE(kerf_elsewhere("mesh cube.stl -o again -n 2 --workers 1 -q", "alone").exit_code, 0)
        << "whose worker was it?";
}

#if KERF_HAS_VIEWER
TEST_F(Installed, FindsItsViewerAndShaders) {
    const ChildResult drawn = kerf_elsewhere("screenshot cube.stl --resolution 64x64 -o cube.png");
    EXPECT_EQ(drawn.exit_code, 0) << drawn.log;
    EXPECT_TRUE(fs::exists(file("elsewhere/cube.png")));
}

TEST_F(Installed, OpensItsWindow) {
    const ChildResult shown = test::run_program(
        "/usr/bin/env", {"ASAN_OPTIONS=detect_leaks=0", test::source_folder() + "/tests/install/window_opens.sh",
                         file("a copy/bin/kerf"), file("")});
    EXPECT_EQ(shown.exit_code, 0) << shown.log;
}
#endif

#if KERF_HAS_SOLVER
TEST_F(Installed, Solves) {
    const std::string examples = "'" + file("a copy/share/kerf/examples/");
    const ChildResult solved = kerf_elsewhere("solve " + examples + "l_bracket.stl' --case " + examples +
                                              "l_bracket_case.toml' -o bracket -n 2 --workers 1 -q");
    EXPECT_EQ(solved.exit_code, 0) << solved.log;
    EXPECT_TRUE(fs::exists(file("elsewhere/bracket/solution/report.json")));
}
#endif

#ifdef KERF_PYTHON_FOLDER
TEST_F(Installed, HasAPackageOfPython) {
    const ChildResult meshed = test::run_program(
        "/usr/bin/env",
        {"-i", "PYTHONPATH=" + file("a copy/" KERF_PYTHON_FOLDER), KERF_PYTHON, "-B", "-c",
         "import kerf; print(kerf.__file__, len(kerf.mesh('" + file("elsewhere/cube.stl") + "').points))"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    EXPECT_EQ(test::output_of(meshed).find(file("a copy/" KERF_PYTHON_FOLDER "/kerf/__init__.py ")), 0u)
        << test::output_of(meshed);
}
#endif

TEST_F(Installed, HasManualAndCompletionForEveryProgram) {
    std::set<std::string> pages;
    for (const auto& [name, text] : test::contents(file("a copy/share/man/man1"))) {
        EXPECT_TRUE(text.starts_with(".TH KERF")) << name;
        pages.insert(name);
    }
    for (const char* command :
         {"", "-check", "-decompose", "-export", "-merge", "-mesh", "-quality", "-remesh", "-verify"})
        EXPECT_TRUE(pages.contains(std::string("kerf") + command + ".1")) << command;
    EXPECT_EQ(pages.contains("kerf-view.1"), KERF_HAS_VIEWER == 1);
    EXPECT_EQ(pages.contains("kerf-screenshot.1"), KERF_HAS_VIEWER == 1);
    EXPECT_EQ(pages.contains("kerf-solve.1"), KERF_HAS_SOLVER == 1);
    for (const char* script :
         {"bash-completion/completions/kerf", "zsh/site-functions/_kerf", "fish/vendor_completions.d/kerf.fish"})
        EXPECT_NE(test::bytes_of_file(file("a copy/share/") + script).find("radius-edge"), std::string::npos) << script;
}

// Flags of our own builds are nothing for others, and no file knows where it was made or first lay.
TEST_F(Installed, PackageNamesNoPlaceAndNoWarnings) {
    const std::map<std::string, std::string> files = test::contents(file("a copy/lib/cmake/Kerf"));
    EXPECT_TRUE(files.contains("KerfConfig.cmake"));
    for (const auto& [name, text] : files)
        for (const std::string& word :
             {test::source_folder() + "/", test::build_folder() + "/", file(""), std::string("-Werror")})
            EXPECT_EQ(text.find(word), std::string::npos) << name << " has " << word;
}

// Builds a program of tests/install outside of the tree, as a release, and returns its path; empty if that fails.
std::string build_consumer(const std::string& name, const std::string& tree, const std::string& folder) {
    const ChildResult configured =
        test::run_program(KERF_CMAKE, {"-S", test::source_folder() + "/tests/install/" + name, "-B", folder, "-G",
                                       KERF_GENERATOR, "-DCMAKE_PREFIX_PATH=" + tree,
                                       "-DCMAKE_CXX_COMPILER=" KERF_COMPILER, "-DCMAKE_BUILD_TYPE=Release"});
    const ChildResult built = test::run_program(KERF_CMAKE, {"--build", folder});
    if (configured.exit_code == 0 && built.exit_code == 0) return folder + "/" + name;
    ADD_FAILURE() << configured.log << test::output_of(built) << built.log;
    return "";
}

// The program that docs/developing.md shows.
TEST_F(Installed, LibraryServesProgramsOfOthers) {
    EXPECT_NE(test::bytes_of_file(test::source_folder() + "/docs/developing.md")
                  .find(test::bytes_of_file(test::source_folder() + "/tests/install/consumer/main.cpp")),
              std::string::npos);
    const ChildResult run = test::run_program(build_consumer("consumer", file("a copy"), file("consumer")), {});
    EXPECT_EQ(run.exit_code, 0) << run.log;
    const std::string output = test::output_of(run);
    EXPECT_GT(std::atoi(output.c_str()), 500) << output << run.log;
    for (const char* words : {" cells, volume 1\n", "facet 7: facets[7] is (1, 6, 99), but the 8 vertices"})
        EXPECT_NE(output.find(words), std::string::npos) << output;
}

#ifdef KERF_MPIRUN
// Two ranks of three have a communicator of their own, the third meshes alone: the same parts.
TEST_F(Installed, LibraryServesRanksOfOthers) {
    const std::string program = build_consumer("mpi_consumer", file("a copy"), file("mpi consumer"));
    fs::create_directory(file("runs"));
    const ChildResult run = test::run_ranks(3, {program, file("elsewhere/cube.stl"), file("runs")});
    EXPECT_EQ(run.exit_code, 0) << run.log;
    EXPECT_GT(std::atoi(test::output_of(run).c_str()), 10) << test::output_of(run) << run.log;
    EXPECT_TRUE(test::contents_below(file("runs/last/parts")) == test::contents_below(file("runs/others/parts")));
}
#endif

}  // namespace
}  // namespace kerf
