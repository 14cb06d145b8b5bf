// kerf mesh -o FILE: one mesh in a file, and nothing else; and where results go that were given no place.
#include <sys/types.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class MeshFile : public testing::Test {
 protected:
    MeshFile() {
        const Soup soup = test::icosphere(2);
        test::write_off(ball_, soup.vertices, soup.facets);
    }
    ChildResult mesh(const std::string& output, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"mesh", ball_, "-o", folder_.file(output), "-n", "2"});
        return test::run_kerf(more);
    }
    // In the test's folder.
    ChildResult shell(const std::string& command) const {
        return test::run_program(
            "/bin/sh", {"-c", "K='" + test::kerf_program() + "'; cd '" + folder_.file("") + "' && " + command});
    }

    test::TemporaryFolder folder_;
    const std::string ball_ = folder_.file("ball.off");
};

TEST_F(MeshFile, IsWhatKerfMergeMakesOfTheRun) {
    ASSERT_EQ(mesh("run", {"-q"}).exit_code, 0);
    for (const char* ending : {".msh", ".mesh", ".vtu", ".inp", ".su2", ".node", ".vtk", ".med", ".cgns"}) {
        SCOPED_TRACE(ending);
        fs::create_directory(folder_.file("a"));
        fs::create_directory(folder_.file("b"));
        const std::string name = std::string("ball") + ending;
        const ChildResult result =  // which may write more than one file
            test::run_program(test::kerf_program(), {"mesh", ball_, "-o", folder_.file("a/" + name), "-n", "2"});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        EXPECT_NE(result.log.find("result      " + folder_.file("a/" + name)), std::string::npos) << result.log;
        ASSERT_EQ(
            test::run_program(test::kerf_program(), {"merge", folder_.file("run"), "-o", folder_.file("b/" + name)})
                .exit_code,
            0);
        const auto merged = test::contents(folder_.file("b"));
        EXPECT_TRUE(test::contents(folder_.file("a")) == merged) << "nothing else is left";
        EXPECT_TRUE(merged.contains(name));
        fs::remove_all(folder_.file("a"));
        fs::remove_all(folder_.file("b"));
    }
}

TEST_F(MeshFile, IsRefusedWhereItWouldLoseSomething) {
    const auto before = test::contents_below(folder_.file(""));
    const auto expect = [&](const ChildResult& result, int exit_code, const std::string& words) {
        EXPECT_EQ(result.exit_code, exit_code) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
    };
    expect(mesh("a.msh", {"--stl"}), 2, "--stl");
    expect(mesh("a.msh", {"--format", "openfoam"}), 2, "--format openfoam");
    expect(mesh("a.msh", {"--report", folder_.file("a.msh")}), 2, "--report and --output");
    expect(test::run_kerf({"decompose", ball_, "-o", folder_.file("a.msh"), "-n", "2"}), 2, "kerf decompose");
    EXPECT_TRUE(test::contents_below(folder_.file("")) == before);
    fs::create_directory(folder_.file("b.msh"));
    expect(mesh("b.msh"), 7, "b.msh, which cannot be written: Is a directory");
    ASSERT_EQ(mesh("in.mesh", {"-q"}).exit_code, 0);
    expect(test::run_kerf({"mesh", folder_.file("in.mesh"), "-o", folder_.file("in.mesh")}), 7, "is the input");
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"b.msh", "ball.off", "in.mesh"}));
}

// Half of the parts are meshed in time; the others, and the file, wait for the same command.
TEST_F(MeshFile, OfARunWithFailedPartsIsSaidToBeMissing) {
    const ChildResult failed = mesh("a.msh", {"--timeout", "0.001", "--attempts", "1"});
    ASSERT_EQ(failed.exit_code, 4) << failed.log;
    EXPECT_NE(failed.log.find("a.msh is not written"), std::string::npos) << failed.log;
    EXPECT_FALSE(fs::exists(folder_.file("a.msh")));
    const ChildResult resumed = test::run_kerf({"mesh", "--resume", folder_.file("a.msh"), "--timeout", "600"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.log;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.msh", "ball.off"}));
}

TEST_F(MeshFile, WithoutAPlaceTheResultIsNamedLikeTheInput) {
    fs::create_directory(folder_.file("parts"));
    fs::rename(ball_, folder_.file("parts/ball.x.off"));
    const ChildResult meshed = shell("$K mesh parts/ball.x.off -n 2");
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    EXPECT_NE(meshed.log.find("goes into ball.x-mesh; -o chooses another place"), std::string::npos) << meshed.log;
    EXPECT_EQ(shell("$K decompose parts/ball.x.off -n 2 -q").log, "");
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"ball.x-cut", "ball.x-mesh", "parts"}));
    EXPECT_TRUE(fs::exists(folder_.file("ball.x-mesh/report.json")));
}

}  // namespace
}  // namespace kerf
