// The laws of a size field: the minimum of its sources, of limited growth, the same bits wherever it travels.
#include "surface/size/size_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/core/cube_root.h"
#include "support/size_fields.h"
#include "surface/size/mean_edge.h"

namespace kerf {
namespace {

using namespace test;

constexpr unsigned seeds = 20;

TEST(CubeRoot, ScalesToTheLastBit) {
    EXPECT_EQ(cube_root(0), 0);
    for (double x = 1e-3; x < 1e3; x *= 1.37) {
        EXPECT_NEAR(cube_root(x) / std::cbrt(x), 1, 5e-16);
        for (const int k : {-300, -40, -7, -1, 1, 20, 300})
            EXPECT_EQ(cube_root(std::ldexp(x, 3 * k)), std::ldexp(cube_root(x), k)) << x << ' ' << k;
    }
}

TEST(SizeField, ConstantKeepsItsVolume) {
    for (const double volume : {0.1, 0.3, 1 / 3.0, 1e-12, 7e11}) {
        const SizeField field(volume);
        EXPECT_EQ(field.max_volume_at(Vec3(1, 2, 3)), volume);
        EXPECT_EQ(field.reference_volume(), volume);
        EXPECT_EQ(field.at(Vec3(1, 2, 3)), mean_edge_below(volume));
        EXPECT_EQ(field.coarser(8).reference_volume(), 8 * volume);
        EXPECT_TRUE(field.is_constant() && !field.is_empty());
    }
    EXPECT_TRUE(SizeField().is_empty());
    EXPECT_EQ(SizeField().at(Vec3::Zero()), INFINITY);
    EXPECT_EQ(SizeField().max_volume_at(Vec3::Zero()), INFINITY);
}

TEST(SizeField, IsTheMinimumOfItsSources) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(seed);
        const std::vector<SizeSources> sources = random_sources(seed);
        const double constant = seed % 2 ? 0.01 : 0;
        const SizeField field(constant, joined(sources));
        std::vector<SizeField> single = {SizeField(constant)};
        for (const SizeSources& one : sources) single.emplace_back(0, one);
        std::mt19937 random(seed);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = random_point(random, 3);
            double least = INFINITY;
            for (const SizeField& one : single) least = std::min(least, one.at(p));
            EXPECT_EQ(field.at(p), least);
            EXPECT_GE(field.at(p), field.smallest());
            const double bound = uniform(random, 0, 2);
            EXPECT_EQ(field.at(p, bound), std::min(bound, least));
            EXPECT_EQ(field.with_constant(0.3).with_constant(constant).at(p), least);
            EXPECT_NEAR(field.coarser(8).at(p), 2 * least, 1e-14 * least);
            EXPECT_NEAR(field.max_volume_at(p), largest_volume_for(least), 1e-14 * largest_volume_for(least));
            EXPECT_GE(field.max_volume_at(p), field.reference_volume() * (1 - 1e-14));
        }
    }
}

// A background's slope inside of a cell may be steeper.
TEST(SizeField, GrowsNoFasterThanAllowed) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(seed);
        std::vector<SizeSources> sources = random_sources(seed);
        sources.push_back(joined(sources));
        std::mt19937 random(seed);
        for (const SizeSources& one : sources) {
            const SizeField field(0, one);
            const double steep = one.backgrounds.empty() ? 1 : std::sqrt(3.0);
            for (int i = 0; i < 300; ++i) {
                const Vec3 p = random_point(random, 3);
                const Vec3 q = p + std::exp(uniform(random, -12, 1)) * random_point(random, 1);
                EXPECT_LE(std::abs(field.at(p) - field.at(q)), steep * field.growth() * (p - q).norm() + 1e-12);
            }
        }
    }
}

TEST(SizeField, TravelsBitForBit) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(seed);
        const SizeField field = SizeField(seed % 2 ? 0.3 : 0, joined(random_sources(seed))).coarser(seed % 3 ? 1 : 8);
        const Bytes bytes = to_bytes(field);
        const auto copy = from_bytes<SizeField>(bytes);
        EXPECT_TRUE(to_bytes(copy) == bytes);
        std::mt19937 random(seed);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = random_point(random, 3);
            EXPECT_EQ(copy.at(p), field.at(p));
        }
        EXPECT_EQ(copy.reference_volume(), field.reference_volume());
    }
    EXPECT_TRUE(from_bytes<SizeField>(to_bytes(SizeField())).is_empty());
}

