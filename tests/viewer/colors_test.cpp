// Colours mean what the legend says, and people who see fewer of them can tell them apart.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "viewer/driver.h"
#include "viewer/model/timeline.h"
#include "viewer/scene/inside/colors.h"

namespace kerf::test {
namespace {

using namespace view;

using Matrix3 = Eigen::Matrix3d;

double linear(float channel) {
    return channel <= 0.04045f ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

// CIE L*a*b* of linear RGB, white D65.
Vec3 lab_of(const Vec3& rgb) {
    Matrix3 to_xyz;
    to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920, 0.9503041;
    const Vec3 xyz = (to_xyz * rgb).cwiseQuotient(Vec3(0.95047, 1, 1.08883));
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    return {116 * f(xyz.y()) - 16, 500 * (f(xyz.x()) - f(xyz.y())), 200 * (f(xyz.y()) - f(xyz.z()))};
}

// The least of the distances that people see with all three kinds of cones, or without those for long, middle or short
// waves (Machado, Oliveira, Fernandes 2009).
double least_distance(const Color& a, const Color& b) {
    std::array<Matrix3, 4> sights;
    sights[0].setIdentity();
    sights[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
    sights[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
    sights[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
    double least = 1e9;
    for (const Matrix3& sight : sights) {
        const auto seen = [&](const Color& c) {
            const Vec3 rgb = sight * Vec3(linear(c.r), linear(c.g), linear(c.b));
            return lab_of(rgb.cwiseMax(0).cwiseMin(1));
        };
        least = std::min(least, (seen(a) - seen(b)).norm());
    }
    return least;
}

// Twice what two colours need to be told apart at a glance when they do not touch.
constexpr double clear_difference = 18;

TEST(Colors, OfThingsThatAreSeenTogetherDiffer) {
    for (const Theme theme : {Theme::light, Theme::dark}) {
        const SceneColors c = scene_colors(theme);
        const std::vector<std::pair<const char*, std::vector<Color>>> together = {
            {"plane and edges", {c.plane, c.crossed, c.surface}},
            {"plane and contours", {c.plane, c.contour, c.projected, c.interface}},
            {"refused and failed", {c.plane, c.refused, c.error, c.surface}},
            {"selected in a refused try", {c.selection, c.refused, c.error}},
            {"axes", {c.axes[0], c.axes[1], c.axes[2], c.surface}}};
        for (const auto& [what, colors] : together)
            for (std::size_t i = 0; i < colors.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    EXPECT_GE(least_distance(colors[i], colors[j]), clear_difference) << what << " " << j << " " << i;
    }
}

double lightness(const Color& c) { return lab_of({linear(c.r), linear(c.g), linear(c.b)})[0]; }

TEST(Colors, OfTheWorstCellsAreNotTheDarkest) {
    for (const ColorBy color : {ColorBy::min_dihedral, ColorBy::radius_edge, ColorBy::aspect, ColorBy::shape}) {
        const std::vector<Color> scale = value_colors(color);
        const bool low_is_bad = color == ColorBy::min_dihedral || color == ColorBy::shape;
        const Color& worst = low_is_bad ? scale.front() : scale.back();
        const Color& best = low_is_bad ? scale.back() : scale.front();
        EXPECT_GT(lightness(worst), lightness(best) + 10) << name(color);
        EXPECT_GE(least_distance(worst, best), clear_difference) << name(color);
    }
}

bool is_near(const std::uint8_t* pixel, const Color& color, int tolerance) {
    const std::array<float, 3> wanted = {color.r, color.g, color.b};
    for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(pixel[k] - 255 * wanted[k]) > static_cast<float>(tolerance)) return false;
    return true;
}

// Left and above what the legend may take.
std::int64_t pixels_of(const Image& picture, const Rectangle& body, const Color& color) {
    std::int64_t count = 0;
    for (int y = 0; y < static_cast<int>(body.y + body.height); ++y)
        for (int x = 0; x < static_cast<int>(body.x + body.width); ++x)
            count += is_near(&picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                               static_cast<std::size_t>(x))],
                             color, 26);
    return count;
}

Driver::Options wide_pictures() {
    Driver::Options options;
    options.width = 800;
    options.height = 500;
    return options;
}

TEST(Legend, ColoursAreThoseOfThePicture) {
    Driver driver(wide_pictures());
    driver.show_panels(false);
    driver.open(asset_path("pipe_with_holes"));
    driver.state().look.edges = false;
    driver.state().explosion.amount = 0.5;
    std::set<std::string> explained;
    for (const NodeId node : {root_node, NodeId(2)})
        for (const Step& step : steps_of(driver.document(), node)) {
            driver.state().node = node;
            driver.state().step = step;
            const Image picture = driver.picture();
            const Rectangle body = body_area(driver.state(), driver.app().scene_area());
            for (const LegendEntry& entry : driver.app().facts().legend.categories) {
                explained.insert(entry.text);
                // Glass has the colour of what is behind it, too; the centre shines through the body.
                if (entry.color.a < 1 || entry.mark == LegendEntry::Mark::point) continue;
                EXPECT_GE(pixels_of(picture, body, entry.color), 20)
                    << "node " << node.value() << ", " << name(step) << ": " << entry.text;
            }
        }
    for (const char* text : {"long axis", "crossed edges", "contour", "projected", "triangulation", "interface",
                             "earlier interfaces", "node 2", "part 4"})
        EXPECT_TRUE(explained.contains(text)) << text;
}

TEST(Legend, ListsOnlyWhatIsThere) {
    Driver driver(wide_pictures());
    driver.show_panels(false);
    driver.open(asset_path("hollow_box"));
    driver.state().step = {Stage::tetrahedra, -1};
    const auto texts = [&] {
        driver.settle();
        std::vector<std::string> all;
        for (const LegendEntry& entry : driver.app().facts().legend.categories) all.push_back(entry.text);
        return all;
    };
    EXPECT_EQ(texts().size(), 4U);
    driver.state().visibility.set_hidden(NodeId(4), true);
    EXPECT_EQ(texts().size(), 3U);
    driver.state().visibility.hidden.clear();
    driver.state().clip = {true, ClipStyle::cells, driver.document().tree.find(root_node)->plane()->normal, 0.1, false};
    EXPECT_LT(texts().size(), 4U) << "parts beyond the plane";
    driver.state().clip.on = false;
    driver.state().coloring.by = ColorBy::kind;
    driver.state().explosion.amount = 0.5;
    EXPECT_EQ(texts(), (std::vector<std::string>{"inner cells", "cells at an interface"}));
    driver.state() = {};
    driver.state().step = {Stage::input, -1};
    EXPECT_TRUE(texts().empty()) << "nothing but the surface";
}

// Right of it, or below it where the scene is narrow, there is the background alone, between gizmo and legend.
TEST(Legend, BodyStandsBesideIt) {
    for (const auto& [width, height] : {std::pair(800, 500), {500, 600}}) {
        Driver::Options options;
        options.width = width;
        options.height = height;
        options.auto_run = false;
        Driver driver(options);
        driver.show_panels(false);
        for (const char* asset : {"pipe_with_holes", "knee_tibial", "cube"}) {
            driver.open(asset_path(asset));
            driver.state().look.scale_bar = false;
            const Image picture = driver.picture();
            const Rectangle body = body_area(driver.state(), driver.app().scene_area());
            const auto pixel = [&](int x, int y) {
                return &picture.rgb[3 * static_cast<std::size_t>(y * picture.width + x)];
            };
            const bool is_beside = body.width < static_cast<float>(width);
            ASSERT_TRUE(is_beside || body.height < static_cast<float>(height));
            const int from_x = is_beside ? static_cast<int>(body.width) : 0,
                      from_y = is_beside ? height / 3 : static_cast<int>(body.y + body.height);
            const int to_x = is_beside ? width : width / 3, to_y = is_beside ? height / 2 : height;
            std::int64_t drawn = 0;
            for (int y = from_y; y < to_y; ++y)
                for (int x = from_x; x < to_x; ++x)
                    for (int k = 0; k < 3; ++k) drawn += std::abs(pixel(x, y)[k] - pixel(0, y)[k]) > 2;
            EXPECT_EQ(drawn, 0) << asset << " " << width << " x " << height;
        }
    }
}

}  // namespace
}  // namespace kerf::test
