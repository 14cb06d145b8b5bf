// Laws of the remesher where more than two facets meet in an edge: regions stay what they were, touch as they did, and
// have the same walls in common.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "base/geometry/triangle.h"
#include "run/prepare/inside/labelled_facets.h"
#include "support/slice.h"
#include "support/voxel_regions.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/intersections.h"
#include "surface/remesh/inside/sheets.h"
#include "surface/remesh/remesh.h"
#include "surface/soup/edge_corners.h"

namespace kerf {
namespace {

using Cube = std::array<std::int32_t, 3>;
using Warp = Vec3 (*)(const Vec3&);

constexpr std::int32_t fineness = 3;

Vec3 as_it_is(const Vec3& p) { return p; }
Vec3 bent(const Vec3& p) {
    return p + 0.3 * Vec3(std::sin(p.y() / 3 + p.z() / 4), std::sin(p.z() / 3 + p.x() / 5), std::sin(p.x() / 4));
}
// Layers of 0.3 that go up and down by more than that.
Vec3 pressed(const Vec3& p) { return {p.x(), p.y(), 0.1 * p.z() + 0.3 * std::sin(p.x() + p.y() / 2)}; }
// Facets with angles of a few degrees.
Vec3 flattened(const Vec3& p) { return {p.x(), p.y(), 0.1 * p.z()}; }

Complex complex_of(const test::TouchingBodies& bodies, Warp warp) {
    const Cube cubes = {fineness * bodies.cubes[0], fineness * bodies.cubes[1], fineness * bodies.cubes[2]};
    test::VoxelBody body = test::voxel_body(cubes, test::refined(bodies.region, fineness));
    for (Vec3& p : body.facets.vertices) p = warp(p);
    return test::to_complex(body);
}

std::vector<double> volumes_of(const Complex& complex) {
    std::vector<double> volumes;
    for (std::int32_t r = 0; r < complex.region_count(); ++r) {
        const SurfaceArrays facets = complex.arrays_of(RegionIndex(r));
        volumes.push_back(enclosed_volume(facets.vertices, facets.facets));
    }
    return volumes;
}

// Vertices less half the facets, of a region taken apart where it touches itself.
std::vector<int> euler_numbers_of(const Complex& complex) {
    std::vector<int> numbers;
    for (std::int32_t r = 0; r < complex.region_count(); ++r) {
        const Surface surface = complex.surface_of(RegionIndex(r));
        numbers.push_back(surface.vertex_count() - surface.facet_count() / 2);
    }
    return numbers;
}

// Of what two regions, or one and the outside, have in common.
std::map<std::array<RegionIndex, 2>, double> areas_of(const Complex& complex) {
    std::map<std::array<RegionIndex, 2>, double> areas;
    const SurfaceArrays facets = complex.arrays();
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const auto [front, back] = complex.sides(f);
        areas[{std::min(front, back), std::max(front, back)}] += triangle_area(facets.vertices, facets.facets[f]);
    }
    return areas;
}

double seam_length(const Complex& complex) {
    const SurfaceArrays facets = complex.arrays();
    double length = 0;
    EdgeCorners(facets.facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() != 2) length += (facets.vertices[low] - facets.vertices[corners[0].high]).norm();
    });
    return length;
}

double least_sine(const SurfaceArrays& surface) {
    double least = 1;
    for (const Triangle& t : surface.facets)
        least = std::min(least, smallest_sine(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]));
    return least;
}

struct ComplexCase {
    test::TouchingBodies bodies;
    const char* shape;
    Warp warp;
    double deviation, longest;
};

std::vector<ComplexCase> complex_cases() {
    std::vector<ComplexCase> all;
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        all.push_back({bodies, "bent", bent, 0.1, 3});
        if (test::in_slices()) continue;
        all.push_back({bodies, "pressed", pressed, 0.2, 2});
        all.push_back({bodies, "cubes", as_it_is, 0.01, 4});
        all.push_back({bodies, "coarse", bent, 1.5, 6});
        all.push_back({bodies, "finer", as_it_is, 0.05, 0.7});
        all.push_back({bodies, "bent_little", bent, 0.002, 3});
        all.push_back({bodies, "flattened", flattened, 0.002, 1});
    }
    return all;
}

class RemeshComplex : public testing::TestWithParam<ComplexCase> {};
INSTANTIATE_TEST_SUITE_P(Bodies, RemeshComplex, testing::ValuesIn(complex_cases()), [](const auto& param) {
    return std::string(param.param.bodies.name) + "_" + param.param.shape;
});

