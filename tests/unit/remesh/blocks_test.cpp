// Laws of blocks: what is divided and joined is the same surface, and what changes in blocks stays one.
#include "surface/remesh/inside/blocks.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "run/prepare/inside/labelled_facets.h"
#include "support/shapes.h"
#include "support/voxel_regions.h"
#include "surface/diagnosis/intersections.h"
#include "surface/remesh/inside/feature_merging.h"

namespace kerf {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

// The facets by the places of their corners, the smallest first.
std::vector<Corners> sorted_facets(const SurfaceArrays& surface) {
    std::vector<Corners> facets;
    for (const Triangle& t : surface.facets) {
        Corners& corners = facets.emplace_back();
        for (int i = 0; i < 3; ++i)
            corners[i] = {surface.vertices[t[i]].x(), surface.vertices[t[i]].y(), surface.vertices[t[i]].z()};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    }
    std::sort(facets.begin(), facets.end());
    return facets;
}

// What a BoundedSurface is of.
struct Given {
    SurfaceArrays surface;
    TriangleTree tree{surface.vertices, surface.facets};
    Nearness nearness{tree, surface.facets};
    Sheets sheets = take_apart(surface);
    std::vector<char> no_walls = {};
    InputShape shape{sheets, tree, nearness, find_tolerances(surface, tree, {.deviation = 0.05}), 30, {}, no_walls};

    explicit Given(SurfaceArrays arrays) : surface(std::move(arrays)) {}
};

Complex complex_of(const test::TouchingBodies& bodies) {
    constexpr std::int32_t n = 3;
    return test::to_complex(test::voxel_body({n * bodies.cubes[0], n * bodies.cubes[1], n * bodies.cubes[2]},
                                             test::refined(bodies.region, n)));
}

constexpr double facets_of_block = 40;

std::int32_t divide(SheetState& state, bool is_turned) {
    const std::size_t facets = state.arrays.facets.size();
    return divide_along_curve(state, std::vector<char>(facets, 1), std::vector<float>(facets, 1), facets_of_block,
                              is_turned);
}

TEST(Blocks, JoinedAreTheSurfaceThatWasDivided) {
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        SCOPED_TRACE(bodies.name);
        const Given given(label_facets(complex_of(bodies)).surface);
        SheetState state = sheet_state(given.shape, {});
        const std::int64_t features = count_features(state.arrays);
        for (const bool is_turned : {false, true}) {
            EXPECT_GT(divide(state, is_turned), 1);
            change_blocks(given.shape, state, [](BoundedSurface&) {});
        }
        const SurfaceArrays joined = joined_surface(state.arrays);
        EXPECT_EQ(joined.vertices.size(), given.surface.vertices.size());
        EXPECT_EQ(sorted_facets(joined), sorted_facets(given.surface));
        EXPECT_EQ(count_features(state.arrays), features);
    }
}

// Splits, collapses, flips and moves at random.
void change_at_random(BoundedSurface& surface, unsigned seed) {
    std::mt19937 random(seed);
    const SheetMesh& mesh = surface.mesh();
    for (int i = 0; i < 300; ++i) {
        const BoundedSurface::Edge e(static_cast<int>(random() % mesh.n_edges()));
        if (mesh.status(e).deleted()) continue;
        switch (random() % 4) {
            case 0:
                if (!mesh.is_fixed(e)) surface.split(e, 0.5);
                break;
            case 1:
                surface.collapse_either_way(e, {.good_sine = 0.1});
                break;
            case 2:
                surface.flip(e);
                break;
            default: {
                const auto [v, w] = mesh.ends(e);
                surface.move(v, 0.8 * mesh.point(v) + 0.2 * mesh.point(w), InputBound::Evidence::proof);
            }
        }
    }
}

