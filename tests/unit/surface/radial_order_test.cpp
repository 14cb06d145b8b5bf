#include "surface/soup/radial_order.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace kerf {
namespace {

struct Fan {
    std::vector<Vec3> vertices = {Vec3(0, 0, 0), Vec3(0, 0, 1)};
    std::vector<Triangle> facets;

    void add(const Vec3& apex, bool is_turned) {
        const auto v = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(apex);
        facets.push_back(is_turned ? Triangle{1, 0, v} : Triangle{v, 0, 1});
    }
    RadialOrder order() const {
        RadialOrder found;
        EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
            if (low == 0 && corners[0].high == 1) found = radial_order(vertices, facets, low, corners);
        });
        return found;
    }
};

TEST(RadialOrder, IsThatOfTheAngles) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        std::mt19937 random(seed);
        std::vector<int> sixteenths(16);
        for (int i = 0; i < 16; ++i) sixteenths[i] = i;
        std::shuffle(sixteenths.begin(), sixteenths.end(), random);
        sixteenths.resize(1 + random() % 16);
        Fan fan;
        for (const int i : sixteenths) {
            const double angle = i * std::numbers::pi / 8, radius = 1 + random() % 5;
            fan.add(Vec3(radius * std::cos(angle), radius * std::sin(angle), random() % 3), random() % 2);
        }
        const RadialOrder order = fan.order();
        ASSERT_EQ(order.defect, RadialDefect::none);
        ASSERT_EQ(order.corners.size(), sixteenths.size());
        EXPECT_EQ(order.corners[0] / 3, 0);
        int last = -1;
        for (const std::int32_t corner : order.corners) {
            const int ahead = (sixteenths[corner / 3] - sixteenths[0] + 16) % 16;
            EXPECT_GT(ahead, last) << "seed " << seed;
            last = ahead;
        }
    }
}

TEST(RadialOrder, BackOrFrontIsAhead) {
    Fan fan;
    fan.add(Vec3(1, 0, 0), false);
    fan.add(Vec3(0, 1, 0), true);
    // Facet 0, (1, 0, 0), (0, 0, 0), (0, 0, 1), has its normal to (0, 1, 0), where one comes turning from x to y.
    EXPECT_FALSE(has_back_ahead(fan.facets, 0, 1));
    EXPECT_TRUE(has_back_ahead(fan.facets, 0, 3));
}

TEST(RadialOrder, NamesWhatHasNoOrder) {
    Fan coincident;
    for (const Vec3& apex : {Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(2, 2, 5)}) coincident.add(apex, false);
    EXPECT_EQ(coincident.order().defect, RadialDefect::coincident);
    for (int place = 0; place < 3; ++place) {
        Fan flat;
        for (int i = 0; i < 3; ++i) flat.add(i == place ? Vec3(0, 0, 3) : Vec3(i, 1, 0), false);
        EXPECT_EQ(flat.order().defect, RadialDefect::no_area);
    }
}

}  // namespace
}  // namespace kerf