TEST_P(RemeshComplex, KeepsRegionsWallsAndSeams) {
    const auto& [bodies, shape, warp, deviation, longest] = GetParam();
    const Complex before = complex_of(bodies, warp);
    const LabelledFacets facets = label_facets(before);
    const RemeshOptions options = {.deviation = deviation, .longest = longest, .walls = facets.walls};
    const Remeshed remeshed = remesh(facets.surface, options);
    EXPECT_TRUE(find_self_intersections(remeshed.surface.vertices, remeshed.surface.facets).empty());
    EXPECT_LE(remeshed.report.distance_to_input, deviation);
    EXPECT_LE(remeshed.report.distance_from_input, deviation);
    EXPECT_GE(least_sine(remeshed.surface), std::min(0.2, least_sine(facets.surface)));
    if (warp == flattened) {
        EXPECT_EQ(remesh(facets.surface, options).surface.vertices, remeshed.surface.vertices);
    }

    std::vector<std::string> names = {before.region_names().begin(), before.region_names().end()};
    const Complex after = facets.to_complex(remeshed.surface, names);
    EXPECT_EQ(euler_numbers_of(after), euler_numbers_of(before));
    const std::vector<double> volumes = volumes_of(before), new_volumes = volumes_of(after);
    const auto areas = areas_of(before), new_areas = areas_of(after);
    double area = 0;
    for (const auto& [sides, part] : areas) area += part;
    for (std::size_t r = 0; r < volumes.size(); ++r) EXPECT_NEAR(new_volumes[r], volumes[r], deviation * area);
    ASSERT_EQ(new_areas.size(), areas.size());
    for (const auto& [sides, part] : areas) EXPECT_NEAR(new_areas.at(sides), part, 0.05 * part + deviation);
    EXPECT_NEAR(seam_length(after), seam_length(before), 0.05 * seam_length(before));
    if (warp == as_it_is) {  // nothing but flat facets and straight seams: nothing moves
        for (std::size_t r = 0; r < volumes.size(); ++r) EXPECT_NEAR(new_volumes[r], volumes[r], 1e-9 * volumes[r]);
        EXPECT_NEAR(seam_length(after), seam_length(before), 1e-9 * seam_length(before));
    }
}

TEST(RemeshComplex, KeepsTheFacetsThatAreToStay) {
    const Complex before = complex_of(test::touching_bodies()[2], bent);
    const LabelledFacets facets = label_facets(before);
    RemeshOptions options = {.deviation = 0.1, .longest = 3, .walls = facets.walls};
    for (std::size_t f = 0; f < facets.surface.facets.size(); ++f) {
        const Triangle& t = facets.surface.facets[f];
        options.kept.push_back(facets.surface.vertices[t[0]].x() > 3);
    }
    const SurfaceArrays after = remesh(facets.surface, options).surface;
    const auto corners_of = [](const SurfaceArrays& surface, std::size_t f) {
        std::array<std::array<double, 3>, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& p = surface.vertices[surface.facets[f][i]];
            corners[i] = {p.x(), p.y(), p.z()};
        }
        std::sort(corners.begin(), corners.end());
        return corners;
    };
    std::vector<std::array<std::array<double, 3>, 3>> all;
    for (std::size_t f = 0; f < after.facets.size(); ++f) all.push_back(corners_of(after, f));
    std::sort(all.begin(), all.end());
    for (std::size_t f = 0; f < options.kept.size(); ++f)
        if (options.kept[f] != 0) {
            EXPECT_TRUE(std::binary_search(all.begin(), all.end(), corners_of(facets.surface, f))) << "facet " << f;
        }
    EXPECT_NO_THROW(facets.to_complex(after, {before.region_names().begin(), before.region_names().end()}));
}

TEST(Sheets, AreManifoldsThatEndAtSeams) {
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        SCOPED_TRACE(bodies.name);
        const SurfaceArrays facets = label_facets(complex_of(bodies, as_it_is)).surface;
        const Sheets sheets = take_apart(facets);
        EXPECT_EQ(sheets.facets_before(), facets.facets);
        EXPECT_EQ(sheets.vertices_before, facets.vertices.size());
        for (std::size_t v = 0; v < sheets.original.size(); ++v)
            EXPECT_EQ(sheets.surface.vertices[v], facets.vertices[sheets.original[v]]);
        for (const ManifoldDefect& defect :
             find_manifold_defects(sheets.surface.vertices.size(), sheets.surface.facets))
            EXPECT_EQ(defect.kind, ManifoldDefect::Kind::open_edge);
    }
}

}  // namespace
}  // namespace kerf
