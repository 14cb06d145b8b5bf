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
        Array<RegionIndex, RegionPlace> places;
        while (places.size() < 12) {
            const Box box = random_box(random, Box(Vec3(-5, 3, 0), Vec3(5, 20, 2)));
            bool is_free = true;
            for (const RegionPlace& other : places) is_free &= !overlap(box, other.box);
            if (is_free) places.push_back({box});
        }
        const Array<RegionIndex, Vec3> moves = moves_apart(places);
        for (const double explode : {0.1, 0.5, 1.})
            for (const RegionIndex a : places.ids())
                for (const RegionIndex b : ids<RegionIndex>(a.value()))
                    EXPECT_FALSE(
                        overlap(moved(places[a].box, explode * moves[a]), moved(places[b].box, explode * moves[b])))
                        << "seed " << seed << ": " << a.value() << " and " << b.value();
    }
}

// Shells in shells, numbered in any order, each beside others that hold nothing.
TEST(RegionPlaces, WhatIsHeldComesOut) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        test::SeededNumbers random(seed);
        Array<RegionIndex, RegionPlace> places = {{Box(Vec3(0, 0, 0), Vec3(9, 7, 8))}};
        for (std::int32_t i = 1; i < 5; ++i)
            places.push_back({random_box(random, places.back().box), RegionIndex(i - 1)});
        std::reverse(places.begin(), places.end());
        for (RegionPlace& place : places)
            if (place.holder.is_valid()) place.holder = RegionIndex(4 - place.holder.value());
        const Array<RegionIndex, Vec3> moves = moves_apart(places);
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
        return moves_apart({{bone}, {Box(low, high), RegionIndex(0)}})[1];
    };
    EXPECT_EQ(move_of({1, 1, 2}, {3, 3, 6}), Vec3(0, 0, 6));
    EXPECT_EQ(move_of({0, 1, 2}, {3, 3, 5}), Vec3(-4, 0, 0));
    EXPECT_EQ(move_of({1, 1, 1}, {3, 3, 5}), Vec3(0, 0, 6)) << "upwards, where all walls are as thick";
    EXPECT_TRUE(moves_apart({}).empty());
}

}  // namespace
}  // namespace kerf::view
