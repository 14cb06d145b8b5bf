// What is said to be near a surface is, wherever one looks, and what is clearly near is said to be.
#include "surface/diagnosis/nearness.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace kerf {
namespace {

using Corners = std::array<Vec3, 3>;

// The largest distance of points of a triangle, many on each edge, from a surface.
double largest_distance(const Corners& t, const TriangleTree& surface) {
    constexpr int n = 20;
    double largest = 0;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j) {
            const Vec3 p = (i * t[0] + j * t[1] + (n - i - j) * t[2]) / n;
            largest = std::max(largest, std::sqrt(surface.closest(p).squared_distance));
        }
    return largest;
}

bool is_near(Nearness& nearness, const Corners& t, double limit, std::int32_t hint) {
    return nearness.holds(
        t, limit, [&](std::int32_t) { return limit; }, 100'000, hint);
}

struct NearSurface {
    const char* name;
    Soup soup;
};

std::vector<NearSurface> surfaces() {
    Soup needles = test::prism(200, 1, 30);  // across the axes
    for (Vec3& p : needles.vertices) p = Vec3(p.x() + p.z(), p.y() - p.z(), p.z());
    return {{"sphere", test::icosphere(2)},
            {"box", test::prism(4, 1, 1)},
            {"torus", test::torus(1, 0.3, 40, 12)},
            {"needles", needles}};
}

TEST(Nearness, AgreesWithTheDistanceOfManyPoints) {
    constexpr double between_points = 0.04;  // of the size of a triangle: further they see nothing
    for (const NearSurface& c : surfaces()) {
        const TriangleTree surface(c.soup.vertices, c.soup.facets);
        Nearness nearness(surface, c.soup.facets);
        std::mt19937 random(7);
        int near = 0, far = 0;
        for (int i = 0; i < 120; ++i) {
            // a triangle beside the surface, as large as the facets there or larger
            const auto uniform = [&](double low, double high) {
                return std::uniform_real_distribution(low, high)(random);
            };
            const Vec3& p = c.soup.vertices[random() % c.soup.vertices.size()];
            const double size = std::pow(10, uniform(-2.5, 0.3));
            Corners t;
            for (Vec3& corner : t)
                corner = surface.closest(p + size * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))).point;
            const double distance = largest_distance(t, surface);
            SCOPED_TRACE(testing::Message() << c.name << " " << i << " size " << size << " distance " << distance);
            // wherever the search begins
            for (const std::int32_t hint : {-1, static_cast<std::int32_t>(random() % c.soup.facets.size())}) {
                ASSERT_TRUE(is_near(nearness, t, 1.05 * distance + between_points * size, hint)) << hint;
                ++near;
                if (distance < 1e-9) continue;
                ASSERT_FALSE(is_near(nearness, t, 0.99 * distance, hint)) << hint;
                ++far;
            }
        }
        EXPECT_GT(near, 120) << c.name;
        EXPECT_GT(far, 120) << c.name;
    }
}

// The facets of one side of a box, within far less than any of them: pieces along common edges are no trouble.
TEST(Nearness, HoldsForLargeFacetsOverManySmallOnes) {
    const Soup coarse = test::prism(4, 1, 1);
    std::vector<Vec3> vertices = coarse.vertices;
    std::vector<Triangle> facets = coarse.facets;
    for (int round = 0; round < 5; ++round) {
        std::vector<Triangle> finer;
        for (const Triangle& t : facets) {
            const auto middle = static_cast<std::int32_t>(vertices.size());
            // off the centre, so that needles come
            vertices.push_back(0.6 * vertices[t[0]] + 0.3 * vertices[t[1]] + 0.1 * vertices[t[2]]);
            for (int i = 0; i < 3; ++i) finer.push_back({t[i], t[(i + 1) % 3], middle});
        }
        facets = finer;
    }
    const TriangleTree surface(vertices, facets);
    Nearness nearness(surface, facets);
    for (const Triangle& t : coarse.facets) {
        std::int32_t hint = -1;
        EXPECT_TRUE(nearness.holds(
            {vertices[t[0]], vertices[t[1]], vertices[t[2]]}, 1e-6, [](std::int32_t) { return 1e-6; }, 100'000, hint));
    }
    EXPECT_LE(nearness.directed_distance(), 1e-6);
}

TEST(Nearness, FacetsThatDoNotCountAreNotNear) {
    const Soup box = test::prism(4, 1, 1);
    const TriangleTree surface(box.vertices, box.facets);
    const Triangle& t = box.facets[0];
    std::int32_t hint = 0;
    EXPECT_FALSE(Nearness(surface, box.facets)
                     .holds(
                         {box.vertices[t[0]], box.vertices[t[1]], box.vertices[t[2]]}, 1e-3,
                         [](std::int32_t f) { return f == 0 ? -1. : 1e-3; }, 100'000, hint));
}

}  // namespace
}  // namespace kerf
