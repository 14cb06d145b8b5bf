#include "surface/arrange/arrangement.h"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/geometry/triangle.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {
namespace {

using test::SeededNumbers;

Triangle sorted_corners(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// What every arrangement promises.
Arrangement expect_arranged(const Soup& soup) {
    Arrangement result = arrange(soup.vertices, soup.facets);
    EXPECT_TRUE(result.unresolved.empty());
    EXPECT_TRUE(std::is_sorted(result.parent.begin(), result.parent.end()));
    EXPECT_TRUE(std::equal(soup.vertices.begin(), soup.vertices.end(), result.vertices.begin()));
    for (const auto& [a, b] : find_self_intersections(result.vertices, result.facets, 100'000))
        EXPECT_EQ(sorted_corners(result.facets[a]), sorted_corners(result.facets[b]));  // only copies lie on each other
    std::vector<Vec3> area(soup.facets.size(), Vec3::Zero());
    for (std::size_t f = 0; f < result.facets.size(); ++f)
        area[result.parent[f]] += area_vector(result.vertices, result.facets[f]);
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        EXPECT_NEAR((area[f] - area_vector(soup.vertices, soup.facets[f])).norm(), 0, 1e-10);
    return result;
}

Soup separate_facets(int count, const std::function<Vec3()>& corner) {
    Soup soup;
    for (int f = 0; f < count; ++f) {
        for (int i = 0; i < 3; ++i) soup.vertices.push_back(corner());
        soup.facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return soup;
}

void add_body(Soup& soup, const Soup& body, const Vec3& offset) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (const Vec3& p : body.vertices) soup.vertices.push_back(p + offset);
    for (const auto& [a, b, c] : body.facets) soup.facets.push_back({first + a, first + b, first + c});
}

Soup turned(Soup soup, SeededNumbers& random) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1))
            .normalized();
    for (Vec3& p : soup.vertices) p = turn * p;
    return soup;
}

TEST(RepairArrangement, RandomFacetsShareTheCurvesInWhichTheyCross) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SeededNumbers random(seed);
        const Soup soup = separate_facets(random.integer(10, 30), [&] {
            const double x = random.share(), y = random.share();
            return Vec3(x, y, random.share());
        });
        SCOPED_TRACE(seed);
        const Arrangement result = expect_arranged(soup);
        EXPECT_EQ(result.rounds, 1);
        EXPECT_LT(result.largest_rounding, 1e-15);
    }
}

// With small integers, corners lie on edges and in facets, edges on edges, and facets on facets, again and again.
TEST(RepairArrangement, FacetsThatTouchAndOverlapAreDividedAlike) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SeededNumbers random(seed);
        const int size = random.integer(1, 4);
        const Soup soup = separate_facets(random.integer(5, 20), [&] {
            const int x = random.integer(0, size), y = random.integer(0, size);
            return Vec3(x, y, random.integer(0, size));
        });
        SCOPED_TRACE(seed);
        expect_arranged(soup);
    }
}

TEST(RepairArrangement, FacetsThatOverlapButForRoundingsAreDividedAlike) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SeededNumbers random(seed);
        const Soup soup = separate_facets(random.integer(4, 8), [&] {
            const int x = random.integer(0, 4);
            return Vec3(x, random.integer(0, 4), 0);
        });
        SCOPED_TRACE(seed);
        expect_arranged(turned(soup, random));
    }
}

TEST(RepairArrangement, BoxesAtAllOffsets) {
    const Soup box = test::box(Vec3::Zero(), Vec3::Ones(), 1);
    std::uint64_t seed = 0;
    for (const double x : {0.0, 0.5, 1.0, 1e-9})
        for (const double y : {0.0, 1.0 / 3, 1.0})
            for (const double z : {0.0, 0.25, 1e-16}) {
                Soup soup = box;
                add_body(soup, box, Vec3(x, y, z));
                SCOPED_TRACE(testing::Message() << x << " " << y << " " << z);
                expect_arranged(soup);
                SeededNumbers random(++seed);
                if (seed % 3 == 0) expect_arranged(turned(soup, random));
            }
}

TEST(RepairArrangement, ASphereAndItselfShiftedByLittle) {
    const Soup sphere = test::icosphere(1);
    for (const double shift : {1e-3, 1e-6, 1e-9, 1e-12}) {
        Soup soup = sphere;
        add_body(soup, sphere, Vec3(shift, shift / 3, shift / 7));
        SCOPED_TRACE(shift);
        expect_arranged(soup);
    }
}

TEST(RepairArrangement, WhatMeetsNothingComesBackAsItIs) {
    Soup soup = test::icosphere(2);
    add_body(soup, test::tetrahedron(), Vec3(0.5, 0.5, 0.5));  // through some facets
    const Arrangement result = expect_arranged(soup);
    EXPECT_GT(result.crossing_pairs, 0);
    std::vector<int> pieces(soup.facets.size(), 0);
    for (const std::int32_t f : result.parent) ++pieces[f];
    EXPECT_GT(std::count(pieces.begin(), pieces.end(), 1), 250);
    for (std::size_t f = 0; f < result.facets.size(); ++f)
        if (pieces[result.parent[f]] == 1) {
            EXPECT_EQ(result.facets[f], soup.facets[result.parent[f]]);
        }

    const Soup apart = test::icosphere(1);
    const Arrangement same = arrange(apart.vertices, apart.facets);
    EXPECT_EQ(same.rounds, 0);
    EXPECT_EQ(same.facets, apart.facets);
    EXPECT_EQ(same.vertices, apart.vertices);
}

TEST(RepairArrangement, CopiesStayAndFacetsWithoutAreaGo) {
    const std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.2, 0.2, -1}, {0.2, 0.2, 1}};
    const Arrangement result = arrange(vertices, {{0, 1, 2}, {1, 0, 2}, {0, 3, 1}, {4, 5, 2}});
    EXPECT_EQ(result.dropped_facets, 1);
    EXPECT_TRUE(result.unresolved.empty());
    std::array<std::vector<Triangle>, 2> copies;
    for (std::size_t f = 0; f < result.facets.size(); ++f)
        if (result.parent[f] < 2) copies[result.parent[f]].push_back(sorted_corners(result.facets[f]));
    for (auto& facets : copies) std::sort(facets.begin(), facets.end());
    EXPECT_GT(copies[0].size(), 1U);
    EXPECT_EQ(copies[0], copies[1]);
}

TEST(RepairArrangement, IsTheSameEachTime) {
    SeededNumbers random(7);
    const Soup soup = separate_facets(15, [&] {
        const int x = random.integer(0, 3), y = random.integer(0, 3);
        return Vec3(x, y, random.integer(0, 3));
    });
    const Arrangement first = arrange(soup.vertices, soup.facets), second = arrange(soup.vertices, soup.facets);
    EXPECT_EQ(first.facets, second.facets);
    EXPECT_EQ(first.vertices, second.vertices);
}

}  // namespace
}  // namespace kerf
