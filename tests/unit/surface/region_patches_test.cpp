// What patches of several regions are called.
#include <gtest/gtest.h>

#include "support/facet_sides.h"
#include "support/shapes.h"
#include "surface/regions/region_finder.h"
#include "surface/soup/region_patches.h"

namespace kerf {
namespace {

using Names = std::vector<std::string>;

// A facet for each pair of sides, with a patch.
Soup soup_with(const Names& regions, const std::vector<std::pair<FacetSides, std::string>>& facets) {
    Soup soup;
    soup.region_names = regions;
    for (const auto& [sides, patch] : facets) {
        soup.facets.push_back({0, 1, 2});
        soup.sides.push_back(sides);
        const auto found = std::find(soup.patch_names.begin(), soup.patch_names.end(), patch);
        soup.patch.push_back(static_cast<std::int32_t>(found - soup.patch_names.begin()));
        if (found == soup.patch_names.end()) soup.patch_names.push_back(patch);
    }
    return soup;
}

Names patches_of_facets(const Soup& soup) {
    Names names;
    for (const std::int32_t patch : soup.patch) names.push_back(soup.patch_names[static_cast<std::size_t>(patch)]);
    return names;
}

constexpr FacetSides outer_a = test::facet_sides(-1, 0), outer_b = test::facet_sides(-1, 1),
                     wall = test::facet_sides(1, 0), other_wall = test::facet_sides(2, 0);

TEST(WallNames, OfPatchesThatHaveOuterFacetsToo) {
    Soup soup = soup_with({"a", "b"}, {{outer_a, "all"}, {wall, "all"}, {outer_b, "all"}});
    name_walls(soup);
    EXPECT_EQ(patches_of_facets(soup), (Names{"all", "a_to_b", "all"}));
    EXPECT_EQ(soup.patch_names, (Names{"all", "a_to_b"}));
}

TEST(WallNames, OfTheFileStay) {
    Soup soup = soup_with({"a", "b", "c"}, {{wall, "contact"}, {outer_a, "skin"}, {other_wall, "contact"}});
    const Soup before = soup;
    name_walls(soup);
    EXPECT_EQ(patches_of_facets(soup), patches_of_facets(before));
}

TEST(WallNames, NoPatchIsCalledLikeARegion) {
    Soup soup =
        soup_with({"a", "b", "c"}, {{outer_a, "a"}, {wall, "b"}, {outer_b, "b"}, {other_wall, "a"}, {outer_b, "a"}});
    name_walls(soup);
    EXPECT_EQ(patches_of_facets(soup), (Names{"a_outer", "a_to_b", "b_outer", "a_to_c", "b_outer"}));
}

TEST(WallNames, AreToldFromThoseOfTheFile) {
    Soup soup =
        soup_with({"a", "b", "a_outer"}, {{outer_a, "a_to_b"}, {outer_b, "all"}, {wall, "all"}, {outer_a, "a"}});
    name_walls(soup);
    EXPECT_EQ(patches_of_facets(soup), (Names{"a_to_b", "all", "a_to_b_2", "a_outer_2"}));
    // Two pairs whose names are put together alike.
    soup =
        soup_with({"x", "x_to_y", "y_to_z", "z"}, {{outer_a, "p"}, {other_wall, "p"}, {test::facet_sides(3, 1), "p"}});
    name_walls(soup);
    EXPECT_EQ(patches_of_facets(soup), (Names{"p", "x_to_y_to_z", "x_to_y_to_z_2"}));
}

TEST(WallNames, ComeWithColours) {
    Soup soup = soup_with({"a", "b"}, {{outer_b, "blue"}, {wall, "blue"}, {outer_a, "a"}});
    soup.patch_colours = {{0, 0, 255, 255}, {255, 0, 0, 255}};
    name_walls(soup);
    EXPECT_EQ(soup.patch_names, (Names{"blue", "a_to_b", "a_outer"}));
    ASSERT_EQ(soup.patch_colours.size(), 3U);
    EXPECT_EQ(soup.patch_colours[1][2], 255);
    EXPECT_EQ(soup.patch_colours[2][0], 255);
}

TEST(WallNames, AreGivenOnce) {
    Soup soup = soup_with({"a", "b"}, {{outer_a, "a"}, {wall, "b"}, {outer_b, "b"}, {outer_a, "top"}});
    name_walls(soup);
    const Soup before = soup;
    name_walls(soup);
    EXPECT_EQ(soup.patch, before.patch);
    EXPECT_EQ(soup.patch_names, before.patch_names);
}

TEST(WallNames, OfBodiesThatTouch) {
    Soup soup = test::join(test::box(), test::box(Vec3(1, 0, 0), Vec3(2, 1, 1)));
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f >= 12;
    soup.patch_names = {"bone", "cement"};
    weld_exactly(soup);
    ASSERT_TRUE(find_touching_bodies(soup));
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        EXPECT_EQ(patches_of_facets(soup)[f], soup.sides[f].is_wall()                ? "bone_to_cement"
                                              : soup.sides[f].back == RegionIndex(0) ? "bone_outer"
                                                                                     : "cement_outer");
    EXPECT_EQ(soup.patch_names.size(), 3U);
    Soup one = test::box();
    name_walls(one);
    EXPECT_EQ(one.patch_names, test::box().patch_names);
}

}  // namespace
}  // namespace kerf
