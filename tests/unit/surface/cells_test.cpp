// The oracle: cubes with labels. Facets lie between different labels only, so cells are what hangs together over sides
// of cubes with one label, and those without a label that the outside does not reach.
#include "surface/regions/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

using Cube = std::array<std::int32_t, 3>;

// The component of each cube of a grid; -1: that of what is around the grid.
class CubeComponents {
 public:
    CubeComponents(const Cube& cubes, const test::RegionOfCube& region) : cubes_(cubes) {
        std::vector<std::int32_t> label;
        for_each([&](const Cube& c) { label.push_back(is_in_grid(c) ? region(c) : -1); });
        UnionFind sets(label.size());
        for_each([&](const Cube& c) {
            for (std::size_t i = 0; i < 3; ++i) {
                Cube other = c;
                if (++other[i] > cubes_[i]) continue;
                if (label[index(c)] == label[index(other)]) sets.join(index(c), index(other));
            }
        });
        components_ = sets.take();
    }
    std::int32_t of(const Cube& c) const { return components_.of[index(c)] - 1; }  // the first cube is around the grid
    std::int32_t count() const { return components_.count - 1; }
    std::vector<double> volumes() const {
        std::vector<double> volumes(count(), 0);
        for_each([&](const Cube& c) {
            if (of(c) >= 0) ++volumes[of(c)];
        });
        return volumes;
    }
    template <class Visit>
    void for_each(Visit visit) const {
        for (std::int32_t x = -1; x <= cubes_[0]; ++x)
            for (std::int32_t y = -1; y <= cubes_[1]; ++y)
                for (std::int32_t z = -1; z <= cubes_[2]; ++z) visit(Cube{x, y, z});
    }

 private:
    bool is_in_grid(const Cube& c) const {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) inside &= c[i] >= 0 && c[i] < cubes_[i];
        return inside;
    }
    std::int32_t index(const Cube& c) const {
        return ((c[0] + 1) * (cubes_[1] + 2) + c[1] + 1) * (cubes_[2] + 2) + c[2] + 1;
    }

    Cube cubes_;
    Components components_;
};

Cube cube_at(const SurfaceArrays& arrays, const Triangle& t, double distance) {
    const Vec3 centroid = (arrays.vertices[t[0]] + arrays.vertices[t[1]] + arrays.vertices[t[2]]) / 3;
    const Vec3 p = centroid + distance * doubled_area_vector(arrays.vertices, t).normalized();
    return {int(std::floor(p.x())), int(std::floor(p.y())), int(std::floor(p.z()))};
}

// `vertices`: where the arrays have been moved to. Cells and components must be the same but for their numbers.
void expect_components(const CubeComponents& cubes, const SurfaceArrays& arrays, const std::vector<Vec3>& vertices) {
    const std::optional<Cells> cells = find_cells(vertices, arrays.facets);
    ASSERT_TRUE(cells);
    ASSERT_EQ(cells->count, cubes.count());
    std::vector<std::int32_t> component(cells->count, -1);
    const auto expect_same = [&](std::int32_t cell, std::int32_t wanted, std::size_t f) {
        ASSERT_EQ(cell < 0, wanted < 0) << "facet " << f;
        if (cell < 0) return;
        if (component[cell] < 0) component[cell] = wanted;
        ASSERT_EQ(component[cell], wanted) << "facet " << f;
    };
    std::int32_t next = 0;
    for (std::size_t f = 0; f < arrays.facets.size(); ++f) {
        const auto [front, back] = cells->sides[f];
        expect_same(front, cubes.of(cube_at(arrays, arrays.facets[f], 0.3)), f);
        expect_same(back, cubes.of(cube_at(arrays, arrays.facets[f], -0.3)), f);
        for (const std::int32_t cell : {front, back}) {
            EXPECT_LE(cell, next) << "numbered by their smallest facets";
            next += cell == next;
        }
    }
    std::vector<std::int32_t> sorted = component;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (&vertices != &arrays.vertices) return;
    const std::vector<double> volumes = cubes.volumes(), found = cell_volumes(vertices, arrays.facets, *cells);
    for (std::int32_t c = 0; c < cells->count; ++c) EXPECT_NEAR(found[c], volumes[component[c]], 1e-9);
    const CellLocator locator(vertices, arrays.facets, *cells);
    cubes.for_each([&](const Cube& c) {
        const auto cell = locator.find(Vec3(c[0] + 0.5, c[1] + 0.25, c[2] + 0.375));
        ASSERT_TRUE(cell);
        EXPECT_EQ(*cell < 0 ? -1 : component[*cell], cubes.of(c));
    });
}

