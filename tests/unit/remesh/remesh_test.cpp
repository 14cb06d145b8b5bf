// Laws of the remesher over random surfaces: whatever is given, the result is closed, free of intersections, near the
// input both ways, of the same topology and patches, and no worse shaped.
#include "surface/remesh/remesh.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/thread_limit.h"
#include "base/geometry/closest_point.h"
#include "run/prepare/remeshing.h"
#include "run/prepare/slivers.h"
#include "run/report/listener.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/intersections.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {
namespace {

double diagonal_of(const SurfaceArrays& surface) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.vertices) box.extend(p);
    return box.diagonal().norm();
}

RemeshOptions within(const SurfaceArrays& surface, double share) {
    const double diagonal = diagonal_of(surface);
    return {.deviation = share * diagonal, .longest = 0.1 * diagonal};
}

std::vector<double> sorted_sines(const SurfaceArrays& surface) {
    std::vector<double> sines;
    for (const Triangle& t : surface.facets)
        sines.push_back(smallest_sine(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]));
    std::sort(sines.begin(), sines.end());
    return sines;
}

// The largest distance of points of `from`, ten on each edge, from `to`.
double distance_between(const SurfaceArrays& from, const SurfaceArrays& to) {
    constexpr int n = 10;
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

std::map<std::int32_t, double> areas_of_patches(const SurfaceArrays& surface) {
    std::map<std::int32_t, double> areas;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const Triangle& t = surface.facets[f];
        const Vec3& a = surface.vertices[t[0]];
        areas[surface.patch[f]] += (surface.vertices[t[1]] - a).cross(surface.vertices[t[2]] - a).norm() / 2;
    }
    return areas;
}

int euler_number(const SurfaceArrays& surface) {
    return static_cast<int>(surface.vertices.size()) - static_cast<int>(surface.facets.size()) / 2;
}

void obeys_the_laws(const SurfaceArrays& input, const SurfaceArrays& result, double deviation) {
    EXPECT_TRUE(is_well_formed(result));
    EXPECT_TRUE(find_manifold_defects(result.vertices.size(), result.facets).empty());
    EXPECT_TRUE(find_self_intersections(result.vertices, result.facets).empty());
    EXPECT_EQ(euler_number(result), euler_number(input));
    constexpr double rounding = 1 + 1e-9;
    EXPECT_LE(distance_between(result, input), rounding * deviation);
    EXPECT_LE(distance_between(input, result), rounding * deviation);
    const auto before = areas_of_patches(input), after = areas_of_patches(result);
    EXPECT_EQ(before.size(), after.size());
    const std::vector<double> old_sines = sorted_sines(input), sines = sorted_sines(result);
    EXPECT_GE(sines[sines.size() / 100], std::min(0.1, old_sines[old_sines.size() / 100]));
}

// As a CAD program would write it: few vertices, triangles as long as the body.
Soup drilled_plate(int segments, double thickness) {
    Soup soup = test::plate_with_hole(segments);
    for (Vec3& p : soup.vertices) p.z() *= thickness;
    return soup;
}

struct RandomSurface {
    std::string name;
    SurfaceArrays surface;
};

RandomSurface random_surface(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const auto whole = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
    Soup soup;
    std::string name;
    switch (seed % 6) {
        case 0:
            name = "torus";
            soup = test::torus(1, uniform(0.05, 0.6), whole(5, 60), whole(4, 20));
            break;
        case 1:
            name = "plate with a hole";
            soup = drilled_plate(4 * whole(1, 8), uniform(0.02, 1));
            break;
        case 2:
            name = "prism of long strips";
            soup = test::prism(whole(5, 80), 1, uniform(0.05, 20));
            break;
        case 3:
            name = "sphere with sharp poles";
            soup = test::uv_sphere(whole(5, 30), whole(5, 60));
            break;
        case 4:
            name = "thin shell";
            soup = test::join(test::icosphere(2), test::inside_out(test::icosphere(2, uniform(0.9, 0.98))));
            break;
        default:
            name = "twisted cylinder";
            soup = test::twisted_cylinder(whole(8, 30), whole(3, 12), 1, uniform(1, 8), uniform(0, 1));
    }
    const Eigen::Quaterniond turn = Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 1).normalized();
    const double scale = std::pow(10, uniform(-3, 3));
    const Vec3 offset = seed % 2 == 0 ? Vec3(scale * Vec3(uniform(-30, 30), 20, -10)) : Vec3(Vec3::Zero());
    const Vec3 stretch = seed % 3 == 0 ? Vec3(1, uniform(0.1, 1), uniform(0.1, 1)) : Vec3(Vec3::Ones());
    for (Vec3& p : soup.vertices) p = scale * (turn * Vec3(p.cwiseProduct(stretch))) + offset;
    return {name, test::to_arrays(soup)};
}

