#include "surface/diagnosis/optimisation.h"

#include <algorithm>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/geometry/closest_point.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

std::vector<Vec3> optimised(const Soup& soup, const OptimisationOptions& options = {}) {
    return optimise_nodes(soup.vertices, soup.facets, soup.patch, {}, options);
}

Vec3 random_vector(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

// n x n squares of edge 1 in the plane z = 0 with four fixed sides, inner vertices moved at random.
Soup disturbed_square(int n, std::mt19937& random) {
    Soup soup;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const bool is_inner = i > 0 && i < n && j > 0 && j < n;
            const Vec3 shift = 0.3 * random_vector(random);
            soup.vertices.emplace_back(i + is_inner * shift.x(), j + is_inner * shift.y(), 0);
        }
    const auto at = [&](int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            soup.facets.insert(soup.facets.end(), {{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                   {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"square"};
    return soup;
}

// Moves every vertex of a sphere about the origin along it.
Soup disturbed_sphere(int subdivisions, std::mt19937& random) {
    Soup soup = test::icosphere(subdivisions);
    const double edge = (soup.vertices[soup.facets[0][0]] - soup.vertices[soup.facets[0][1]]).norm();
    for (Vec3& p : soup.vertices) p = (p + 0.25 * edge * random_vector(random)).normalized();
    return soup;
}

std::vector<double> smallest_angles_deg(const std::vector<Vec3>& points, const std::vector<Triangle>& facets) {
    std::vector<double> angles;
    for (const Triangle& t : facets) {
        double smallest = 180;
        for (int i = 0; i < 3; ++i) {
            const Vec3 a = points[t[(i + 1) % 3]] - points[t[i]], b = points[t[(i + 2) % 3]] - points[t[i]];
            smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
        }
        angles.push_back(smallest);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

double distance(const Vec3& p, const std::vector<Vec3>& points, const std::vector<Triangle>& facets) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : facets)
        least = std::min(least, point_triangle_distance(p, points[t[0]], points[t[1]], points[t[2]]));
    return least;
}

// By the definition in the header, with every facet tried for every sample.
double energy(const Soup& original, const std::vector<Vec3>& points, double spring) {
    std::vector<Vec3> samples = original.vertices;
    double sum = 0;
    for (const Triangle& t : original.facets) {
        samples.emplace_back((original.vertices[t[0]] + original.vertices[t[1]] + original.vertices[t[2]]) / 3);
        for (int i = 0; i < 3; ++i)  // a border edge has one facet, another two
            sum += spring / 2 * (points[t[i]] - points[t[(i + 1) % 3]]).squaredNorm();
    }
    for (const Vec3& p : samples) sum += std::pow(distance(p, points, original.facets), 2);
    return sum;
}

std::int64_t count_moved(const Soup& soup, const std::vector<Vec3>& points) {
    std::int64_t moved = 0;
    for (std::size_t v = 0; v < points.size(); ++v) moved += points[v] != soup.vertices[v];
    return moved;
}

struct NamedSoup {
    std::string name;
    Soup soup;
};

std::vector<NamedSoup> disturbed_shapes(unsigned seed) {
    std::mt19937 random(seed);
    Soup tilted = disturbed_square(6, random);
    const Eigen::AngleAxisd rotation(0.8, Vec3(1, -2, 0.5).normalized());
    for (Vec3& p : tilted.vertices) p = rotation * p + Vec3(10, 20, 30);
    Soup rough_torus = test::torus(3, 1, 24, 12);
    for (Vec3& p : rough_torus.vertices) p += 0.05 * random_vector(random);
    return {{"square", disturbed_square(8, random)},
            {"tilted square", tilted},
            {"sphere", disturbed_sphere(2, random)},
            {"torus", rough_torus},
            {"box", test::box(Vec3::Zero(), Vec3(3, 2, 1), {6, 5, 4})},
            {"hollow box", test::nested_boxes(2, 3)}};
}

TEST(Optimisation, NeverMakesTheSurfaceWorse) {
    const OptimisationOptions usual,
        loose{.feature_angle_deg = 180, .spring = 0.5, .tolerance_rel = 1, .max_turn_deg = 90};
    for (unsigned seed = 1; seed <= 5; ++seed)
        for (const auto& [name, soup] : disturbed_shapes(seed))
            for (const OptimisationOptions& options : {usual, loose}) {
                SCOPED_TRACE(testing::Message() << name << " seed " << seed << " spring " << options.spring);
                const std::vector<Vec3> points = optimised(soup, options);
                ASSERT_EQ(points.size(), soup.vertices.size());
                EXPECT_GE(smallest_angles_deg(points, soup.facets).front(),
                          smallest_angles_deg(soup.vertices, soup.facets).front() - 1e-9);
                const double before = energy(soup, soup.vertices, options.spring);
                EXPECT_LE(energy(soup, points, options.spring), before * (1 + 1e-12));
            }
}

// Rough squares with a single vertex that can move, so that a sweep is one move.
TEST(Optimisation, NoMoveRaisesTheEnergyAboveTheFirst) {
    int moved = 0;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup = disturbed_square(2, random);
        for (Vec3& p : soup.vertices) p.z() = random_vector(random).z();
        OptimisationOptions options{.feature_angle_deg = 180, .tolerance_rel = 1, .max_turn_deg = 180};
        const double first = energy(soup, soup.vertices, options.spring);
        for (options.sweeps = 1; options.sweeps <= 4; ++options.sweeps) {
            const std::vector<Vec3> points = optimised(soup, options);
            EXPECT_LE(energy(soup, points, options.spring), first * (1 + 1e-12));
            moved += points != soup.vertices;
        }
    }
    EXPECT_GT(moved, 100);
}

TEST(Optimisation, KeepsWithinToleranceAndTurn) {
    for (unsigned seed = 1; seed <= 5; ++seed)
        for (const double tolerance : {0.002, 0.05}) {
            std::mt19937 random(seed);
            const Soup soup = disturbed_sphere(3, random);
            SCOPED_TRACE(testing::Message() << "seed " << seed << " tolerance " << tolerance);
            const std::vector<Vec3> points = optimised(soup, {.tolerance_rel = tolerance, .max_turn_deg = 5});
            const double longest_edge = 0.4;  // of the sphere, disturbed
            for (const Vec3& p : points) ASSERT_LE(distance(p, soup.vertices, soup.facets), tolerance * longest_edge);
            for (const Triangle& t : soup.facets) {
                const auto normal = [&](const std::vector<Vec3>& p) {
                    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
                };
                ASSERT_GE(normal(points).dot(normal(soup.vertices)), std::cos(5.001 * std::numbers::pi / 180));
            }
            EXPECT_GT(count_moved(soup, points), 0);
        }
}

TEST(Optimisation, ImprovesTheAnglesOfAPlaneAndStaysInIt) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Soup flat = disturbed_square(12, random);
        const std::vector<Vec3> points = optimised(flat);
        for (const Vec3& p : points) ASSERT_EQ(p.z(), 0);
        const auto before = smallest_angles_deg(flat.vertices, flat.facets);
        const auto after = smallest_angles_deg(points, flat.facets);
        EXPECT_GT(after.front(), 40);
        EXPECT_GT(after[after.size() / 10], 1.5 * before[before.size() / 10]);

        const Eigen::AngleAxisd rotation(0.1 * seed, random_vector(random).normalized());
        Soup tilted = flat;
        for (Vec3& p : tilted.vertices) p = rotation * p;
        const Vec3 normal = rotation * Vec3::UnitZ();
        for (const Vec3& p : optimised(tilted)) ASSERT_LE(std::abs(normal.dot(p)), 1e-12);
    }
}

TEST(Optimisation, ChangesTheVolumeLittle) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        for (const Soup& soup : {disturbed_sphere(3, random), test::torus(3, 1, 48, 16)}) {
            const std::vector<Vec3> points = optimised(soup);
            const double before = enclosed_volume(soup.vertices, soup.facets);
            EXPECT_NEAR(enclosed_volume(points, soup.facets) / before, 1, 5e-3);
            EXPECT_GT(count_moved(soup, points), 0);
        }
    }
}

