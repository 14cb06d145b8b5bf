// Where regions go when they are pulled apart.
#include <gtest/gtest.h>

#include "support/seeded_numbers.h"
#include "viewer/model/inside/region_places.h"

namespace kerf::view {
namespace {

using Box = Eigen::AlignedBox3d;

bool overlap(const Box& a, const Box& b) {
    const Box common = a.intersection(b);
    return (common.sizes().array() > 1e-9).all();
}

Box moved(const Box& box, const Vec3& by) { return Box(box.min() + by, box.max() + by); }

Box random_box(test::SeededNumbers& random, const Box& within) {
    Box box;
    for (int corner = 0; corner < 2; ++corner) {
        Vec3 p;
        for (int i = 0; i < 3; ++i) p[i] = random.between(within.min()[i], within.max()[i]);
        box.extend(p);
    }
    return box;
}

TEST(RegionPlaces, BodiesSideBySideStaySo) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        test::SeededNumbers random(seed);
        std::vector<RegionPlace> places;
        while (places.size() < 12) {
            const Box box = random_box(random, Box(Vec3(-5, 3, 0), Vec3(5, 20, 2)));
            bool is_free = true;
            for (const RegionPlace& other : places) is_free &= !overlap(box, other.box);
            if (is_free) places.push_back({box, -1});
        }
        const std::vector<Vec3> moves = moves_apart(places);
        for (const double explode : {0.1, 0.5, 1.})
            for (std::size_t a = 0; a < places.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    EXPECT_FALSE(
                        overlap(moved(places[a].box, explode * moves[a]), moved(places[b].box, explode * moves[b])))
                        << "seed " << seed << ": " << a << " and " << b;
    }
}

// Shells in shells, numbered in any order, each beside others that hold nothing.
TEST(RegionPlaces, WhatIsHeldComesOut) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        test::SeededNumbers random(seed);
        std::vector<RegionPlace> places = {{Box(Vec3(0, 0, 0), Vec3(9, 7, 8)), -1}};
        for (std::int32_t i = 1; i < 5; ++i) places.push_back({random_box(random, places.back().box), i - 1});
        std::reverse(places.begin(), places.end());
        for (RegionPlace& place : places)
            if (place.holder >= 0) place.holder = 4 - place.holder;
        const std::vector<Vec3> moves = moves_apart(places);
        EXPECT_EQ(moves.back(), Vec3::Zero()) << "the outermost one is where all are";
        for (std::size_t inner = 0; inner + 1 < places.size(); ++inner)
            EXPECT_FALSE(
                overlap(moved(places[inner].box, moves[inner]), moved(places[inner + 1].box, moves[inner + 1])))
                << "seed " << seed << ": " << inner;
    }
}

TEST(RegionPlaces, ThroughTheSideThatIsOpen) {
    const Box bone(Vec3(0, 0, 0), Vec3(4, 4, 6));
    const auto move_of = [&](const Vec3& low, const Vec3& high) {
        return moves_apart({{bone, -1}, {Box(low, high), 0}})[1];
    };
    EXPECT_EQ(move_of({1, 1, 2}, {3, 3, 6}), Vec3(0, 0, 6));
    EXPECT_EQ(move_of({0, 1, 2}, {3, 3, 5}), Vec3(-4, 0, 0));
    EXPECT_EQ(move_of({1, 1, 1}, {3, 3, 5}), Vec3(0, 0, 6)) << "upwards, where all walls are as thick";
    EXPECT_TRUE(moves_apart({}).empty());
}

}  // namespace
}  // namespace kerf::view
