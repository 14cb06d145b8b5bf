#include "surface/diagnosis/inside/poor_shapes.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/geometry/angles.h"

namespace kerf {
namespace {

std::vector<Triangle> one_facet_each(std::size_t count) {
    std::vector<Triangle> facets;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(count); ++f) facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    return facets;
}

PoorShapes find_all(const std::vector<Vec3>& vertices, double limit) {
    const std::vector<Triangle> facets = one_facet_each(vertices.size() / 3);
    const PoorShapeSearch search(vertices, facets, limit);
    PoorShapes found;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(facets.size()); ++f) search.look_at(f, found);
    return found;
}

// Triangles of any shape and size: apices far beyond, between, or next to the ends of an edge.
std::vector<Vec3> random_corners(std::mt19937& random, double largest, bool all_sizes) {
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    const auto direction = [&] { return Vec3(uniform(), uniform(), uniform()); };
    std::vector<Vec3> vertices;
    for (int f = 0; f < 4000; ++f) {
        const double size = largest * std::pow(10, all_sizes ? 75 * uniform() - 75 : 4 * uniform() - 4);
        const Vec3 a = f % 2 ? Vec3(Vec3::Zero()) : Vec3(largest * direction());
        const Vec3 b = a + size * direction();
        const Vec3 off = size * std::pow(10, 5 * uniform() - 4) * direction();
        vertices.insert(vertices.end(), {a, b, a + uniform() * 2 * (b - a) + off});
    }
    return vertices;
}

TEST(PoorShapes, NeedlesAreThoseOfTheirAngles) {
    for (unsigned seed = 1; seed <= 8; ++seed)
        for (const double limit : {0.0, 1e-6, 0.01, 1.0, 20.0, 59.0, 79.9, 90.0}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", below " << limit);
            std::mt19937 random(seed);
            const std::vector<Vec3> p = random_corners(random, seed % 2 ? 1 : 1e50, seed % 4 < 2);
            std::vector<std::pair<std::int32_t, double>> expected, found;
            for (std::size_t f = 0; f < p.size() / 3; ++f) {
                const double angle = smallest_angle_degrees({p[3 * f], p[3 * f + 1], p[3 * f + 2]});
                if (angle < limit) expected.emplace_back(f, angle);
            }
            for (const PoorShape& needle : find_all(p, limit).needles) found.emplace_back(needle.facet, needle.measure);
            EXPECT_EQ(found, expected);
            if (limit >= 1) {
                EXPECT_GT(found.size(), 10U);
            }
        }
}

TEST(PoorShapes, AngleAtTheLimitIsNoNeedle) {
    std::mt19937 random(3);
    const std::vector<Vec3> all = random_corners(random, 1, false);
    for (std::size_t f = 0; f < 300; ++f) {
        const std::vector<Vec3> p(all.begin() + 3 * f, all.begin() + 3 * f + 3);
        const double angle = smallest_angle_degrees({p[0], p[1], p[2]});
        EXPECT_TRUE(find_all(p, angle).needles.empty());
        EXPECT_EQ(find_all(p, std::nextafter(angle, 180)).needles.size(), 1U) << angle;
    }
}

TEST(PoorShapes, ShortEdgesAreThoseOfTheirLengths) {
    constexpr double limit = 64 * std::numeric_limits<double>::epsilon();
    for (unsigned seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const double largest = std::pow(10, 20 * static_cast<double>(seed) - 100);
        std::vector<Vec3> p = random_corners(random, largest, seed % 2 == 0);
        for (std::size_t v = 0; v + 2 < p.size(); v += 3 + 3 * (random() % 8))
            for (int x = 0; x < 3; ++x) p[v + 1][x] = p[v][x] * (1 + (static_cast<int>(random() % 40) - 20) * 1e-15);
        std::vector<std::tuple<std::int32_t, std::int32_t, double>> expected, found;
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(p.size() / 3); ++f)
            for (std::int32_t i = 0; i < 2; ++i) {  // from its last corner to the first one it is another facet's
                const Vec3 &a = p[3 * f + i], &b = p[3 * f + i + 1];
                const double length = (b - a).norm();
                if (length < limit * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()))
                    expected.emplace_back(f, i, length);
            }
        for (const PoorShape& edge : find_all(p, 0).short_edges)
            found.emplace_back(edge.facet, edge.edge, edge.measure);
        EXPECT_EQ(found, expected);
        EXPECT_GT(found.size(), 50U);
    }
}

}  // namespace
}  // namespace kerf