// Six sides whose inner vertices are moved along them; edges, corners and what the caller fixes must stay.
TEST(Optimisation, KeepsFeaturesPatchBordersAndFixedVertices) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup = test::box(Vec3::Zero(), Vec3::Ones(), 6);
        std::vector<char> fixed(soup.vertices.size(), 0), on_edge(soup.vertices.size(), 0);
        for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
            Vec3& p = soup.vertices[v];
            const Vec3 shift = 0.06 * random_vector(random);
            const auto is_at_side = [&](int i) { return p[i] == 0 || p[i] == 1; };
            on_edge[v] = is_at_side(0) + is_at_side(1) + is_at_side(2) > 1;
            for (int i = 0; i < 3; ++i)
                if (!on_edge[v] && !is_at_side(i)) p[i] += shift[i];
            fixed[v] = random() % 4 == 0;
        }
        for (const bool by_angle : {true, false}) {
            SCOPED_TRACE(by_angle);
            const std::vector<std::int32_t> patch =
                by_angle ? std::vector<std::int32_t>(soup.facets.size(), 0) : soup.patch;
            OptimisationOptions options;
            if (!by_angle) options.feature_angle_deg = 180;
            const std::vector<Vec3> points = optimise_nodes(soup.vertices, soup.facets, patch, fixed, options);
            for (std::size_t v = 0; v < points.size(); ++v)
                if (fixed[v] || on_edge[v]) {
                    ASSERT_EQ(points[v], soup.vertices[v]);
                }
            EXPECT_GT(count_moved(soup, points), 20);
            EXPECT_NEAR(enclosed_volume(points, soup.facets), 1, 1e-12);
        }
    }
}

