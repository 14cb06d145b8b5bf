// An installed copy works by itself, from any folder.
#include <filesystem>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class Installed : public testing::Test {
 protected:
    void SetUp() override {
        const ChildResult installed =
            test::run_program(KERF_CMAKE, {"--install", KERF_BUILD, "--prefix", file("copy")});
        ASSERT_EQ(installed.exit_code, 0) << installed.log;
        fs::create_directory(file("elsewhere"));
        fs::copy_file(test::asset_path("cube"), file("elsewhere/cube.stl"));
    }
    std::string file(const std::string& name) const { return folder_.file(name); }

    // OSMesa keeps what LLVM has compiled.
    ChildResult kerf_elsewhere(const std::string& arguments) const {
        return test::run_program("/bin/sh", {"-c", "cd '" + file("elsewhere") + "' && ASAN_OPTIONS=detect_leaks=0 '" +
                                                       file("copy/bin/kerf") + "' " + arguments});
    }

    test::TemporaryFolder folder_;
};

TEST_F(Installed, CopyFindsItsWorker) {
    const ChildResult meshed = kerf_elsewhere("mesh cube.stl -o out -n 2 --workers 1 -q");
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    EXPECT_EQ(kerf_elsewhere("verify out").exit_code, 0);
    fs::remove(file("copy/bin/kerf-worker"));
    EXPECT_NE(kerf_elsewhere("mesh cube.stl -o again -n 2 --workers 1 -q").exit_code, 0) << "whose worker was it?";
}

#if KERF_HAS_VIEWER
TEST_F(Installed, CopyFindsItsViewerAndShaders) {
    const ChildResult drawn = kerf_elsewhere("screenshot cube.stl --size 64x64 -o cube.png");
    EXPECT_EQ(drawn.exit_code, 0) << drawn.log;
    EXPECT_TRUE(fs::exists(file("elsewhere/cube.png")));
}
#endif

}  // namespace
}  // namespace kerf
