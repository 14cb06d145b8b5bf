#include "surface/soup/facet_triangulation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace kerf {
namespace {

namespace facets {

using Polygon = std::vector<std::int64_t>;

// A square of side 3, in it one of side 1 (4 to 7), then the four middles of the outer sides, and two points within.
std::vector<Vec3> points() {
    return {{0, 0, 0}, {3, 0, 0},   {3, 3, 0}, {0, 3, 0},   {1, 1, 0},   {2, 1, 0},   {2, 2, 0},
            {1, 2, 0}, {1.5, 0, 0}, {3, 2, 0}, {1.5, 3, 0}, {0, 1.5, 0}, {0.5, 1, 0}, {0.5, 2, 0}};
}
const Polygon outer = {0, 1, 2, 3}, inner = {4, 5, 6, 7};
const Vec3 middle(1.5, 1.5, 0);

double area(const std::vector<Vec3>& p, const std::vector<Triangle>& triangles, const Vec3& normal = Vec3::UnitZ()) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
        const double one = (p[b] - p[a]).cross(p[c] - p[a]).dot(normal) / 2;
        EXPECT_GT(one, 0) << "triangles have the orientation of the largest polygon";
        sum += one;
    }
    return sum;
}

bool has_edge(const std::vector<Triangle>& triangles, std::int32_t a, std::int32_t b) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
        return std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b);
    });
}

std::string obstacle(const std::vector<Vec3>& vertices, const PolygonalFacet& facet) {
    const FacetTriangulation found = triangulate_facet(vertices, facet);
    EXPECT_TRUE(found.triangles.empty());
    return found.obstacle;
}

TEST(FacetTriangulation, LeavesOutWhatIsAroundAHolePoint) {
    const FacetTriangulation ring = triangulate_facet(points(), {{outer, inner}, {middle}});
    EXPECT_EQ(ring.triangles.size(), 8u);
    EXPECT_EQ(area(points(), ring.triangles), 8);
    const FacetTriangulation divided = triangulate_facet(points(), {{outer, inner}, {}});
    EXPECT_EQ(divided.triangles.size(), 10u) << "an inner polygon is no hole by itself";
    EXPECT_EQ(area(points(), divided.triangles), 9);
    for (const auto* found : {&ring, &divided})
        for (const Polygon* polygon : {&outer, &inner})
            for (std::size_t i = 0; i < 4; ++i)
                EXPECT_TRUE(has_edge(found->triangles, static_cast<std::int32_t>((*polygon)[i]),
                                     static_cast<std::int32_t>((*polygon)[(i + 1) % 4])));
    const FacetTriangulation apart = triangulate_facet(points(), {{{0, 8, 12}, inner}, {Vec3(9, 9, 0)}});
    EXPECT_EQ(apart.triangles.size(), 3u) << "a hole point outside leaves all";
}

TEST(FacetTriangulation, MakesEdgesAndVerticesOfWhatLiesInside) {
    const PolygonalFacet facet{{outer, {12, 13}, {4}, inner, {5, 7}}, {}};
    const FacetTriangulation found = triangulate_facet(points(), facet);
    EXPECT_EQ(found.outside, 0);
    EXPECT_TRUE(has_edge(found.triangles, 12, 13));
    EXPECT_TRUE(has_edge(found.triangles, 5, 7));
    EXPECT_EQ(area(points(), found.triangles), 9);
    const FacetTriangulation small = triangulate_facet(points(), {{inner, {12, 13}, {0}}, {}});
    EXPECT_EQ(small.triangles.size(), 2u);
    EXPECT_EQ(small.outside, 2);
    EXPECT_TRUE(has_edge(triangulate_facet(points(), {{outer, {8, 10}}, {}}).triangles, 0, 8))
        << "a vertex on an edge divides it";
}

TEST(FacetTriangulation, DoesNotDependOnTheOrderOfPolygonsAndCorners) {
    std::mt19937 random(7);
    std::vector<Vec3> grid;
    PolygonalFacet facet{{{0, 6, 48, 42}, {16, 18, 32, 30}}, {}};
    for (std::int64_t i = 0; i < 49; ++i) {
        grid.emplace_back(i % 7, i / 7, 0);
        facet.polygons.push_back({i});
    }
    const std::vector<Triangle> once = triangulate_facet(grid, facet).triangles;
    EXPECT_EQ(once.size(), 72u) << "each square has four corners on a circle";
    for (int round = 0; round < 20; ++round) {
        std::shuffle(facet.polygons.begin(), facet.polygons.end(), random);
        for (Polygon& polygon : facet.polygons)
            std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()),
                        polygon.end());
        EXPECT_EQ(triangulate_facet(grid, facet).triangles, once);
    }
}

TEST(FacetTriangulation, WorksInAnyPlaneAndScale) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 50; ++round) {
        const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
        const double scale = std::exp(5 * normal(random));
        const Eigen::Matrix3d motion = scale * turn.normalized().toRotationMatrix();
        std::vector<Vec3> moved;
        for (const Vec3& p : points()) moved.push_back(motion * p);
        const PolygonalFacet facet{{inner, {3, 2, 9, 1, 0}}, {motion * middle}};
        const FacetTriangulation found = triangulate_facet(moved, facet);
        EXPECT_EQ(found.obstacle, "");
        EXPECT_NEAR(area(moved, found.triangles, -(turn.normalized() * Vec3::UnitZ())), 8 * scale * scale,
                    1e-9 * scale * scale);
    }
}

TEST(FacetTriangulation, NamesWhatIsWrongAndWhere) {
    std::vector<Vec3> bent = points();
    bent[6].z() = 0.25;
    EXPECT_EQ(obstacle(bent, {{outer, inner}, {}}),
              "is not planar: its corners (0, 0, 0) and (2, 2, 0.25) are 0.25 apart along its normal");
    EXPECT_EQ(obstacle(points(), {{outer, {4, 9, 7, 5}}, {}}), "has edges that cross near (1.66666667, 1.33333333, 0)");
    EXPECT_EQ(obstacle(points(), {{outer, inner}, {Vec3(1.5, 1, 0)}}), "has its hole point (1.5, 1, 0) on an edge");
    EXPECT_EQ(obstacle(points(), {{outer}, {middle}}), "has the hole point (1.5, 1.5, 0), which leaves nothing of it");
    EXPECT_EQ(obstacle(points(), {{{0, 8, 1}, {3, 2}}, {}}), "has no area near (0, 0, 0)");
    bent[6].z() = NAN;
    EXPECT_EQ(obstacle(bent, {{outer, inner}, {}}), "has the corner (2, 2, nan)");
}

}  // namespace facets

}  // namespace
}  // namespace kerf
