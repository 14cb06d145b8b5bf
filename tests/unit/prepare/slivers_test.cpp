// What a run does by default with facets that would spoil its cells.
#include "run/prepare/slivers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "run/prepare/inside/periodicity.h"
#include "run/prepare/inside/thin_layers.h"
#include "run/prepare/remeshing.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "support/voxel_regions.h"
#include "surface/diagnosis/intersections.h"
#include "surface/remesh/remesh.h"

namespace kerf {
namespace {

// A ball with needles: facets, `spacing` apart, are divided at a point that is next to the middle of their first edge.
SurfaceArrays ball_with_needles(std::size_t spacing) {
    Soup soup = test::icosphere(4);
    const std::size_t facets = soup.facets.size();
    for (std::size_t f = 0; f < facets; f += spacing) {
        const Triangle t = soup.facets[f];
        const Vec3 &a = soup.vertices[t[0]], &b = soup.vertices[t[1]], &c = soup.vertices[t[2]];
        const auto v = static_cast<std::int32_t>(soup.vertices.size());
        soup.vertices.emplace_back(0.49 * a + 0.49 * b + 0.02 * c);
        soup.facets[f] = {t[0], t[1], v};
        soup.facets.push_back({t[1], t[2], v});
        soup.facets.push_back({t[2], t[0], v});
    }
    soup.patch.assign(soup.facets.size(), 0);
    return test::to_arrays(soup);
}

Input input_of(SurfaceArrays surface) {
    Input input;
    input.complex = Complex(Surface(std::move(surface)));
    measure_input(input);
    input.diagonal = 2 * std::sqrt(3.);
    input.patch_names = {"surface"};
    return input;
}

std::multiset<std::array<double, 9>> corners_of(const SurfaceArrays& surface) {
    std::multiset<std::array<double, 9>> all;
    for (const Triangle& t : surface.facets) {
        const auto first = std::min_element(t.begin(), t.end(), [&](std::int32_t v, std::int32_t w) {
            const Vec3 &p = surface.vertices[v], &q = surface.vertices[w];
            return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
        });
        std::array<double, 9> corners;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corners[3 * i + k] = surface.vertices[t[((first - t.begin()) + i) % 3]][k];
        all.insert(corners);
    }
    return all;
}

TEST(Slivers, FewAreRemeshedAloneAndManyWithAll) {
    for (const auto& [spacing, are_few] : {std::pair<std::size_t, bool>{400, true}, {150, true}, {5, false}}) {
        SCOPED_TRACE(spacing);
        const SurfaceArrays before = ball_with_needles(spacing);
        const Slivers slivers = find_slivers(before.vertices, before.facets);
        ASSERT_TRUE(slivers.spoil_cells());
        EXPECT_EQ(find_slivers(input_of(before).complex).count, slivers.count);
        const std::vector<char> kept = facets_away_from_slivers(before);
        EXPECT_EQ(kept.empty(), !are_few);
        const Input result = remesh_where_asked(input_of(before), {});
        ASSERT_TRUE(result.remeshed);
        ASSERT_EQ(result.notes.size(), 1U) << "nobody has asked for it";
        EXPECT_NE(result.notes[0].find("--surface split keeps the facets"), std::string::npos);
        const SurfaceArrays after = result.complex.arrays();
        EXPECT_EQ(find_slivers(after.vertices, after.facets).count, 0);
        EXPECT_TRUE(find_self_intersections(after.vertices, after.facets).empty());
        EXPECT_EQ(result.remeshed->facets_kept, std::count(kept.begin(), kept.end(), char{1}));
        const auto old_facets = corners_of(before), new_facets = corners_of(after);
        std::size_t same = 0;
        for (const auto& facet : old_facets) same += new_facets.count(facet);
        EXPECT_GE(same, static_cast<std::size_t>(result.remeshed->facets_kept));
    }
}

TEST(Slivers, KeptFacetsStayWhateverTheyAre) {
    const SurfaceArrays surface = ball_with_needles(30);
    for (const std::int32_t first : test::slice({0, 1, 2, 3}, {0})) {
        RemeshOptions options = {.deviation = 1e-3, .longest = 0.05};
        options.kept.assign(surface.facets.size(), 0);
        for (auto f = static_cast<std::size_t>(first); f < surface.facets.size(); f += 4) options.kept[f] = 1;
        const auto new_facets = corners_of(remesh(surface, options).surface);
        SurfaceArrays kept = surface;
        kept.facets.clear();
        for (auto f = static_cast<std::size_t>(first); f < surface.facets.size(); f += 4)
            kept.facets.push_back(surface.facets[f]);
        for (const auto& facet : corners_of(kept)) EXPECT_EQ(new_facets.count(facet), 1U);
    }
}

TEST(Slivers, WellShapedFacetsAndThoseThatShallStayDoStay) {
    const SurfaceArrays good = test::to_arrays(test::icosphere(4)), bad = ball_with_needles(5);
    RunRequest split;
    split.remeshing = Remeshing::never;
    for (const auto& [surface, options] : {std::pair(good, RunRequest()), std::pair(bad, split)}) {
        const Input result = remesh_where_asked(input_of(surface), options);
        EXPECT_FALSE(result.remeshed);
        EXPECT_EQ(corners_of(result.complex.arrays()), corners_of(surface));
        EXPECT_EQ(result.notes.empty(), &surface == &good || find_slivers(surface.vertices, surface.facets).count == 0);
    }
}

std::int64_t thin_count(const Complex& complex) {
    const std::vector<char> is_thin = facets_on_thin_layers(label_facets(complex));
    return std::count(is_thin.begin(), is_thin.end(), char{1});
}

// The largest circle in half a square has a radius of 0.29.
TEST(ThinLayers, AreRemeshedWhereFacetsAreTooWideForThem) {
    for (const double thickness : {0.03, 0.2}) {
        SCOPED_TRACE(thickness);
        test::VoxelBody body = test::voxel_body({1, 1, 3}, [](const auto& cube) { return cube[2]; });
        for (Vec3& p : body.facets.vertices) p.z() *= thickness;
        Input input = make_input(body.facets.vertices, body.facets.facets, body.sides, body.names, body.facets.patch);
        const bool is_thin = thickness < 0.05;
        EXPECT_EQ(thin_count(input.complex), is_thin ? 8 : 0);
        const Input result = remesh_where_asked(input, {});
        ASSERT_EQ(result.remeshed.has_value(), is_thin);
        if (!is_thin) continue;
        EXPECT_EQ(thin_count(result.complex), 0);
        EXPECT_EQ(result.complex.region_count(), 3);
        ASSERT_EQ(result.notes.size(), 1U);
        EXPECT_NE(result.notes[0].find("so wide beside a thin region"), std::string::npos) << result.notes[0];
        RunRequest split;
        split.remeshing = Remeshing::never;
        EXPECT_FALSE(remesh_where_asked(input, split).remeshed);
    }
}

// A cube whose opposite sides match and are curved, with needles at the same places of the two along x.
SurfaceArrays volume_element(int n, const Vec3& period, std::size_t needles) {
    Soup soup = test::box(Vec3::Zero(), Vec3::Ones(), {n, n, n});
    const std::size_t facets = soup.facets.size();
    const auto lies_above = [&](std::size_t f, std::size_t g) {  // true if g lies one edge of the cube above f
        const auto has = [&](const Vec3& p) {
            return std::any_of(soup.facets[g].begin(), soup.facets[g].end(),
                               [&](std::int32_t v) { return (soup.vertices[v] - p).norm() < 1e-9; });
        };
        return std::all_of(soup.facets[f].begin(), soup.facets[f].end(),
                           [&](std::int32_t v) { return has(soup.vertices[v] + Vec3::UnitX()); });
    };
    const auto divide = [&](std::size_t f, const Vec3& p) {
        const auto [a, b, c] = soup.facets[f];
        const auto v = static_cast<std::int32_t>(soup.vertices.size());
        soup.vertices.push_back(p);
        soup.facets[f] = {a, b, v};
        soup.facets.push_back({b, c, v});
        soup.facets.push_back({c, a, v});
    };
    for (std::size_t f = 0; f < facets && needles > 0; f += 7)
        for (std::size_t g = 0; g < facets; ++g) {
            if (!lies_above(f, g)) continue;
            const Triangle t = soup.facets[f];
            const Vec3 p = 0.49 * soup.vertices[t[0]] + 0.49 * soup.vertices[t[1]] + 0.02 * soup.vertices[t[2]];
            divide(g, p + Vec3::UnitX());
            divide(f, p);
            --needles;
            break;
        }
    for (Vec3& p : soup.vertices) {
        const auto wave = [](double x) { return std::sin(2 * std::numbers::pi * x); };
        p = (p + Vec3(0.05 * wave(p.y()) * wave(p.z()), 0.03 * wave(p.z()), 0)).cwiseProduct(period);
    }
    soup.patch.assign(soup.facets.size(), 0);
    return test::to_arrays(soup);
}

TEST(Periodicity, IsFoundOfSidesThatMatch) {
    for (const int n : {4, 7})
        for (const Vec3& period : {Vec3(1, 1, 1), Vec3(3, 1, 0.5), Vec3(1e-6, 2e-6, 1e-6)}) {
            SCOPED_TRACE(testing::Message() << n << " of " << period.transpose());
            const SurfaceArrays surface = volume_element(n, period, 3);
            const auto found = find_periodicity(surface.vertices, surface.facets);
            ASSERT_TRUE(found);
            EXPECT_LT((found->period - period).norm(), 1e-5 * period.norm());
            EXPECT_EQ(found->paired_facets(), std::ssize(surface.facets));
        }
    const Soup plate = test::box(Vec3::Zero(), Vec3(1, 1, 0.1), {9, 9, 1});
    for (const Soup& soup : {test::icosphere(3), test::torus(3, 1, 30, 20), test::prism(60, 1, 2), test::box(), plate})
        EXPECT_FALSE(find_periodicity(soup.vertices, soup.facets));
}

// Only slivers that are few stay for that.
TEST(RemeshWhereAsked, KeepsSidesThatMatch) {
    const SurfaceArrays surface = volume_element(8, Vec3::Ones(), 5);
    ASSERT_TRUE(find_slivers(surface.vertices, surface.facets).spoil_cells());
    const Input result = remesh_where_asked(input_of(surface), {});
    EXPECT_EQ(corners_of(result.complex.arrays()), corners_of(surface));
    EXPECT_NE(result.notes.back().find("Opposite sides match, 1, 1 and 1 apart"), std::string::npos);
    EXPECT_NE(result.notes.back().find("they still do"), std::string::npos);

    RunRequest sized;
    sized.sizes.max_volume = 1e-4;
    const Input finer = remesh_where_asked(input_of(surface), sized);
    EXPECT_NE(finer.notes.back().find("remeshed, they do not"), std::string::npos) << finer.notes.back();
}

}  // namespace
}  // namespace kerf