TEST(Remesh, RandomSurfacesObeyTheLaws) {
    for (unsigned seed = 0; seed < test::slice(18); ++seed) {
        const auto [name, surface] = random_surface(seed);
        const double share = std::array{1e-2, 1e-3, 1e-4, 2e-5, 1e-6, 1e-7}[(seed / 6 + 2 * seed) % 6];
        SCOPED_TRACE(name + ", seed " + std::to_string(seed) + ", deviation " + std::to_string(share));
        const RemeshOptions options = within(surface, share);
        const Remeshed remeshed = remesh(surface, options);
        obeys_the_laws(surface, remeshed.surface, options.deviation);
        EXPECT_LE(remeshed.report.distance_to_input, options.deviation);
        EXPECT_LE(remeshed.report.distance_from_input, options.deviation);
        ASSERT_EQ(remeshed.places.size(), remeshed.surface.vertices.size());
        for (std::size_t v = 0; v < remeshed.places.size(); ++v) {
            const auto& [facet, point] = remeshed.places[v];
            const Triangle& t = surface.facets[facet];
            const double rounding = 1e-12 * (diagonal_of(surface) + point.norm());
            EXPECT_LE(
                point_triangle_distance(point, surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]),
                rounding);
            EXPECT_LE((remeshed.surface.vertices[v] - point).norm(), options.deviation);
        }
    }
}

TEST(Remesh, StripsAndFansBecomeWellShaped) {
    for (const Soup& soup : {test::prism(40, 1, 10), test::uv_sphere(20, 60), drilled_plate(16, 0.1)}) {
        const SurfaceArrays surface = test::to_arrays(soup);
        const std::vector<double> sines = sorted_sines(remesh(surface, within(surface, 2e-5)).surface);
        EXPECT_GT(sines.front(), 0.17);  // 10 degrees
        EXPECT_GT(sines[sines.size() / 2], 0.5);
    }
}

// A collapse would leave two facets back to back, of which a split makes facets that nothing is known of.
TEST(Remesh, ATetrahedronStaysABody) {
    for (const double height : {1., 0.1, 0.05, 0.02}) {
        SCOPED_TRACE(height);
        Soup soup;
        soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}};
        soup.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        soup.patch = {0, 0, 0, 0};
        const SurfaceArrays surface = test::to_arrays(soup);
        try {
            EXPECT_GE(remesh(surface, {.deviation = 0.05, .longest = 0.7}).surface.facets.size(), 4);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input);
        }
    }
}

// A block with a step of this height over half of its top.
SurfaceArrays stepped_block(double step) {
    const std::vector<Vec3> outline = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 1 + step, 0}, {0, 1 + step, 0}};
    constexpr int n = 6;
    Soup soup;
    for (const double z : {0., 1.})
        for (const Vec3& p : outline) soup.vertices.emplace_back(p.x(), p.y(), z);
    for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 5}, Triangle{3, 4, 5}}) {
        soup.facets.push_back({t[0], t[2], t[1]});
        soup.facets.push_back({t[0] + n, t[1] + n, t[2] + n});
    }
    for (int i = 0, j = 1; i < n; ++i, j = (i + 1) % n) {
        soup.facets.push_back({i, j, j + n});
        soup.facets.push_back({i, j + n, i + n});
    }
    soup.patch.assign(soup.facets.size(), 0);
    return test::to_arrays(soup);
}