// The facets in another order, each with another first corner, and some turned.
SurfaceArrays mixed_up(const SurfaceArrays& arrays, unsigned seed) {
    std::mt19937 random(seed);
    SurfaceArrays other = arrays;
    std::shuffle(other.facets.begin(), other.facets.end(), random);
    for (Triangle& t : other.facets) {
        std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        if (random() % 2) std::swap(t[0], t[1]);
    }
    return other;
}

std::vector<Vec3> turned_and_stretched(std::vector<Vec3> vertices, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    Eigen::Matrix3d matrix;
    do
        for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = number(random);
    while (matrix.determinant() < 0.2);
    for (Vec3& p : vertices) p = matrix * p + Vec3(3, -20, 0.1);
    return vertices;
}

void expect_cells(const Cube& cubes, const test::RegionOfCube& region, unsigned seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CubeComponents components(cubes, region);
    const SurfaceArrays arrays = test::voxel_body(cubes, region).facets;
    expect_components(components, arrays, arrays.vertices);
    const SurfaceArrays other = mixed_up(arrays, seed);
    expect_components(components, other, other.vertices);
}

test::RegionOfCube random_labels(const Cube& cubes, std::int32_t count, double share_of_none, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(0, 1);
    std::vector<std::int32_t> labels;
    for (std::int32_t i = 0; i < cubes[0] * cubes[1] * cubes[2]; ++i)
        labels.push_back(number(random) < share_of_none ? -1 : static_cast<std::int32_t>(random() % count));
    return [=](Cube c) { return labels[(c[0] * cubes[1] + c[1]) * cubes[2] + c[2]]; };
}

TEST(Cells, OfRandomLabelsAreTheComponentsOfCubes) {
    for (unsigned seed = 1; seed <= test::slice(200); ++seed) {
        const Cube cubes = {static_cast<int>(1 + seed % 5), static_cast<int>(2 + seed / 3 % 4), 4};
        const auto region = random_labels(cubes, static_cast<std::int32_t>(1 + seed % 4), seed % 7 * 0.15, seed);
        if (CubeComponents(cubes, region).count() > 0) expect_cells(cubes, region, seed);
    }
}

TEST(Cells, LieInsideOfOneAnother) {
    for (unsigned seed = 1; seed <= test::slice(100); ++seed) {
        std::mt19937 random(seed);
        const Cube cubes = {13, 13, 13};
        // Layers around the middle with holes in them, and cubes within the layers.
        std::vector<std::int32_t> layer = {0, 1, 2, -1, 0, -1, 1};
        std::shuffle(layer.begin(), layer.end(), random);
        const auto noise = random_labels(cubes, 40, 0, seed);
        const auto region = [=](Cube c) {
            if (noise(c) == 0) return 3;
            const int distance = std::max({std::abs(c[0] - 6), std::abs(c[1] - 6), std::abs(c[2] - 6)});
            return layer[static_cast<std::size_t>(distance)];
        };
        expect_cells(cubes, region, seed);
    }
}

TEST(Cells, OfGrainsThatAreTurnedAndStretched) {
    for (unsigned seed = 1; seed <= test::slice(40); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Cube cubes = {8, 7, 9};
        const auto grains = test::grains(cubes, 12, seed);
        const auto region = [=](Cube c) { return grains(c) % 3 - 1; };
        const CubeComponents components(cubes, region);
        const SurfaceArrays arrays = mixed_up(test::voxel_body(cubes, region).facets, seed);
        expect_components(components, arrays, turned_and_stretched(arrays.vertices, seed));
    }
}

