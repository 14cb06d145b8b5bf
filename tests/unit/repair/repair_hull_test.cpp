// The oracle: unit cubes, each with facets of its own. What they enclose together is known, and so is its boundary.
#include "surface/arrange/hull.h"

#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "support/voxels.h"
#include "surface/arrange/shell_turning.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

Soup cubes_of(const test::Voxels& voxels, int n) {
    Soup soup;
    for (const auto& [i, j, k] : voxels)
        soup = test::join(std::move(soup), test::box(Vec3(i, j, k), Vec3(i + 1, j + 1, k + 1), n));
    weld_exactly(soup);
    return soup;
}

std::vector<Triangle> hull_of(const Soup& soup) {
    const std::vector<HullFate> fate = find_hull(soup.vertices, soup.facets);
    std::vector<Triangle> hull;
    for (std::size_t f = 0; f < fate.size(); ++f) {
        if (fate[f] != HullFate::stays && fate[f] != HullFate::turns) continue;
        hull.push_back(soup.facets[f]);
        if (fate[f] == HullFate::turns) std::swap(hull.back()[1], hull.back()[2]);
    }
    return hull;
}

// Corners in an order that their set and direction tell.
std::vector<Triangle> canonical(std::vector<Triangle> facets) {
    for (Triangle& t : facets) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(facets.begin(), facets.end());
    return facets;
}

std::int64_t count_of(const std::vector<HullFate>& fates, HullFate fate) {
    return std::count(fates.begin(), fates.end(), fate);
}

void turn(Soup& soup, const std::vector<char>& turned) {
    for (std::size_t f = 0; f < turned.size(); ++f)
        if (turned[f]) std::swap(soup.facets[f][1], soup.facets[f][2]);
}

TEST(Hull, OfCubesSideBySideIsTheirBoundary) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        test::SeededNumbers random(seed);
        const test::Voxels voxels = test::random_voxels(4, 0.1 + 0.07 * static_cast<double>(seed), random);
        const Soup cubes = cubes_of(voxels, 1 + static_cast<int>(seed % 2));
        const std::vector<Triangle> hull = hull_of(cubes);
        Soup expected = cubes;
        test::cancel_common_facets(expected);
        EXPECT_EQ(canonical(hull), canonical(expected.facets));
        EXPECT_NEAR(enclosed_volume(cubes.vertices, hull), static_cast<double>(voxels.size()), 1e-9);
    }
}

TEST(Hull, OfCopiesIsOneOfThem) {
    test::SeededNumbers random(5);
    const Soup once = test::voxel_surface(test::random_voxels(3, 0.6, random), 2);
    Soup thrice = test::join(test::join(once, once), once);
    weld_exactly(thrice);
    const std::vector<HullFate> fates = find_hull(thrice.vertices, thrice.facets);
    EXPECT_EQ(count_of(fates, HullFate::stays), std::ssize(once.facets));
    EXPECT_EQ(count_of(fates, HullFate::copy), 2 * std::ssize(once.facets));
    EXPECT_EQ(canonical(hull_of(thrice)), canonical(once.facets));
}

TEST(Hull, PrefersTheCopyThatIsRight) {
    const Soup once = test::icosphere(2);
    // The first copy is inside out, and the two others outvote it.
    Soup soup = test::join(test::join(test::inside_out(once), once), once);
    weld_exactly(soup);
    const std::vector<HullFate> fates = find_hull(soup.vertices, soup.facets);
    EXPECT_EQ(count_of(fates, HullFate::stays), std::ssize(once.facets));
    EXPECT_EQ(count_of(fates, HullFate::turns), 0);
    EXPECT_EQ(fates[0], HullFate::copy);
}

TEST(Hull, KeepsCleanSurfaces) {
    Soup hollow = test::join(test::icosphere(3, 2), test::inside_out(test::icosphere(2, 1)));
    hollow = test::join(hollow, test::icosphere(1, 0.5));
    for (const Soup& soup : {test::box(), test::torus(3, 1, 30, 20), test::plate_with_hole(24), hollow}) {
        const std::vector<HullFate> fates = find_hull(soup.vertices, soup.facets);
        EXPECT_EQ(count_of(fates, HullFate::stays), std::ssize(soup.facets));
    }
}

