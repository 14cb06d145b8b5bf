#include "surface/complex/complex.h"

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/facet_sides.h"
#include "support/voxel_regions.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

using Cube = std::array<std::int32_t, 3>;

test::VoxelBody two_cubes() {
    return test::voxel_body({2, 1, 1}, [](Cube cube) { return cube[0]; });
}

std::string refusal_of(const test::VoxelBody& body) {
    try {
        test::to_complex(body);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return "";
}

TEST(Complex, SurfacesOfRegionsAreViewsWithTheSameKeys) {
    const Complex complex = test::to_complex(two_cubes());
    ASSERT_EQ(complex.region_count(), 2);
    std::vector<std::int32_t> seen(static_cast<std::size_t>(complex.facet_count()), 0);
    for (const RegionIndex region : ids<RegionIndex>(2)) {
        const Surface cube = complex.surface_of(region);
        EXPECT_NEAR(mass_properties(cube).volume, 1, 1e-15);
        for (const Facet f : cube.facets()) {
            const std::int32_t facet = key_index(cube.facet_key(f));
            ++seen[static_cast<std::size_t>(facet)];
            EXPECT_EQ(cube.patch(f), complex.patch(facet));
            for (const Vertex v : cube.corners(f))
                EXPECT_EQ(cube.point(v), complex.point(key_index(cube.vertex_key(v))));
        }
    }
    for (std::int32_t f = 0; f < complex.facet_count(); ++f)
        EXPECT_EQ(seen[static_cast<std::size_t>(f)], complex.sides(f).is_wall() ? 2 : 1);
}

TEST(Complex, OfOneRegionIsItsSurface) {
    const Surface cube = test::to_complex(two_cubes()).surface_of(RegionIndex(1));
    Complex complex(cube);
    EXPECT_EQ(complex.region_count(), 1);
    EXPECT_TRUE(complex.region_names().empty() && complex.all_sides().empty());
    EXPECT_EQ(complex.sides(3), test::facet_sides(-1, 0));
    EXPECT_EQ(complex.facet_count(), cube.facet_count());
    EXPECT_EQ(&complex.surface_of(RegionIndex(0)).point(Vertex(0)), &cube.point(Vertex(0))) << "half-edges are copied";
    EXPECT_EQ(complex.take_only_region().facet_count(), cube.facet_count());
    EXPECT_EQ(complex.facet_count(), 0);
}

TEST(Complex, OfOneNamedRegionIsItsSurfaceTurnedOutwards) {
    test::VoxelBody cube = test::voxel_body({1, 1, 1}, [](Cube) { return 0; });
    cube.sides[3] = cube.sides[3].turned();
    std::swap(cube.facets.facets[3][1], cube.facets.facets[3][2]);
    Complex complex = test::to_complex(cube);
    EXPECT_TRUE(complex.region_names().empty() && complex.all_sides().empty());
    EXPECT_NEAR(mass_properties(complex.take_only_region()).volume, 1, 1e-15);
}

TEST(Complex, RefusesRegionsThatDoNotClose) {
    test::VoxelBody open = two_cubes();
    const auto wall =
        std::find_if(open.sides.begin(), open.sides.end(), [](const FacetSides& s) { return s.is_wall(); });
    wall->front = RegionIndex::none();  // the second cube loses a facet
    EXPECT_NE(refusal_of(open).find("The region 'region_1' is open at (1, "), std::string::npos) << refusal_of(open);

    test::VoxelBody turned = two_cubes();
    turned.sides.front() = turned.sides.front().turned();
    EXPECT_NE(refusal_of(turned).find("is open at"), std::string::npos);

    test::VoxelBody doubled = two_cubes();
    doubled.sides.front() = test::facet_sides(0, 0);
    EXPECT_NE(refusal_of(doubled).find("has the region 'region_0' on both sides"), std::string::npos);

    const test::VoxelBody touching = test::voxel_body({2, 2, 1}, [](Cube c) { return c[0] == c[1] ? 0 : -1; });
    EXPECT_NE(refusal_of(touching).find("touches itself at (1, 1, "), std::string::npos) << refusal_of(touching);

    test::VoxelBody empty = two_cubes();
    empty.names.emplace_back("third");
    EXPECT_NE(refusal_of(empty).find("The region 'third' has no facets"), std::string::npos);
}

TEST(Complex, ContactsAreWhereRegionsTouchWithoutAWall) {
    const auto contacts = [](Cube cubes, const test::RegionOfCube& region) {
        return test::to_complex(test::voxel_body(cubes, region)).find_contacts();
    };
    EXPECT_TRUE(contacts({2, 1, 1}, [](Cube c) { return c[0]; }).empty());
    EXPECT_TRUE(contacts({2, 2, 1}, [](Cube c) { return c[0] + 2 * c[1] - 1; }).empty()) << "walls lead around";
    const Contacts edge = contacts({2, 2, 1}, [](Cube c) { return c[0] != c[1] ? -1 : c[0]; });
    EXPECT_EQ(edge.vertices.size(), 2U);
    ASSERT_EQ(edge.edges.size(), 1U);
    EXPECT_TRUE(edge.has(edge.edges[0][1], edge.edges[0][0]) && edge.has(edge.vertices[0]));
    const Contacts vertex = contacts({2, 2, 2}, [](Cube c) { return c[0] != c[1] || c[1] != c[2] ? -1 : c[0]; });
    EXPECT_EQ(vertex.vertices.size(), 1U);
    EXPECT_TRUE(vertex.edges.empty());
}

}  // namespace
}  // namespace kerf