// All corners of the cube in the middle are those of its neighbours at vertices.
TEST(Cells, InsideAllVerticesMayTouch) {
    const auto region = [](Cube c) {
        const auto is_odd = [](std::int32_t x) { return x % 2 == 1; };
        return c == Cube{2, 2, 2} || std::all_of(c.begin(), c.end(), is_odd) ? 1 : 0;
    };
    const Cube cubes = {5, 5, 5};
    const SurfaceArrays arrays = test::voxel_body(cubes, region).facets;
    expect_cells(cubes, region, 1);
    EXPECT_EQ(find_cells(arrays.vertices, arrays.facets)->count, 10);
}

TEST(Cells, DanglingFacetsHaveOneCellOnBothSides) {
    Soup soup = test::box();
    const auto first = static_cast<std::int32_t>(soup.facets.size());
    for (const Vec3& p : {Vec3(0.25, 0.25, 0.5), Vec3(0.5, 0.25, 0.5), Vec3(0.25, 0.5, 0.5)})
        soup.vertices.push_back(p);  // inside, apart from all
    const auto v = static_cast<std::int32_t>(soup.vertices.size());
    soup.facets.push_back({v - 3, v - 2, v - 1});
    soup.facets.push_back({0, v - 2, v - 1});  // hangs on both
    const Cells cells = find_cells(soup.vertices, soup.facets).value();
    EXPECT_EQ(cells.count, 1);
    for (std::int32_t f = 0; f < first; ++f) EXPECT_EQ(cells.sides[f], CellSides({-1, 0}));
    for (std::int32_t f = first; f < first + 2; ++f) EXPECT_EQ(cells.sides[f], CellSides({0, 0}));
    const std::vector<Triangle> open(soup.facets.begin() + 1, soup.facets.end());
    const Cells none = find_cells(soup.vertices, open).value();
    EXPECT_EQ(none.count, 0);
    for (const CellSides& sides : none.sides) EXPECT_EQ(sides, CellSides({-1, -1}));
}

TEST(Cells, AreNotFoundWhereFacetsLieOnOneAnother) {
    Soup soup = test::box();
    const auto v = static_cast<std::int32_t>(soup.vertices.size());
    const Triangle t = soup.facets[0];
    soup.vertices.push_back(0.5 * soup.vertices[t[0]] + 0.25 * soup.vertices[t[1]] + 0.25 * soup.vertices[t[2]]);
    soup.facets.push_back({t[0], t[1], v});
    EXPECT_FALSE(find_cells(soup.vertices, soup.facets));
}

TEST(CellLocator, SaysThatAPointIsOnAFacet) {
    const Soup soup = test::box(Vec3(0, 0, 0), Vec3(1, 1, 1));
    const Cells cells = find_cells(soup.vertices, soup.facets).value();
    const CellLocator locator(soup.vertices, soup.facets, cells);
    EXPECT_EQ(locator.find(Vec3(0.5, 0.25, 1)), std::nullopt);
    EXPECT_EQ(locator.find(Vec3(1, 0, 1)), std::nullopt);
    EXPECT_EQ(locator.find(Vec3(0.5, 0.5, 0.5)), 0);
    EXPECT_EQ(locator.find(Vec3(2, 0.5, 0.5)), -1);
}

TEST(CellLocator, FindsEachOfManyCells) {
    Soup soup;
    std::vector<Vec3> inside;
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
            const Vec3 low(i, j, (i + j) % 3);
            soup = test::join(std::move(soup), test::box(low, low + Vec3(0.9, 0.9, 1.7)));
            inside.emplace_back(low + Vec3(0.3, 0.4, 1.5));
        }
    const Cells cells = find_cells(soup.vertices, soup.facets).value();
    ASSERT_EQ(cells.count, std::ssize(inside));
    const CellLocator locator(soup.vertices, soup.facets, cells);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        EXPECT_EQ(locator.find(inside[i]), static_cast<std::int32_t>(i));
        EXPECT_EQ(locator.find(inside[i] + Vec3(0.65, 0, 0)), -1);
    }
}

}  // namespace
}  // namespace kerf
