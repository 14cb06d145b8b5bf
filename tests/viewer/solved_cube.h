// A solution whose values are known, in the viewer.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/program.h"
#include "support/solved_run.h"
#include "support/temporary_folder.h"
#include "viewer/driver.h"

namespace kerf::test {

// The unit cube in two parts, with two cases and two modes.
class SolvedCube : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        ASSERT_EQ(
            run_kerf({"mesh", asset_path("cube"), "-o", folder_->file("out/mesh"), "-n", "2", "--size", "0.2", "-q"})
                .exit_code,
            0);
        write_solution(folder_->file("out/mesh"), folder_->file("out/solution"), "../mesh", {"slow", "fast"}, {20, 30});
        Driver::Options options;
        options.width = 480;
        options.height = 360;
        driver_ = std::make_unique<Driver>(options);
        driver_->show_panels(false);
        driver_->open(folder_->file("out"));
    }
    static void TearDownTestSuite() {
        driver_.reset();
        folder_.reset();
    }
    void SetUp() override {
        driver_->state() = {};
        driver_->state().step = {view::Stage::tetrahedra, -1};
    }
    // Corners of what is drawn, in coordinates of the file, with their values.
    template <class Visit>
    void for_corners(Visit visit) const {
        const view::BuiltScene& built = driver_->app().scene();
        for (const view::Layer& layer : built.scene.layers)
            for (const view::Corner& corner : layer.geometry->corners)
                visit(Vec3(corner.position[0], corner.position[1], corner.position[2]) / built.frame.scale +
                          built.frame.center,
                      corner.value);
    }
    static inline std::unique_ptr<TemporaryFolder> folder_;
    static inline std::unique_ptr<Driver> driver_;
};

}  // namespace kerf::test
