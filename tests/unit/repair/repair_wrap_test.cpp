// Laws of wraps: whatever facets there are, what is put around them is closed, manifold and free of intersections, has
// them inside, and is no further from them than it says.
#include "surface/wrap/wrap.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/triangle.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/intersections.h"
#include "surface/soup/triangle_tree.h"
#include "surface/wrap/inside/alpha_wrap.h"
#include "surface/wrap/inside/proven_distance.h"

namespace kerf {
namespace {

WrapOptions gap_of(double percent) { return {Length::percent(percent), {}}; }

struct Wrapped {
    Soup soup;
    WrapReport report;
};

double largest_sampled_distance(const Soup& from, const Soup& to) {
    constexpr int n = 4;
    const TriangleTree tree(to.vertices, to.facets);
    double largest = 0;
    for (const Triangle& t : from.facets)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j) {
                const Vec3 p =
                    (i * from.vertices[t[0]] + j * from.vertices[t[1]] + (n - i - j) * from.vertices[t[2]]) / n;
                largest = std::max(largest, std::sqrt(tree.closest(p).squared_distance));
            }
    return largest;
}

// Wraps it, and checks all that holds for any facets.
Wrapped wrapped(const Soup& before, const WrapOptions& options) {
    Wrapped result{before, {}};
    result.report = wrap(result.soup, options);
    const Soup& soup = result.soup;
    EXPECT_TRUE(find_manifold_defects(soup.vertices.size(), soup.facets).empty());
    EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
    EXPECT_GT(enclosed_volume(soup.vertices, soup.facets), 0);
    EXPECT_EQ(soup.patch.size(), soup.facets.size());
    EXPECT_EQ(soup.patch_names, before.patch_names);
    EXPECT_EQ(static_cast<std::size_t>(result.report.facets), soup.facets.size());
    EXPECT_EQ(static_cast<std::size_t>(result.report.facets_before), before.facets.size());
    EXPECT_LE(largest_sampled_distance(soup, before), result.report.distance_to_input * (1 + 1e-9));
    EXPECT_LE(result.report.distance_to_input, result.report.gap + result.report.offset);
    return result;
}

// Triangles here and there.
Soup facets_by_chance(std::uint64_t seed) {
    test::SeededNumbers numbers(seed);
    Soup soup;
    soup.patch_names = {"some", "others"};
    const auto point = [&](double size) {
        return Vec3(numbers.between(-size, size), numbers.between(-size, size), numbers.between(-size, size));
    };
    const int count = numbers.integer(1, 40);
    for (int i = 0; i < count; ++i) {
        const Vec3 centre = point(1);
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        for (int corner = 0; corner < 3; ++corner) soup.vertices.emplace_back(centre + point(0.5));
        soup.facets.push_back({first, first + 1, first + 2});
        soup.patch.push_back(i % 2);
    }
    return soup;
}

TEST(Wrap, ObeysTheLawsForFacetsByChance) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        wrapped(facets_by_chance(seed), gap_of(10));
    }
}

TEST(Wrap, ObeysTheLawsForBodiesInAnyPlace) {
    const Vec3 far(3e5, -2e5, 1e5);
    for (const Soup& soup :
         {test::torus(1, 0.4, 24, 12), test::plate_with_hole(2), test::linked_rings(2, 16, 8), test::icosphere(2),
          test::join(test::box(), test::box(Vec3::Constant(0.5), Vec3::Constant(1.5), 1)),
          test::translated(test::box(), far), test::inside_out(test::prism(7, 1, 3)), test::tetrahedron()})
        wrapped(soup, gap_of(8));
}

TEST(Wrap, GivesACubeItsEdgesBack) {
    for (const double percent : {4.0, 8.0}) {
        const Wrapped cube = wrapped(test::box(), gap_of(percent));
        const double gap = cube.report.gap;
        EXPECT_NEAR(enclosed_volume(cube.soup.vertices, cube.soup.facets), 1, 1e-3 * gap);
        EXPECT_LT(cube.report.distance_to_input, 0.1 * gap);
        EXPECT_LT(cube.report.distance_from_input, 0.1 * gap);
        EXPECT_EQ(cube.report.seen, 12);
        std::vector<double> areas(6, 0);  // of patches, which end at its edges
        for (std::size_t f = 0; f < cube.soup.facets.size(); ++f)
            areas[static_cast<std::size_t>(cube.soup.patch[f])] +=
                triangle_area(cube.soup.vertices, cube.soup.facets[f]);
        for (const double area : areas) EXPECT_NEAR(area, 1, 0.1 * gap);
    }
}

