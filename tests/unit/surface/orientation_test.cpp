#include "surface/diagnosis/orientation.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/surface.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {
namespace {

using test::box;
using test::inside_out;
using test::join;
using test::nested_boxes;

void turn(Triangle& t) { std::swap(t[1], t[2]); }

// Equal as oriented facets, whichever corner comes first.
bool same_orientation(Triangle a, Triangle b) {
    std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
    std::rotate(b.begin(), std::min_element(b.begin(), b.end()), b.end());
    return a == b;
}

void expect_same_orientation(const Soup& a, const Soup& b) {
    ASSERT_EQ(a.facets.size(), b.facets.size());
    for (std::size_t f = 0; f < a.facets.size(); ++f) ASSERT_TRUE(same_orientation(a.facets[f], b.facets[f])) << f;
}

std::vector<Soup> oriented_shapes() {
    return {test::tetrahedron(),
            box(Vec3(-1, 0, 2), Vec3(4, 1, 5), 3),
            test::icosphere(2, 1e-3, Vec3(10, 20, 30)),
            test::uv_sphere(6, 8, 1e6),
            test::torus(3, 1, 12, 8),
            nested_boxes(5, 2),
            join(nested_boxes(4, 1), test::translated(nested_boxes(2, 1), Vec3(20, 0, 0))),
            join(test::uv_sphere(9, 12, 10), inside_out(test::torus(3, 1, 12, 8)))};
}

TEST(Orient, LeavesAnOrientedSurfaceAsItIs) {
    for (const Soup& shape : oriented_shapes()) {
        SCOPED_TRACE(shape.patch_names.front());
        Soup soup = shape;
        const OrientationReport report = orient(soup);
        EXPECT_EQ(soup.facets, shape.facets);
        EXPECT_EQ(report.facets_flipped, 0);
        EXPECT_EQ(report.shells_flipped, 0);
    }
}

TEST(Orient, RestoresAnyOrientation) {
    for (const Soup& shape : oriented_shapes())
        for (unsigned seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            std::mt19937 random(seed);
            Soup soup = shape;
            for (Triangle& t : soup.facets)
                if (random() % 2) turn(t);
            orient(soup);
            expect_same_orientation(soup, shape);
            EXPECT_TRUE(find_manifold_defects(soup.vertices.size(), soup.facets).empty());
            EXPECT_EQ(enclosed_volume(soup.vertices, soup.facets), enclosed_volume(shape.vertices, shape.facets));
        }
}

TEST(Orient, CountsTheMinorityOfEveryShellAndTheShellsTurned) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup = nested_boxes(4, 3);
        const std::size_t shell_size = soup.facets.size() / 4;
        std::int64_t turned = 0, shells_turned = 0;
        for (std::size_t shell = 0; shell < 4; ++shell) {
            const bool whole = random() % 2;
            shells_turned += whole;
            for (std::size_t f = shell * shell_size; f < (shell + 1) * shell_size; ++f) {
                const bool odd_one = random() % 4 == 0;
                turned += odd_one;
                if (whole != odd_one) turn(soup.facets[f]);
            }
        }
        const OrientationReport report = orient(soup);
        EXPECT_EQ(report.facets_flipped, turned);
        EXPECT_EQ(report.shells_flipped, shells_turned);
        EXPECT_EQ(report.shells, 4);
        expect_same_orientation(soup, nested_boxes(4, 3));
    }
}

TEST(Orient, DoesNotDependOnTheOrderOfFacets) {
    for (const Soup& shape : oriented_shapes())
        for (unsigned seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            Soup soup = inside_out(shape), expected = shape;
            std::shuffle(soup.facets.begin(), soup.facets.end(), std::mt19937(seed));
            std::shuffle(expected.facets.begin(), expected.facets.end(), std::mt19937(seed));
            const OrientationReport report = orient(soup);
            expect_same_orientation(soup, expected);
            EXPECT_EQ(report.shells_flipped, report.shells);
        }
}

TEST(Orient, SeesNoNestingInLinkedRingsAndNeighbours) {
    Soup second = test::torus(3, 1, 16, 10);
    for (Vec3& p : second.vertices) p = Vec3(p.x() + 3, p.z(), -p.y());
    Soup soup = join(test::torus(3, 1, 16, 10), second);
    const OrientationReport report = orient(soup);
    EXPECT_EQ(report.shells, 2);
    EXPECT_EQ(report.shells_flipped, 0);
}

