// What becomes of facets that do not say what they bound.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "run/prepare/input.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"
#include "support/write_off.h"

namespace kerf {
namespace {

// Two unit cubes side by side, their wall there twice.
Soup two_cubes() {
    Soup soup = test::join(test::box(), test::box(Vec3(1, 0, 0), Vec3(2, 1, 1)));
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f >= 12;
    soup.patch_names = {"bone", "cement"};
    return soup;
}

// The same with the wall there once.
Soup two_rooms_of_walls() {
    const test::VoxelBody body = test::voxel_body({2, 1, 1}, [](std::array<std::int32_t, 3> c) { return c[0]; });
    return {body.facets.vertices, body.facets.facets, std::vector<std::int32_t>(body.facets.facets.size(), 0), {"all"}};
}

Input input_with(const Soup& soup, const InputOptions& options = {}) {
    return make_input(soup.vertices, soup.facets, soup.patch, soup.patch_names, options);
}

InputOptions with_regions(std::vector<std::string> regions) {
    InputOptions options;
    options.regions = std::move(regions);
    return options;
}

std::vector<std::string> names_of(const Input& input) {
    return {input.complex.region_names().begin(), input.complex.region_names().end()};
}

template <class Do>
void expect_error(ErrorCode code, const char* part, Do act) {
    try {
        act();
        ADD_FAILURE() << "no error: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(RegionInput, BodiesThatTouchAreRegions) {
    const Input input = input_with(two_cubes());
    EXPECT_EQ(names_of(input), (std::vector<std::string>{"bone", "cement"}));
    ASSERT_EQ(input.regions.size(), 2U);
    EXPECT_EQ(input.regions[0].volume, 1);
    EXPECT_EQ(input.regions[1].volume, 1);
    EXPECT_EQ(input.facets, 22);
    EXPECT_EQ(input.area, 11);
}

TEST(RegionInput, BodiesApartAreOneAsEver) {
    Soup soup = test::join(test::box(), test::box(Vec3(2, 0, 0), Vec3(3, 1, 1)));
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f >= 12;
    soup.patch_names = {"bone", "cement"};
    const Input input = input_with(soup);
    EXPECT_TRUE(input.regions.empty());
    EXPECT_EQ(input.components, 2);
}

// Bodies of one name each, one inside of the other, turned alike: neither is a void, and none is lost.
TEST(RegionInput, NamedBodiesInsideOfOthersAreRegions) {
    for (const bool is_turned : {false, true}) {
        SCOPED_TRACE(is_turned);
        Soup soup = test::join(test::box(Vec3(0, 0, 0), Vec3(5, 5, 5)), test::box(Vec3(1, 1, 1), Vec3(4, 4, 4)));
        soup = test::join(soup, test::box(Vec3(2, 2, 2), Vec3(3, 3, 3)));
        for (std::size_t f = 0; f < soup.facets.size(); ++f) {
            soup.patch[f] = static_cast<std::int32_t>(f / 12);
            if (is_turned) std::swap(soup.facets[f][1], soup.facets[f][2]);
        }
        soup.patch_names = {"skull", "brain", "core"};
        const Input input = input_with(soup);
        EXPECT_EQ(names_of(input), (std::vector<std::string>{"skull", "brain", "core"}));
        ASSERT_EQ(input.regions.size(), 3U);
        EXPECT_EQ(input.regions[0].volume, 125 - 27);
        EXPECT_EQ(input.regions[1].volume, 27 - 1);
        EXPECT_EQ(input.regions[2].volume, 1);
        EXPECT_EQ(input.facets, 36);
        // One name for two shells, or one of three that is turned against the others, leaves the choice to the user.
        Soup unnamed = soup;
        unnamed.patch.assign(36, 0);
        unnamed.patch_names = {"all"};
        EXPECT_GT(check_soup(unnamed, {}).diagnosis.count(DefectKind::ambiguous_shell), 0);
        Soup mixed = soup;
        for (std::size_t f = 24; f < 36; ++f) std::swap(mixed.facets[f][1], mixed.facets[f][2]);
        EXPECT_EQ(check_soup(mixed, {}).diagnosis.count(DefectKind::ambiguous_shell), 1);
    }
}

// A point around which no facets close makes no void, which is said.
TEST(RegionInput, HolePointsOutsideAreNamed) {
    Soup soup = test::join(test::box(Vec3(0, 0, 0), Vec3(3, 3, 3)), test::box(Vec3(1, 1, 1), Vec3(2, 2, 2)));
    soup.holes = {Vec3(9, 9, 9), Vec3(1.5, 1.5, 1.5)};
    const CheckedSoup checked = check_soup(soup, {});
    EXPECT_TRUE(checked.diagnosis.clean());
    ASSERT_EQ(checked.soup.notes.size(), 1U);
    EXPECT_NE(checked.soup.notes[0].find("(9, 9, 9) of a hole lies outside"), std::string::npos);
}

// TetGen's bound of the cells of a region counts where it is the only one, too.
TEST(RegionInput, BoundsOfPointsCountInOneBody) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("one.poly");
    std::ofstream(path) << "8 3\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n6 0\n"
                           "1\n4 1 4 3 2\n1\n4 5 6 7 8\n1\n4 1 2 6 5\n1\n4 2 3 7 6\n1\n4 3 4 8 7\n1\n4 4 1 5 8\n"
                           "0\n1\n1 0.5 0.5 0.5 1 0.001\n";
    const Input input = read_input(path, {});
    EXPECT_EQ(input.complex.region_count(), 1);
    EXPECT_EQ(max_volumes_of_regions({}, input), std::vector<double>{0.001});
}

TEST(RegionInput, PointsNameRegionsInUnitsAfterScaling) {
    InputOptions options = with_regions({"right=3,1,1", "left=1,1,1.5"});
    options.scale = 2;
    const Input input = input_with(two_rooms_of_walls(), options);
    EXPECT_EQ(names_of(input), (std::vector<std::string>{"right", "left"}));
    EXPECT_EQ(input.volume, 16);
}

TEST(RegionInput, MisplacedPointsAreRefused) {
    const Soup soup = two_rooms_of_walls();
    expect_error(ErrorCode::input, "lies outside", [&] { input_with(soup, with_regions({"a=5,0,0"})); });
    expect_error(ErrorCode::input, "'b'", [&] { input_with(soup, with_regions({"a=0.5,0.5,0.5", "b=0.5,0.5,0.25"})); });
    for (const char* bad : {"a", "a=", "a=1,2", "a=1,2,3,4", "a=1,2,x", "=1,2,3", "a=1,2,inf", "a=1,2,3 "})
        expect_error(ErrorCode::usage, "--region", [&] { with_regions({bad}).check(); });
    EXPECT_EQ(seeds_of(with_regions({"a=b=1,-2e3,.5"}))[0].name, "a=b");
    const test::VoxelBody body = test::voxel_body({2, 1, 1}, [](std::array<std::int32_t, 3> c) { return c[0]; });
    Soup sided = soup;
    sided.sides = body.sides;
    sided.region_names = body.names;
    expect_error(ErrorCode::usage, "has regions", [&] { check_soup(sided, with_regions({"a=0.5,0.5,0.5"})); });
}

TEST(RegionInput, AGapIsNamedBeforeAPointThatLiesOutsideForIt) {
    Soup soup = two_rooms_of_walls();
    soup.facets.erase(soup.facets.begin());
    soup.patch.pop_back();
    const CheckedSoup checked = check_soup(soup, with_regions({"a=0.5,0.5,0.5"}));
    EXPECT_FALSE(checked.diagnosis.clean());
    EXPECT_EQ(checked.diagnosis.count(DefectKind::open_edge), 1);
}

class RegionFiles : public testing::Test {
 protected:
    std::string write(const char* name, const Soup& soup) const {
        test::write_off(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    }
    const Soup big_ = test::box(Vec3(0, 0, 0), Vec3(4, 4, 4)), small_ = test::box(Vec3(1, 1, 1), Vec3(2, 2, 2)),
               beside_ = test::box(Vec3(4, 0, 0), Vec3(8, 4, 4)), apart_ = test::box(Vec3(9, 9, 9), Vec3(10, 10, 10));
    test::TemporaryFolder folder_;
};

TEST_F(RegionFiles, EachIsARegionOfItsName) {
    const std::string bone = write("bone.off", big_);
    InputOptions options;
    options.more_files = {write("cement.off", small_), write("metal.off", beside_), write("screw.off", apart_)};
    const Input input = read_input(bone, options);
    EXPECT_EQ(names_of(input), (std::vector<std::string>{"bone", "cement", "metal", "screw"}));
    ASSERT_EQ(input.regions.size(), 4U);
    EXPECT_EQ(input.regions[0].volume, 63);
    EXPECT_EQ(input.regions[1].volume, 1);
    EXPECT_EQ(input.regions[2].volume, 64);
    EXPECT_EQ(input.regions[3].volume, 1);
    EXPECT_EQ(input.patch_names, (std::vector<std::string>{"bone_outer", "bone_to_metal", "bone_to_cement",
                                                           "metal_outer", "screw_outer"}));
    EXPECT_NE(input.file_hash, read_input(bone).file_hash);
    std::swap(options.more_files[0], options.more_files[1]);
    EXPECT_NE(read_input(bone, options).file_hash, input.file_hash);
}

TEST_F(RegionFiles, OfOneNameAreTold) {
    const std::string bone = write("bone.off", big_);
    std::filesystem::create_directory(folder_.file("more"));
    InputOptions options;
    options.more_files = {write("more/bone.off", beside_)};
    EXPECT_EQ(names_of(read_input(bone, options)), (std::vector<std::string>{"bone", "bone_2"}));
}

TEST_F(RegionFiles, ThatIntersectAreRefused) {
    const std::string bone = write("bone.off", big_);
    InputOptions options;
    options.more_files = {write("cement.off", test::box(Vec3(3, 3, 3), Vec3(5, 5, 5)))};
    expect_error(ErrorCode::input, "overlap of bodies", [&] { read_input(bone, options); });
    options.more_files = {folder_.file("none.off")};
    EXPECT_THROW(read_input(bone, options), Error);
}

TEST(RegionInput, VoidsAreFilled) {
    InputOptions options;
    options.fill_voids = true;
    const Input input = input_with(test::nested_boxes(2), options);
    EXPECT_EQ(names_of(input), (std::vector<std::string>{"body", "void_1"}));
    EXPECT_EQ(input.volume, 27);
    // A shell that is turned like the one around it is a region, too.
    const Soup ambiguous = test::join(test::box(Vec3(0, 0, 0), Vec3(3, 3, 3)), test::box(Vec3(1, 1, 1), Vec3(2, 2, 2)));
    EXPECT_EQ(names_of(input_with(ambiguous, options)), (std::vector<std::string>{"body", "void_1"}));
    EXPECT_TRUE(input_with(test::box(), options).regions.empty());
}

}  // namespace
}  // namespace kerf