// Triangles as a surface's own edges make them: many, with sizes that differ at their corners.
SizeSources sources_on_a_sphere(unsigned seed) {
    std::mt19937 random(seed);
    SizeSources sources;
    sources.growth = uniform(random, 0.1, 0.5);
    const Soup soup = icosphere(4);
    std::vector<double> size;
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) size.push_back(uniform(random, 0.05, 0.1));
    std::vector<SizedTriangle> triangles;
    for (const Triangle& t : soup.facets)
        triangles.emplace_back(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]],
                               std::array{size[t[0]], size[t[1]], size[t[2]]}, seed % 4 == 0 ? 0.05 : 0.0);
    sources.triangles = SizedTriangles(std::move(triangles));
    return sources;
}

TEST(SizeField, IsTheSameInABoxWithTheSourcesThatCountThere) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(seed);
        std::vector<SizeSources> sources = random_sources(seed);
        sources.push_back(joined(sources));
        sources.push_back(sources_on_a_sphere(seed));
        std::mt19937 random(seed);
        for (const SizeSources& one : sources) {
            const SizeField field = SizeField(seed % 3 ? 0 : 1e-3, one).coarser(seed % 2 ? 1 : 8);
            const Vec3 a = random_point(random, 1.5), b = random_point(random, 1.5);
            const Eigen::AlignedBox3d box(a.cwiseMin(b), a.cwiseMax(b));
            const SizeField there = field.within(box);
            EXPECT_LE(to_bytes(there).size(), to_bytes(field).size());
            EXPECT_EQ(there.is_constant(), field.is_constant());
            EXPECT_TRUE(to_bytes(field.within(box)) == to_bytes(there));
            for (int i = 0; i < 200; ++i) {
                const Vec3 t = (random_point(random, 1) + Vec3::Ones()) / 2;
                const Vec3 p = a + t.cwiseProduct(b - a);
                ASSERT_EQ(there.at(p), field.at(p));
                ASSERT_EQ(there.coarser(8).at(p), field.coarser(8).at(p));
            }
        }
    }
}

TEST(SizeField, LeavesMostOfItsSourcesOutInASmallBox) {
    const SizeField field(0, sources_on_a_sphere(1));
    const Eigen::AlignedBox3d box(Vec3(0.5, 0.5, 0.5), Vec3(0.7, 0.7, 0.7));
    EXPECT_LT(to_bytes(field.within(box)).size(), 0.1 * static_cast<double>(to_bytes(field).size()));
}

// A sphere of radius 1 with the size 0.1 up to a distance beyond all of it, in between triangles with the size 0.2.
SizeSources sources_that_reach_all(unsigned seed) {
    std::mt19937 random(seed);
    SizeSources sources;
    sources.growth = 0.3;
    const Soup soup = icosphere(4);
    std::vector<SizedTriangle> triangles;
    for (const Triangle& t : soup.facets) {
        const Vec3 &a = soup.vertices[t[0]], &b = soup.vertices[t[1]], &c = soup.vertices[t[2]];
        if (uniform(random, 0, 1) < 0.5)
            triangles.emplace_back(a, b, c, std::array{0.1, 0.1, 0.1}, seed % 2 ? 10.0 : 0.7);
        else
            triangles.emplace_back(a, b, c, std::array{0.2, 0.2, 0.2}, 0.0);
    }
    sources.triangles = SizedTriangles(std::move(triangles));
    return sources;
}

TEST(SizeField, IsTheSameInABoxWhereAllSourcesReach) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(seed);
        const SizeField field(0, sources_that_reach_all(seed));
        std::mt19937 random(seed);
        const Vec3 a = random_point(random, 1), b = random_point(random, 1);
        const Eigen::AlignedBox3d box(a.cwiseMin(b), a.cwiseMax(b));
        const SizeField there = field.within(box);
        for (int i = 0; i < 200; ++i) {
            const Vec3 t = (random_point(random, 1) + Vec3::Ones()) / 2;
            const Vec3 p = a + t.cwiseProduct(b - a);
            ASSERT_EQ(there.at(p), field.at(p));
        }
    }
    const SizeField all(0, sources_that_reach_all(1));
    const Eigen::AlignedBox3d box(Vec3(0.5, 0.5, 0.5), Vec3(0.7, 0.7, 0.7));
    EXPECT_LT(to_bytes(all.within(box)).size(), 0.1 * static_cast<double>(to_bytes(all).size()));
}

TEST(SizedTriangles, AskFewWhereAllReach) {
    const SizeSources sources = sources_that_reach_all(1);
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const Vec3 p = random_point(random, 1);
        std::int64_t asked = 0;
        double least = INFINITY;
        for (const SizedTriangle& t : sources.triangles.all()) least = std::min(least, t.size_at(p, sources.growth));
        EXPECT_EQ(sources.triangles.size_at(p, sources.growth, INFINITY, &asked), least);
        EXPECT_LE(asked, 8);
    }
}