TEST(Orient, TellsTheHoleOfARingFromItsInside) {
    // Balls all over the box of a ring: those in the tube are voids, those in the hole and beside the tube are bodies.
    Soup soup = test::torus(3, 1, 24, 16);
    std::int64_t voids = 0, balls = 0;
    for (int i = -7; i <= 7; ++i)
        for (int j = -7; j <= 7; ++j) {
            const Vec3 centre(0.5 * i, 0.5 * j, 0.25 * ((i + j) % 3));
            const double distance = std::hypot(std::hypot(centre.x(), centre.y()) - 3, centre.z());
            if (std::abs(distance - 1) < 0.2) continue;
            const Soup ball = test::icosphere(0, 0.1, centre);
            soup = join(std::move(soup), distance < 1 ? inside_out(ball) : ball);
            voids += distance < 1;
            ++balls;
        }
    ASSERT_GT(voids, 20);
    ASSERT_GT(balls - voids, 20);
    const Soup expected = soup;
    const OrientationReport report = orient(soup);
    EXPECT_EQ(report.shells, balls + 1);
    EXPECT_EQ(soup.facets, expected.facets);
}

TEST(Orient, RefusesAOneSidedSurface) {
    // The projective plane with six vertices: every edge has two facets, but no orientation exists.
    Soup soup;
    for (int i = 0; i < 6; ++i) soup.vertices.emplace_back(i, i * i, i * i * i);
    soup.facets = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                   {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
    soup.patch.assign(10, 0);
    for (const ManifoldDefect& defect : find_manifold_defects(6, soup.facets))
        ASSERT_EQ(defect.kind, ManifoldDefect::Kind::edge_orientation);
    try {
        orient(soup);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        EXPECT_NE(std::string(error.what()).find("facet"), std::string::npos) << error.what();
    }
}

TEST(Orient, RefusesShellsThatCoincide) {
    Soup soup = join(test::icosphere(1), test::icosphere(1));
    EXPECT_THROW(orient(soup), Error);
}

// One question a shell, not one for each that is around it.
TEST(LocateShells, FindsAThousandShellsInEachOther) {
    constexpr std::int32_t count = 1000;
    Soup soup;
    for (std::int32_t i = 0; i < count; ++i) {
        const std::int32_t size = i * 7 % count + 1;  // in no order
        const Soup sphere = test::icosphere(2, size);
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        soup.vertices.insert(soup.vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
        for (const auto& [a, b, c] : sphere.facets) soup.facets.push_back({a + first, b + first, c + first});
    }
    const ConsistentFacets consistent = make_consistent(soup.facets);
    const std::vector<ShellPlace> places = locate_shells(soup.vertices, consistent);
    ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
    std::vector<std::int32_t> parent;
    for (std::int32_t i = 0; i < count; ++i) {
        const std::int32_t size = i * 7 % count + 1;
        EXPECT_EQ(places[i].depth, count - size);
        ASSERT_EQ(places[i].parent < 0, size == count);
        if (size < count) {
            EXPECT_EQ(places[i].parent * 7 % count + 1, size + 1);
        }
        parent.push_back(places[i].parent);
    }
    EXPECT_TRUE(nested_shells_are_apart(soup.vertices, soup.facets, consistent.shell, parent));
}

TEST(MakeConsistent, ReportsShellsInTheOrderOfTheirFirstFacet) {
    const Soup soup = join(box(), join(test::tetrahedron(), test::icosphere(0)));
    const ConsistentFacets consistent = make_consistent(soup.facets);
    EXPECT_EQ(consistent.shell_count, 3);
    EXPECT_TRUE(consistent.turned.empty());
    EXPECT_TRUE(consistent.contradictions.empty());
    for (std::size_t f = 0; f < soup.facets.size(); ++f) EXPECT_EQ(consistent.shell[f], f < 12 ? 0 : f < 16 ? 1 : 2);
}

TEST(MakeConsistent, DoesNotCrossEdgesOfFourFacets) {
    Soup soup = join(box(), inside_out(box(Vec3(1, 1, 0), Vec3(2, 2, 1))));
    weld_exactly(soup);
    const ConsistentFacets consistent = make_consistent(soup.facets);
    EXPECT_EQ(consistent.shell_count, 2);
    EXPECT_EQ(consistent.facets, soup.facets);
}

}  // namespace
}  // namespace kerf
