// Numbers of patches on their faces: where there is room for them, and only where they are seen.
#include <algorithm>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "support/program.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "viewer/driver.h"
#include "viewer/render/inside/widest_places.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

using namespace view;

TEST(WidestPlaces, AreInTheMiddleOfWhatIsSeen) {
    // A frame of -1, in it 7 with a hole, and a corner of 3.
    constexpr int width = 40, height = 30;
    std::vector<std::int32_t> image(width * height, -1);
    const auto fill = [&](int x0, int y0, int x1, int y1, std::int32_t number) {
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) image[static_cast<std::size_t>(y * width + x)] = number;
    };
    fill(2, 2, 38, 28, 7);
    fill(4, 4, 18, 26, -1);
    fill(33, 23, 38, 28, 3);
    const std::vector<NumberPlace> places = widest_places(image, width, height);
    ASSERT_EQ(places.size(), 2u);
    EXPECT_EQ(places[0].number, 3);
    EXPECT_EQ(std::tie(places[0].x, places[0].y, places[0].room), std::make_tuple(35, 25, 3));
    EXPECT_EQ(places[1].number, 7);
    EXPECT_EQ(places[1].room, 10) << "between the hole and the border";
    EXPECT_NEAR(places[1].x, 27, 1);
    EXPECT_NEAR(places[1].y, 14, 3);
    EXPECT_TRUE(widest_places(std::vector<std::int32_t>(6, -1), 3, 2).empty());
}

class NumberedBox : public testing::Test {
 protected:
    NumberedBox() {
        std::ofstream(folder_.file("box.stl")) << to_ascii_stl(box({0, 0, 0}, {3, 2, 1}, {12, 8, 4}));
        Driver::Options options;
        options.width = 480;
        options.height = 360;
        options.auto_run = false;
        driver_ = std::make_unique<Driver>(options);
        driver_->show_panels(false);
        driver_->open(folder_.file("box.stl"));
        driver_->state().coloring.by = ColorBy::patch;
        driver_->settle();
    }
    std::vector<std::int32_t> seen() {
        driver_->settle();
        std::vector<std::int32_t> all;
        for (const FaceNumber& face : driver_->app().facts().numbers) all.push_back(face.number);
        return all;
    }
    // The number of a patch by its outward normal, counted from 1.
    std::int32_t patch_towards(const Vec3& normal) {
        const auto surface = driver_->app().session().fetched().surface(root_node);
        for (std::size_t f = 0; f < surface->facets.size(); ++f) {
            const auto p = [&](std::size_t k) {
                return surface->vertices[static_cast<std::size_t>(surface->facets[f][k])];
            };
            if ((p(1) - p(0)).cross(p(2) - p(0)).normalized().dot(normal) > 0.99) return surface->patch[f] + 1;
        }
        return -1;
    }

    TemporaryFolder folder_;
    std::unique_ptr<Driver> driver_;
};

TEST_F(NumberedBox, FacesThatAreSeenHaveThem) {
    std::vector<std::int32_t> expected;  // the corner that is looked from
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) expected.push_back(patch_towards(normal));
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(seen(), expected);
    for (const std::int32_t number : expected) {
        const std::vector<LegendEntry>& entries = driver_->app().facts().legend.categories;
        const std::string& name = driver_->document().patch_names[static_cast<std::size_t>(number - 1)];
        const std::string text = fmt::format("{}: {}", number, name);
        EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [&](const LegendEntry& e) { return e.text == text; }))
            << text;
    }
    std::vector<std::string> words = words_on_screen();
    for (const std::int32_t number : expected)
        EXPECT_EQ(std::count(words.begin(), words.end(), std::to_string(number)), 1) << number;
    driver_->state().look.numbers = false;
    EXPECT_TRUE(seen().empty());
    driver_->state().look.numbers = true;
    driver_->state().coloring.by = ColorBy::part;
    EXPECT_TRUE(seen().empty());
    driver_->state().coloring.by = ColorBy::patch;
    EXPECT_EQ(seen(), expected);
    Camera camera = driver_->app().camera();
    look_from(camera, Vec3(0, 0, 1));
    driver_->state().camera = camera;
    EXPECT_EQ(seen(), std::vector<std::int32_t>{patch_towards(Vec3(0, 0, 1))});
}

}  // namespace
}  // namespace kerf::test