TEST(Remesh, StepsBelowTheDeviationLeaveNoNeedles) {
    for (const double over_deviation : {0.02, 0.2, 0.5, 3., 30.}) {
        SCOPED_TRACE(over_deviation);
        constexpr double deviation = 1e-3;
        const SurfaceArrays surface = stepped_block(over_deviation * deviation);
        const Remeshed remeshed = remesh(surface, {.deviation = deviation, .longest = 0.2});
        obeys_the_laws(surface, remeshed.surface, deviation);
        EXPECT_GT(sorted_sines(remeshed.surface).front(), std::sin(20 / 57.3));
        if (over_deviation < 1) {
            EXPECT_LT(remeshed.surface.facets.size(), 1500U) << "nothing is as fine as the step";
        }
    }
}

TEST(Remesh, PlanesStayPlanesAndEdgesStayEdges) {
    const SurfaceArrays surface = test::to_arrays(test::box(Vec3::Zero(), Vec3(1, 2, 3), 1));
    const RemeshOptions options = within(surface, 1e-3);
    const Remeshed remeshed = remesh(surface, options);
    EXPECT_GT(remeshed.surface.facets.size(), 200U);
    for (const Vec3& p : remeshed.surface.vertices) {
        const double gap = std::min({p.x(), 1 - p.x(), p.y(), 2 - p.y(), p.z(), 3 - p.z()},
                                    [](double a, double b) { return std::abs(a) < std::abs(b); });
        EXPECT_NEAR(gap, 0, 1e-12);
    }
    EXPECT_NEAR(mass_properties(Surface(remeshed.surface)).volume, 6, 1e-11);
    EXPECT_GE(remeshed.report.feature_edges * 1.35 * options.longest, 24);
}

TEST(Remesh, CreasesOfTheModelStayFlatAsTheyAre) {
    const SurfaceArrays surface = test::to_arrays(test::box(Vec3::Zero(), Vec3(1, 2, 3), 1));
    RemeshOptions options = within(surface, 1e-3);
    const auto length_along = [&](UndirectedEdge crease) {
        const SurfaceArrays result = remesh(surface, options).surface;
        const Vec3 &from = surface.vertices[crease[0]], &to = surface.vertices[crease[1]];
        const auto is_on = [&](const Vec3& p) {
            return (p - from).norm() + (p - to).norm() < (to - from).norm() + 1e-9;
        };
        double length = 0;
        for (const Triangle& t : result.facets)
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 &p = result.vertices[t[i]], &q = result.vertices[t[(i + 1) % 3]];
                if (is_on(p) && is_on(q)) length += (q - p).norm() / 2;
            }
        return length / (to - from).norm();
    };
    for (const Triangle& t : {surface.facets[0], surface.facets[7]}) {
        UndirectedEdge diagonal = {};  // of a side of the box
        double longest = 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (const double length = (surface.vertices[t[i]] - surface.vertices[t[(i + 1) % 3]]).norm();
                length > longest) {
                longest = length;
                diagonal = {t[i], t[(i + 1) % 3]};
            }
        options.creases.clear();
        EXPECT_LT(length_along(diagonal), 0.9) << "else the test says nothing";
        options.creases = {diagonal};
        EXPECT_NEAR(length_along(diagonal), 1, 1e-9);
    }
}

TEST(Remesh, BordersOfPatchesStay) {
    Soup soup = test::box(Vec3::Zero(), Vec3::Ones(), 4);
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = static_cast<std::int32_t>(f % 5);
    soup.patch_names.assign(5, "patch");
    const SurfaceArrays surface = test::to_arrays(soup);
    const auto before = areas_of_patches(surface);
    const auto after = areas_of_patches(remesh(surface, within(surface, 1e-3)).surface);
    ASSERT_EQ(before.size(), after.size());
    for (const auto& [patch, area] : before) EXPECT_NEAR(after.at(patch), area, 1e-9);
}