TEST(Blocks, OfRegionsMayBeChangedByThemselves) {
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        SCOPED_TRACE(bodies.name);
        const Complex before = complex_of(bodies);
        const LabelledFacets facets = label_facets(before);
        const Given given(facets.surface);
        SheetState state = sheet_state(given.shape, {});
        for (const bool is_turned : {false, true, false}) {
            divide(state, is_turned);
            change_blocks(given.shape, state, [](BoundedSurface& surface) { change_at_random(surface, 7); });
        }
        SurfaceArrays after = joined_surface(state.arrays);
        EXPECT_NE(after.facets.size(), given.surface.facets.size());
        EXPECT_TRUE(is_well_formed(after));
        EXPECT_TRUE(find_self_intersections(after.vertices, after.facets).empty());
        std::vector<std::string> names(before.region_names().begin(), before.region_names().end());
        EXPECT_NO_THROW(facets.to_complex(std::move(after), std::move(names)));
    }
}

// All facets but those around one place are kept.
TEST(Blocks, ApartFromWhatIsKeptMayBeChangedAndJoined) {
    for (const test::TouchingBodies& bodies : test::touching_bodies()) {
        SCOPED_TRACE(bodies.name);
        const Complex before = complex_of(bodies);
        const LabelledFacets facets = label_facets(before);
        const Given given(facets.surface);
        std::vector<char> kept;
        const Vec3& place = given.surface.vertices.front();
        for (const Triangle& t : given.surface.facets)
            kept.push_back((given.surface.vertices[t[0]] - place).norm() > 2 ? 1 : 0);
        ASSERT_GT(2 * std::count(kept.begin(), kept.end(), char{1}), std::ssize(kept));
        SheetState state = sheet_state(given.shape, kept);
        change_apart_from_kept(state, [&](SheetState& near) {
            EXPECT_LT(near.arrays.facets.size(), given.surface.facets.size());
            std::vector<char> chosen;
            for (const SheetFacet& facet : near.arrays.facets) chosen.push_back(facet.is_kept ? 0 : 1);
            for (const bool is_turned : {false, true, false}) {
                divide_along_curve(near, chosen, std::vector<float>(chosen.size(), 1), 10, is_turned);
                change_blocks(given.shape, near, [](BoundedSurface& surface) { change_at_random(surface, 7); });
                chosen = facets_beside_borders(near);
            }
            change_at_once(given.shape, near, [](BoundedSurface& surface) { change_at_random(surface, 8); });
        });
        SurfaceArrays after = joined_surface(state.arrays);
        const std::vector<Corners> old_facets = sorted_facets(given.surface), new_facets = sorted_facets(after);
        EXPECT_NE(old_facets, new_facets);
        SurfaceArrays kept_ones = given.surface;
        kept_ones.facets.clear();
        for (std::size_t f = 0; f < kept.size(); ++f)
            if (kept[f] != 0) kept_ones.facets.push_back(given.surface.facets[f]);
        const std::vector<Corners> those_kept = sorted_facets(kept_ones);
        EXPECT_TRUE(std::includes(new_facets.begin(), new_facets.end(), those_kept.begin(), those_kept.end()));
        EXPECT_TRUE(is_well_formed(after));
        EXPECT_TRUE(find_self_intersections(after.vertices, after.facets).empty());
        std::vector<std::string> names(before.region_names().begin(), before.region_names().end());
        EXPECT_NO_THROW(facets.to_complex(std::move(after), std::move(names)));
    }
}

// A plate thinner than its tolerance has strips; a cube has none, for all its features that meet at corners.
TEST(NarrowStrips, AreSeenOnThePlateThatHasThem) {
    const auto has_strips = [](double thickness) {
        const Given given(test::to_arrays(test::box(Vec3::Zero(), Vec3(1, 1, thickness), {4, 4, 1})));
        return has_narrow_strips(sheet_state(given.shape, {}).arrays);
    };
    EXPECT_TRUE(has_strips(1e-4));
    EXPECT_FALSE(has_strips(1));
}

TEST(Blocks, BesideTheirBordersNoneHaveThemInCommon) {
    const Given given(test::to_arrays(test::icosphere(4)));
    SheetState state = sheet_state(given.shape, {});
    divide(state, false);
    std::vector<char> chosen = facets_beside_borders(state);
    EXPECT_LT(std::count(chosen.begin(), chosen.end(), char{1}), std::ssize(chosen));
    EXPECT_GT(divide_by_components(state, chosen, 1), 0);
    chosen = facets_beside_borders(state);
    EXPECT_EQ(std::count(chosen.begin(), chosen.end(), char{1}), 0);
}

}  // namespace
}  // namespace kerf