TEST(Hull, LeavesOutWhatIsInside) {
    const Soup outer = test::icosphere(3, 2);
    const Soup soup = test::join(outer, test::icosphere(2, 1));
    EXPECT_EQ(canonical(hull_of(soup)), canonical(outer.facets));
}

TEST(Hull, LeavesOutWhatBoundsNothing) {
    const Soup body = test::icosphere(3);
    Soup sheet = test::box(Vec3(3, 3, 3), Vec3(4, 4, 4), 4);
    std::erase_if(sheet.facets, [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return sheet.vertices[v].z() > 3; });
    });
    sheet.patch.resize(sheet.facets.size(), 0);
    const Soup soup = test::join(body, sheet);
    EXPECT_EQ(canonical(hull_of(soup)), canonical(body.facets));
}

// A side of a cube in the midst of a body is inside, however many facets the boundary lacks.
TEST(Hull, IsTheSameWhereFacetsAreMissing) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        test::SeededNumbers random(seed);
        Soup cubes =
            cubes_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}, 4);
        Soup boundary = cubes;
        test::cancel_common_facets(boundary);
        const std::vector<Triangle> bounds = canonical(boundary.facets);
        const auto is_of_boundary = [&](const Triangle& t) {
            return std::binary_search(bounds.begin(), bounds.end(), canonical({t})[0]);
        };
        std::erase_if(cubes.facets, [&](const Triangle& t) { return is_of_boundary(t) && random.with_chance(0.1); });
        std::vector<Triangle> expected;
        std::copy_if(cubes.facets.begin(), cubes.facets.end(), std::back_inserter(expected), is_of_boundary);
        EXPECT_LT(expected.size(), bounds.size());
        // A facet whose neighbours are missing may go.
        std::vector<Triangle> differ;
        const std::vector<Triangle> hull = canonical(hull_of(cubes)), wanted = canonical(expected);
        std::set_symmetric_difference(hull.begin(), hull.end(), wanted.begin(), wanted.end(),
                                      std::back_inserter(differ));
        EXPECT_LE(differ.size(), 1U) << seed;
    }
}

TEST(ShellTurning, LeavesWhatIsRight) {
    const Soup hollow = test::join(test::icosphere(3, 2), test::inside_out(test::icosphere(2, 1)));
    const Soup nested = test::join(test::icosphere(3, 2), test::icosphere(2, 1));
    for (const Soup& soup : {test::box(), test::torus(3, 1, 30, 20), hollow, nested}) {
        const std::vector<char> turned = find_turned_facets(soup.vertices, soup.facets);
        EXPECT_EQ(std::count(turned.begin(), turned.end(), 1), 0);
    }
}

TEST(ShellTurning, TurnsShellsWithWhatIsInThem) {
    const Soup hollow = test::join(test::icosphere(3, 2), test::inside_out(test::icosphere(2, 1)));
    const Soup beside = test::translated(test::icosphere(2), Vec3(5, 0, 0));
    for (const bool is_other_right : {false, true}) {
        Soup soup = test::join(test::inside_out(hollow), is_other_right ? beside : test::inside_out(beside));
        turn(soup, find_turned_facets(soup.vertices, soup.facets));
        EXPECT_EQ(soup.facets, test::join(hollow, beside).facets);
    }
}

TEST(ShellTurning, UndoesFacetsTurnedByChance) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        test::SeededNumbers random(seed);
        // Bodies through each other, a third of the facets of each turned; the last one is inside out.
        Soup right = test::join(test::icosphere(2), test::translated(test::icosphere(2), Vec3(1.2, 0.1, 0.05)));
        right = test::join(right, test::translated(test::box(Vec3::Zero(), Vec3::Ones(), 5), Vec3(0.4, 0.9, 0.3)));
        Soup soup = right;
        for (std::size_t f = 0; f < soup.facets.size(); ++f)
            if (random.with_chance(0.3) != (f >= 640)) std::swap(soup.facets[f][1], soup.facets[f][2]);
        turn(soup, find_turned_facets(soup.vertices, soup.facets));
        EXPECT_EQ(soup.facets, right.facets);
    }
}

}  // namespace
}  // namespace kerf