TEST(Remesh, ObeysWantedLengths) {
    const SurfaceArrays surface = test::to_arrays(test::box(Vec3::Zero(), Vec3::Ones(), 1));
    RemeshOptions options = within(surface, 1e-4);
    options.longest = 0.3;
    options.wanted = [](const Vec3& p, std::int32_t) { return 0.02 + 0.3 * p.x(); };
    const SurfaceArrays result = remesh(surface, options).surface;
    std::size_t fitting = 0, edges = 0;
    for (const Triangle& t : result.facets)
        for (int i = 0; i < 3; ++i) {
            const Vec3 &a = result.vertices[t[i]], &b = result.vertices[t[(i + 1) % 3]];
            const double ratio = (b - a).norm() / std::min(0.3, options.wanted((a + b) / 2, 0));
            fitting += ratio > 0.5 && ratio < 1.5;
            ++edges;
        }
    EXPECT_GT(static_cast<double>(fitting), 0.9 * static_cast<double>(edges));
}

TEST(Remesh, OfARemeshedSurfaceChangesLittle) {
    const SurfaceArrays surface = test::to_arrays(test::prism(24, 1, 3));
    const RemeshOptions options = within(surface, 1e-4);
    const SurfaceArrays once = remesh(surface, options).surface, twice = remesh(once, options).surface;
    EXPECT_NEAR(static_cast<double>(twice.facets.size()), static_cast<double>(once.facets.size()),
                0.25 * static_cast<double>(once.facets.size()));
    EXPECT_GE(sorted_sines(twice).front(), 0.7 * sorted_sines(once).front());
}

// Each edge of a sphere of good triangles is a fold, and none of them asks for more of them.
TEST(Remesh, WellShapedSurfacesStayAsTheyAre) {
    for (const Soup& soup : {test::icosphere(3), test::torus(1, 0.4, 60, 24)}) {
        const SurfaceArrays surface = test::to_arrays(soup);
        const std::vector<double> before = sorted_sines(surface);
        for (const double share : {1e-3, 2e-5}) {
            const std::vector<double> after = sorted_sines(remesh(surface, within(surface, share)).surface);
            EXPECT_LT(static_cast<double>(after.size()), 1.1 * static_cast<double>(before.size()));
            EXPECT_GT(after[after.size() / 100], 0.9 * before[before.size() / 100]);
            EXPECT_GT(after[after.size() / 2], 0.9 * before[before.size() / 2]);
        }
    }
}

TEST(Remesh, IsTheSameEveryTime) {
    const SurfaceArrays surface = random_surface(5).surface;
    const SurfaceArrays a = remesh(surface, within(surface, 1e-4)).surface;
    const SurfaceArrays b = remesh(surface, within(surface, 1e-4)).surface;
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.facets, b.facets);
}

TEST(Remesh, CanBeEndedFromOutside) {
    const SurfaceArrays surface = test::to_arrays(test::prism(24, 1, 3));
    RemeshOptions options = within(surface, 1e-4);
    options.check_cancelled = [] { throw Error(ErrorCode::cancelled, "enough"); };
    EXPECT_THROW(remesh(surface, options), Error);
}

TEST(Slivers, AreThoseThatSpoilCells) {
    const Soup good = test::icosphere(2), bad = test::prism(60, 1, 20);
    EXPECT_FALSE(find_slivers(good.vertices, good.facets).spoil_cells());
    EXPECT_TRUE(find_slivers(bad.vertices, bad.facets).spoil_cells());
    EXPECT_EQ(sliver_note(find_slivers(good.vertices, good.facets), "--surface remesh"), "");
    const std::string note = sliver_note(find_slivers(bad.vertices, bad.facets), "--surface remesh");
    EXPECT_NE(note.find(" --surface remesh cures that."), std::string::npos);
}

// Is told of `steps_` steps, then wants the run to end.
class PatientListener : public RunListener {
 public:
    explicit PatientListener(std::size_t steps) : steps_(steps) {}
    void on_progress(const char* stage, std::size_t done, std::size_t total) override {
        EXPECT_STREQ(stage, "remesh");
        EXPECT_EQ(total, 100u);
        EXPECT_GE(done, last_);
        EXPECT_LE(done, total);
        last_ = done;
        ++told_;
    }
    bool cancelled() const override { return told_ >= steps_; }
    std::size_t told() const { return told_; }
    std::size_t last() const { return last_; }