TEST(Wrap, ClosesOpeningsNarrowerThanTheGapAndEntersWiderOnes) {
    Soup sphere = test::icosphere(3);
    std::vector<char> dropped(sphere.facets.size(), 0);
    for (std::size_t f = 0; f < dropped.size(); ++f)
        dropped[f] = sphere.vertices[sphere.facets[f][0]].z() > 0.97;  // a hole with a diameter of some 0.5
    drop_facets(sphere, dropped);
    const double ball = 4.18;
    const Wrapped closed = wrapped(sphere, {0.8, 0.05}), open = wrapped(sphere, {0.25, 0.05});
    EXPECT_NEAR(enclosed_volume(closed.soup.vertices, closed.soup.facets), ball, 0.05 * ball);
    EXPECT_LE(closed.report.distance_from_input, estimated_wrap_distance(sphere, {0.8, 0.05}));
    const double shell = 12.5 * 1.5 * open.report.offset;
    EXPECT_NEAR(enclosed_volume(open.soup.vertices, open.soup.facets), shell, 0.25 * shell);
}

TEST(Wrap, MakesAWallOfASheet) {
    Soup sheet = test::box();
    std::vector<char> dropped(sheet.facets.size(), 1);
    dropped[0] = dropped[1] = 0;
    drop_facets(sheet, dropped);
    const Wrapped wall = wrapped(sheet, gap_of(8));
    const double thickness = 1.5 * wall.report.offset;
    EXPECT_NEAR(enclosed_volume(wall.soup.vertices, wall.soup.facets), thickness, 0.3 * thickness);
}

TEST(Wrap, LeavesOutWhatIsNoFacet) {
    Soup soup = test::box();
    const Soup clean = soup;
    soup.vertices.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    soup.vertices.emplace_back(std::numeric_limits<double>::infinity(), 1e300, -1e300);
    soup.facets.insert(soup.facets.end(), {{0, 1, 8}, {0, 9, 1}, {0, 0, 1}, {2, 2, 2}});
    soup.patch.resize(soup.facets.size(), 0);
    Soup same = clean;
    const WrapReport report = wrap(soup, gap_of(8)), report_of_clean = wrap(same, gap_of(8));
    EXPECT_EQ(report.left_out, 4);
    EXPECT_EQ(report.facets, report_of_clean.facets);
    EXPECT_EQ(soup.vertices, same.vertices) << "and again, so that it is deterministic";
    EXPECT_EQ(soup.facets, same.facets);

    Soup nothing = clean;
    nothing.facets = {{0, 0, 1}};
    nothing.patch = {0};
    EXPECT_THROW(wrap(nothing, {}), Error);
}

TEST(Wrap, RefusesLengthsOutOfRange) {
    for (const WrapOptions& options :
         {gap_of(0.001), gap_of(80), WrapOptions{1e-9, {}}, WrapOptions{0.1, 0.2}, WrapOptions{0.1, 1e-6}}) {
        Soup soup = test::box();
        EXPECT_THROW(wrap(soup, options), Error);
        EXPECT_EQ(soup.facets, test::box().facets);
    }
}

TEST(Wrap, EndsWhenItIsAsked) {
    Soup soup = test::icosphere(2);
    EXPECT_THROW(wrap(soup, {}, [] { throw Error(ErrorCode::cancelled, "enough"); }), Error);
}

TEST(ProvenDistance, IsThatOfAShiftedCopy) {
    test::SeededNumbers numbers(7);
    const Soup ball = test::icosphere(2);
    const TriangleTree tree(ball.vertices, ball.facets);
    for (int i = 0; i < 20; ++i) {
        const double way = numbers.magnitude(1e-6, 3);
        const Soup moved = test::translated(ball, {way, 0, 0});
        const double sampled = largest_sampled_distance(moved, ball);
        const double proven = proven_distance(moved.vertices, moved.facets, {}, tree, ball.facets, 1e-12, [] {});
        EXPECT_LE(sampled, proven * (1 + 1e-9));
        EXPECT_LE(proven, 1.15 * sampled + 1e-9);
    }
    EXPECT_EQ(proven_distance(ball.vertices, ball.facets, std::vector<char>(ball.facets.size(), 0), tree, ball.facets,
                              1e-12, [] {}),
              0);
}

}  // namespace
}  // namespace kerf
