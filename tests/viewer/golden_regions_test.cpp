// Pictures of a body of two regions, against those that were looked at and found good.
#include <gtest/gtest.h>

#include "support/assets.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"

namespace kerf::test {
namespace {

using namespace view;

TEST(TwoRegions, LookAsTheyShould) {
    Driver::Options options;
    options.width = 480;
    options.height = 360;
    Driver driver(options);
    driver.show_panels(false);
    driver.open_files({asset_path("bone"), asset_path("cement")});
    ViewState& state = driver.state();
    state.step = {Stage::tetrahedra, -1};
    state.coloring.by = ColorBy::region;
    state.visibility.glass_regions = {"bone"};
    EXPECT_TRUE(is_golden("regions-glass", driver));
    state.visibility.glass_regions.clear();
    state.explosion.amount = 1;
    state.explosion.regions = true;
    EXPECT_TRUE(is_golden("regions-apart", driver));
}

}  // namespace
}  // namespace kerf::test