 private:
    std::size_t steps_, told_ = 0, last_ = 0;
};

TEST(RemeshedInput, TellsOfItsStepsAndCanBeCancelledAtEach) {
    Input input;
    input.complex = Complex(test::to_surface(test::prism(12, 1, 3)));
    measure_input(input);
    input.diagonal = diagonal_of(input.complex.arrays());
    input.patch_names = {"below", "sides", "above"};
    RunRequest options;
    options.remeshing = Remeshing::always;
    const ThreadLimitGuard guard;
    set_thread_limit(1);  // with others, the steps of the caller's thread, which tells, depend on what is left to it
    PatientListener all(1'000'000);
    const Input remeshed = remesh_where_asked(input, options, &all);
    EXPECT_GT(all.told(), 5u);
    EXPECT_GT(all.last(), 50u);
    EXPECT_EQ(remeshed.complex.arrays().vertices, remesh_where_asked(input, options).complex.arrays().vertices);
    const auto ends_after = [&](std::size_t steps) {
        PatientListener listener(steps);
        try {
            remesh_where_asked(input, options, &listener);
            ADD_FAILURE() << "not cancelled at step " << steps;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
        EXPECT_EQ(listener.told(), steps);
    };
    for (const std::size_t steps : {std::size_t{0}, std::size_t{1}, all.told() / 2, all.told() - 1}) ends_after(steps);
    set_thread_limit(3);
    for (const std::size_t steps : {0, 1, 5}) ends_after(steps);
}

TEST(Deviation, IsALengthOrAShare) {
    EXPECT_DOUBLE_EQ(deviation_for(0.5, 100), 0.5);
    EXPECT_DOUBLE_EQ(deviation_for(Length::percent(0.01), 100), 0.01);
    for (const Length& wrong : {Length(0), Length(1e9), Length(1e-300), Length::percent(6)})
        EXPECT_THROW(deviation_for(wrong, 100), Error) << wrong.text();
}

// All facets, for every point.
TEST(TriangleTree, FindsTheClosestFacetAndTheFirstHit) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (const Soup& soup : {test::icosphere(2), test::prism(50, 1, 1e-9), test::torus(1, 0.3, 20, 9)}) {
        const TriangleTree tree(soup.vertices, soup.facets);
        for (int i = 0; i < 100; ++i) {
            const double x = uniform(random), y = uniform(random), z = uniform(random);
            const Vec3 p(x, y, z);
            double least = std::numeric_limits<double>::infinity();
            for (const Triangle& t : soup.facets)
                least = std::min(least,
                                 (p - closest_point(p, soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]))
                                     .squaredNorm());
            const TriangleTree::Closest closest = tree.closest(p);
            EXPECT_EQ(closest.squared_distance, least);
            EXPECT_EQ(tree.squared_distance_to(p, closest.facet), least);
            const auto any = [](std::int32_t, double) { return true; };
            EXPECT_TRUE(tree.any_within(p, std::sqrt(least) * (1 + 1e-12), any));
            EXPECT_FALSE(tree.any_within(p, std::sqrt(least) * (1 - 1e-9), any));
        }
    }
    const Soup cube = test::box();
    const TriangleTree tree(cube.vertices, cube.facets);
    const auto all = [](std::int32_t) { return true; };
    EXPECT_DOUBLE_EQ(tree.first_hit({0.3, 0.4, -2}, {0, 0, 1}, 0, 10, all), 2);
    EXPECT_DOUBLE_EQ(tree.first_hit({0.3, 0.4, -2}, {0, 0, 1}, 2.5, 10, all), 3);
    EXPECT_EQ(tree.first_hit({0.3, 0.4, -2}, {0, 0, 1}, 3.5, 10, all), std::numeric_limits<double>::infinity());
    EXPECT_EQ(tree.first_hit({3, 0.4, -2}, {0, 0, 1}, 0, 10, all), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace kerf