TEST(SizeField, EverySourceShowsInItsBytes) {
    const std::vector<SizeSources> sources = random_sources(1);
    const Bytes all = to_bytes(SizeField(0.1, joined(sources)));
    EXPECT_TRUE(to_bytes(SizeField(0.2, joined(sources))) != all);
    for (std::size_t omitted = 0; omitted < sources.size(); ++omitted) {
        std::vector<SizeSources> fewer = sources;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(omitted));
        EXPECT_TRUE(to_bytes(SizeField(0.1, joined(fewer))) != all) << omitted;
    }
    SizeSources steeper = joined(sources);
    steeper.growth *= 2;
    EXPECT_TRUE(to_bytes(SizeField(0.1, steeper)) != all);
}

TEST(SizedSolids, KnowTheirDistance) {
    const SizedBox box{Vec3::Zero(), Vec3(1, 2, 3), 1};
    EXPECT_EQ(box.distance(Vec3(0.5, 1, 2)), 0);
    EXPECT_DOUBLE_EQ(box.distance(Vec3(4, 6, 3)), 5);
    const SizedSphere sphere{Vec3(1, 0, 0), 2, 1};
    EXPECT_EQ(sphere.distance(Vec3(2, 1, 0)), 0);
    EXPECT_DOUBLE_EQ(sphere.distance(Vec3(1, 0, -5)), 3);
    const SizedCylinder cylinder{Vec3(0, 0, 1), Vec3(0, 0, 3), 1, 1};
    EXPECT_EQ(cylinder.distance(Vec3(0.5, 0.5, 2)), 0);
    EXPECT_DOUBLE_EQ(cylinder.distance(Vec3(0, 3, 2)), 2);
    EXPECT_DOUBLE_EQ(cylinder.distance(Vec3(0, 4, 7)), 5);
    EXPECT_DOUBLE_EQ(cylinder.distance(Vec3(0, 0, 0)), 1);
}

TEST(SizedTriangles, AnswerAsIfAllWereAsked) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE(seed);
        const SizeSources sources = joined(random_sources(seed));
        std::mt19937 random(seed);
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = random_point(random, 4), direction = random_point(random, 1).normalized();
            double least = INFINITY, nearest = INFINITY;
            for (const SizedTriangle& t : sources.triangles.all()) {
                least = std::min(least, t.size_at(p, sources.growth));
                nearest = std::min(nearest, t.hit(p, direction));
            }
            EXPECT_EQ(sources.triangles.size_at(p, sources.growth, INFINITY), least);
            EXPECT_EQ(sources.triangles.first_hit(p, direction, [](const SizedTriangle&) { return true; }), nearest);
        }
    }
}

TEST(BackgroundSizes, AreLinearInTheirCellsAndGrowOutside) {
    const auto linear = [](const Vec3& p) { return 1 + 0.1 * p.x() - 0.05 * p.y() + 0.02 * p.z(); };
    const BackgroundSizes sizes(sized_grid(Vec3(-1, -1, -1), Vec3(1, 1, 1), 3, linear), 0.5);
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        const Vec3 p = random_point(random, 1);
        EXPECT_NEAR(sizes.size_at(p, 0.5, INFINITY), linear(p), 1e-12);
    }
    const double outside = sizes.size_at(Vec3(0.1, 0.2, 3), 0.5, INFINITY);
    EXPECT_LE(outside, linear(Vec3(0.1, 0.2, 1)) + 0.5 * 2);
    EXPECT_GE(outside, linear(Vec3(-1, 1, 1)) + 0.5 * 2);
}

TEST(BackgroundSizes, AreLoweredWhereTheyGrowTooFast) {
    const auto peak = [](const Vec3& p) { return p.norm() < 1e-9 ? 0.1 : 10.0; };
    const BackgroundSizes sizes(sized_grid(Vec3(-1, -1, -1), Vec3(1, 1, 1), 4, peak), 0.2);
    EXPECT_NEAR(sizes.size_at(Vec3::Zero(), 0.2, INFINITY), 0.1, 1e-12);
    EXPECT_NEAR(sizes.size_at(Vec3(1, 0, 0), 0.2, INFINITY), 0.3, 1e-12);
    EXPECT_NEAR(sizes.size_at(Vec3(1, 1, 1), 0.2, INFINITY), 0.1 + 0.2 * std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace kerf