// A change of the last facet of a sphere, on which all vertices move, must hold its corners and no others.
void expect_only_last_facet_held(const Soup& sphere, const Soup& changed) {
    const OptimisationOptions no_angles{.feature_angle_deg = 180};
    const Triangle corners = sphere.facets.back();
    const std::vector<Vec3> before = optimised(sphere, no_angles), after = optimised(changed, no_angles);
    for (std::int32_t v : corners) {
        EXPECT_NE(before[v], sphere.vertices[v]);
        EXPECT_EQ(after[v], sphere.vertices[v]);
    }
    EXPECT_GE(count_moved(sphere, after), count_moved(sphere, before) - 6);
}

TEST(Optimisation, HoldsOpenNonManifoldAndTurnedEdges) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Soup sphere = disturbed_sphere(2, random);
        Soup open = sphere, doubled = sphere, turned = sphere;
        open.facets.pop_back();
        open.patch.pop_back();
        doubled.facets.push_back(sphere.facets.back());
        doubled.patch.push_back(0);
        std::swap(turned.facets.back()[1], turned.facets.back()[2]);
        for (const Soup& changed : {open, doubled, turned}) expect_only_last_facet_held(sphere, changed);
    }
}

TEST(Optimisation, KeepsVerticesWithoutFacets) {
    std::mt19937 random(1);
    const Soup sphere = disturbed_sphere(2, random);
    Soup with_stray = sphere;
    with_stray.vertices.emplace_back(0, 0, 0.9);
    std::vector<Vec3> points = optimised(with_stray);
    EXPECT_EQ(points.back(), with_stray.vertices.back());
    points.pop_back();
    EXPECT_EQ(points, optimised(sphere));
}

TEST(Optimisation, IsDeterministicAndComesToRest) {
    for (const auto& [name, soup] : disturbed_shapes(7)) {
        SCOPED_TRACE(name);
        EXPECT_EQ(optimised(soup), optimised(soup));
        const std::vector<Vec3> rest = optimised(soup, {.sweeps = 500});
        EXPECT_EQ(rest, optimised(soup, {.sweeps = 501}));
        EXPECT_EQ(optimised(soup, {.sweeps = 0}), soup.vertices);
    }
    EXPECT_TRUE(optimise_nodes({}, {}, {}, {}).empty());
}

TEST(Optimisation, PowersOfTwoScaleTheResult) {
    for (const auto& [name, soup] : disturbed_shapes(3)) {
        SCOPED_TRACE(name);
        Soup small = soup;
        for (Vec3& p : small.vertices) p *= std::ldexp(1.0, -20);
        std::vector<Vec3> points = optimised(small);
        for (Vec3& p : points) p *= std::ldexp(1.0, 20);
        EXPECT_EQ(points, optimised(soup));
    }
}

TEST(ClosestPoint, IsTheBestOfManyPointsOfTheTriangle) {
    std::mt19937 random(11);
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const Vec3 a = random_vector(random), b = random_vector(random), c = random_vector(random),
                   p = 2 * random_vector(random);
        const Vec3 t = closest_barycentric(p, a, b, c);
        EXPECT_GE(t.minCoeff(), 0);
        EXPECT_NEAR(t.sum(), 1, 1e-14);
        double least = 10;
        for (int j = 0; j <= 20; ++j)
            for (int k = 0; j + k <= 20; ++k)
                least = std::min(least, (p - (a * j + b * k + c * (20 - j - k)) / 20).norm());
        const double distance = point_triangle_distance(p, a, b, c);
        EXPECT_LE(distance, least + 1e-14);
        EXPECT_GE(distance, least - 0.15);  // the points are that dense
    }
}

}  // namespace
}  // namespace kerf
