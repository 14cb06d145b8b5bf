// Pictures without a display by each of the libraries that make contexts for them.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "viewer/render/offscreen.h"

namespace kerf::test {
namespace {

using view::OffscreenLibrary;

// The bytes of the picture.
std::string drawn_by(const std::string& library, const std::vector<std::string>& what) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = {"screenshot", "--context", library, "-o", folder.file("a.png")};
    arguments.insert(arguments.end(), what.begin(), what.end());
    const ChildResult result = run_kerf(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.log;
    return result.exit_code == 0 ? bytes_of_file(folder.file("a.png")) : "";
}

TEST(Offscreen, AllLibrariesDrawTheSameBytes) {
    if (view::offscreen_libraries().size() < 2) GTEST_SKIP() << "built with one library";
    const TemporaryFolder folder;
    const std::string run = folder.file("run"), untimed = test::asset_folder() + "/gallery/no_times.json";
    ASSERT_EQ(run_kerf({"mesh", asset_path("cylinder"), "-o", run, "-n", "4", "-q"}).exit_code, 0);
    const std::vector<std::vector<std::string>> pictures = {
        {run, "--node", "3", "--stage", "split", "--state", untimed, "--ui"},
        {run, "--stage", "tetrahedra", "--clip", "x=0.4", "--clip-style", "smooth"},
        {run, "--color", "min-dihedral", "--clip", "z=0.4", "--explode", "0.3", "--features", "--antialias", "2"}};
    std::string last;
    for (const std::vector<std::string>& picture : pictures) {
        const std::string by_osmesa = drawn_by("osmesa", picture);
        EXPECT_TRUE(by_osmesa == drawn_by("egl", picture)) << testing::PrintToString(picture);
        EXPECT_NE(by_osmesa, last);
        last = by_osmesa;
    }
}

TEST(Offscreen, WhatIsUnknownOrNotBuiltIsNamed) {
    const auto refused = [](const std::string& library) {
        const ChildResult result = run_kerf({"screenshot", asset_path("cube"), "-o", "a.png", "--context", library});
        EXPECT_EQ(result.exit_code, 2) << result.log;
        return result.log;
    };
    EXPECT_NE(refused("glx").find("osmesa or egl"), std::string::npos);
    const std::vector<OffscreenLibrary> built = view::offscreen_libraries();
    for (const OffscreenLibrary library : {OffscreenLibrary::osmesa, OffscreenLibrary::egl})
        if (std::find(built.begin(), built.end(), library) == built.end()) {
            EXPECT_NE(refused(name(library)).find("built without"), std::string::npos);
        }
}

}  // namespace
}  // namespace kerf::test
