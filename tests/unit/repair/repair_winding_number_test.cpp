#include "surface/arrange/winding_number.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/seeded_numbers.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr double largest_error = 0.01;

Vec3 point_within(test::SeededNumbers& random, double reach) {
    return {random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
}

// Facet by facet, so that nothing is far from anything.
double exact_at(const Soup& soup, const Vec3& point) {
    double sum = 0;
    for (const Triangle& t : soup.facets) sum += WindingNumber(soup.vertices, {t}).at(point);
    return sum;
}

TEST(WindingNumber, IsWholeWhereFacetsClose) {
    test::SeededNumbers random(1);
    for (const double scale : {1e-9, 1.0, 1e9}) {
        Soup soup = test::torus(3, 1, 60, 40);
        kerf::scale(soup, scale);
        const WindingNumber winding(soup.vertices, soup.facets);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p = point_within(random, 4.5);
            const double from_circle = std::hypot(std::hypot(p.x(), p.y()) - 3, p.z());
            if (std::abs(from_circle - 0.995) < 0.01) continue;  // between the torus and its facets
            EXPECT_NEAR(winding.at(scale * p), from_circle < 1 ? 1 : 0, largest_error) << p.transpose();
        }
    }
}

TEST(WindingNumber, IsTheSumOfSolidAngles) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        test::SeededNumbers random(seed);
        Soup soup;
        for (int i = 0; i < 900; ++i) soup.vertices.push_back(point_within(random, 1));
        for (int i = 0; i < 300; ++i) soup.facets.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        const WindingNumber winding(soup.vertices, soup.facets);
        for (int i = 0; i < 20; ++i) {
            const Vec3 p = point_within(random, 20);
            EXPECT_NEAR(winding.at(p), exact_at(soup, p), largest_error);
        }
    }
}

TEST(WindingNumber, FallsOffThroughAHole) {
    Soup soup = test::icosphere(4);
    const Soup whole = soup;
    std::erase_if(soup.facets, [&](const Triangle& t) { return soup.vertices[t[0]].z() > 0; });
    const WindingNumber winding(soup.vertices, soup.facets);
    double last = 1;
    for (double z = -0.9; z < 0.9; z += 0.1) {
        const double here = winding.at({0, 0, z});
        EXPECT_LT(here, last);
        last = here;
    }
    EXPECT_NEAR(winding.at(Vec3::Zero()), 0.5, 0.05);
}

TEST(WindingNumber, CountsFacetsAsOftenAsTheyAreThere) {
    const Soup soup = test::icosphere(3);
    for (const int times : {-2, -1, 0, 1, 3}) {
        const WindingNumber winding(soup.vertices, soup.facets, std::vector<std::int32_t>(soup.facets.size(), times));
        EXPECT_NEAR(winding.at({0.3, 0.2, 0.1}), times, 3 * largest_error);
        EXPECT_NEAR(winding.at({1.3, 0.2, 0.1}), 0, 3 * largest_error);
        EXPECT_NEAR(winding.beside(7) + times / 2.0, times, 3 * largest_error);
        EXPECT_NEAR(winding.beside(7) - times / 2.0, 0, 3 * largest_error);
    }
}

TEST(WindingNumber, IsDefinedForNoFacetsAndFlatOnes) {
    EXPECT_EQ(WindingNumber({}, {}).at({1, 2, 3}), 0);
    const std::vector<Vec3> line = {Vec3::Zero(), Vec3::UnitX(), 2 * Vec3::UnitX()};
    const WindingNumber flat(line, {{0, 1, 2}, {0, 0, 1}, {2, 2, 2}});
    EXPECT_EQ(flat.at({5, 5, 5}), 0);
    EXPECT_EQ(flat.beside(0), 0);
}

}  // namespace
}  // namespace kerf
