// Three bad inputs of each kind: what is wrong is told with the names of both regions and a place.
#include <algorithm>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "run/prepare/input.h"
#include "support/facet_sides.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"
#include "support/write_off.h"

namespace kerf {
namespace {

Soup named(Soup soup, const std::string& name) {
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {name};
    return soup;
}

// Two solids of one file.
Soup solids(const Soup& bone, const Soup& cement) {
    Soup soup = test::join(named(bone, "bone"), named(cement, "cement"));
    soup.patch_names = {"bone", "cement"};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.patch[f] = f >= bone.facets.size();
    return soup;
}

Soup bone(int n) { return test::box(Vec3(0, 0, 0), Vec3(1, 1, 1), n); }
Soup cement(double x, int n, double low = 0, double high = 1) {
    return test::box(Vec3(x, low, low), Vec3(2, high, high), n);
}
// The same with the other diagonals.
Soup mirrored(Soup soup) {
    for (Vec3& p : soup.vertices) p.y() = 1 - p.y();
    for (Triangle& t : soup.facets) std::swap(t[1], t[2]);
    return soup;
}

// An error of that kind, as a solid of one file and as a file each.
void expect_defect(DefectKind kind, const Soup& left, const Soup& right, double distance) {
    const test::TemporaryFolder folder;
    test::write_off(folder.file("bone.off"), left.vertices, left.facets);
    test::write_off(folder.file("cement.off"), right.vertices, right.facets);
    InputOptions options;
    options.more_files = {folder.file("cement.off")};
    for (const CheckedSoup& checked :
         {check_soup(solids(left, right)), check_input(folder.file("bone.off"), options)}) {
        ASSERT_GE(checked.diagnosis.defects.size(), 1U);
        const Defect& defect = checked.diagnosis.defects[0];
        EXPECT_EQ(defect.kind, kind) << checked.diagnosis.summary(checked.soup);
        for (const Defect& other : checked.diagnosis.defects)  // of one file, where an overlap begins
            if (other.kind == DefectKind::self_intersection) {
                EXPECT_EQ(other.bodies, defect.bodies);
            }
        EXPECT_EQ(defect.severity, Severity::error);
        EXPECT_EQ(defect.bodies, (std::vector<std::string>{"bone", "cement"}));
        EXPECT_NEAR(defect.measure, distance, 1e-9);
        EXPECT_NEAR(defect.where.x(), 1, 0.5);
        ASSERT_GE(defect.facets.size(), 2U);
        const std::string text = checked.diagnosis.summary(checked.soup);
        for (const char* part : {"'bone' and 'cement'", "near ("}) EXPECT_NE(text.find(part), text.npos) << text;
        EXPECT_EQ(checked.diagnosis.elements(checked.soup).size(), 1U) << "of the kind that the sentence names";
    }
}

TEST(BadRegions, Gaps) {
    expect_defect(DefectKind::body_gap, bone(2), cement(1 + 1e-6, 2), 1e-6);
    expect_defect(DefectKind::body_gap, bone(3), cement(1 + 1e-7, 1), 1e-7);
    expect_defect(DefectKind::body_gap, bone(1), cement(1 + 1e-5, 1, 0.25, 0.75), 1e-5);
}

TEST(BadRegions, Overlaps) {
    expect_defect(DefectKind::body_overlap, bone(2), cement(1 - 1e-4, 2), 1e-4);
    expect_defect(DefectKind::body_overlap, bone(3), cement(0.75, 1, 0.25, 0.5), 0.25);
    expect_defect(DefectKind::body_overlap, bone(1), cement(0.5, 4, 0.25, 0.75), 0.5);
    expect_defect(DefectKind::body_overlap, bone(1), cement(0.5, 1), 1. / 3);  // no corner is inside
}

TEST(BadRegions, OtherTrianglesOnBothSides) {
    expect_defect(DefectKind::unlike_walls, bone(4), cement(1, 3), 0);
    expect_defect(DefectKind::unlike_walls, bone(2), mirrored(cement(1, 2)), 0);
    expect_defect(DefectKind::unlike_walls, bone(1), cement(1, 2, 0.25, 0.75), 0);
}

TEST(BadRegions, GapsOfAHundredthAreNoted) {
    const Soup soup = solids(bone(2), cement(1 + 1e-3, 2));
    const CheckedSoup checked = check_soup(soup);
    ASSERT_EQ(checked.diagnosis.count(DefectKind::body_gap), 1);
    EXPECT_EQ(checked.diagnosis.defects[0].severity, Severity::warning);
    const Input input = make_input(soup.vertices, soup.facets, soup.patch, soup.patch_names);
    ASSERT_EQ(input.notes.size(), 1U);
    for (const char* part : {"'bone'", "'cement'", "0.001", "--weld"})
        EXPECT_NE(input.notes[0].find(part), std::string::npos) << input.notes[0];
    InputOptions options;
    options.repairs.weld_tolerance = Length(1.2e-3);
    EXPECT_EQ(check_soup(soup, options).soup.region_names, (std::vector<std::string>{"bone", "cement"}));
    EXPECT_TRUE(check_soup(solids(bone(2), cement(1.5, 2))).diagnosis.defects.empty());
}

TEST(BadRegions, EachFileIsDiagnosedByItself) {
    const test::TemporaryFolder folder;
    Soup open = cement(1, 2);
    open.facets.pop_back();
    test::write_off(folder.file("bone.off"), bone(2).vertices, bone(2).facets);
    test::write_off(folder.file("cement.off"), open.vertices, open.facets);
    InputOptions options;
    options.more_files = {folder.file("cement.off")};
    const CheckedSoup checked = check_input(folder.file("bone.off"), options);
    ASSERT_EQ(checked.diagnosis.defects.size(), 1U) << checked.diagnosis.summary(checked.soup);
    EXPECT_EQ(checked.diagnosis.defects[0].kind, DefectKind::open_edge);
    EXPECT_EQ(checked.diagnosis.defects[0].bodies, (std::vector<std::string>{"cement"}));
}

// Two rooms with their wall; all facets turned at random ways: nobody knows what their normals say.
Soup rooms() {
    const test::VoxelBody body = test::voxel_body({2, 1, 1}, [](std::array<std::int32_t, 3> c) { return c[0]; });
    Soup soup{body.facets.vertices, body.facets.facets, {}, {"left", "right", "wall"}};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        soup.patch.push_back(body.sides[f].is_wall() ? 2 : body.sides[f].back.value());
        if (f % 3 == 0) std::swap(soup.facets[f][1], soup.facets[f][2]);
    }
    return soup;
}

void expect_refused(const std::function<void()>& act, const std::vector<std::string>& parts) {
    try {
        act();
        ADD_FAILURE() << "nothing was refused: " << parts[0];
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        for (const std::string& part : parts)
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " in " << error.what();
    }
}

void expect_seeds_refused(const std::vector<std::string>& regions, const std::vector<std::string>& parts) {
    InputOptions options;
    options.regions = regions;
    expect_refused([&] { check_soup(rooms(), options); }, parts);
}

TEST(BadRegions, SeedsOutside) {
    expect_seeds_refused({"a=-1,0.5,0.5"}, {"'a'", "(-1, 0.5, 0.5)", "outside"});
    expect_seeds_refused({"a=0.5,0.5,0.5", "b=3,0,0"}, {"'b'", "(3, 0, 0)", "outside"});
    expect_seeds_refused({"a=0.5,0.5,0.5", "b=1,0.5,0.25"}, {"'b'", "(1, 0.5, 0.25)", "on a facet"});
}

TEST(BadRegions, TwoSeedsInOneCell) {
    expect_seeds_refused({"a=0.5,0.5,0.5", "b=0.25,0.5,0.5"}, {"'a'", "'b'", "(0.5, 0.5, 0.5)", "(0.25, 0.5, 0.5)"});
    expect_seeds_refused({"a=1.5,0.5,0.5", "c=0.5,0.5,0.5", "b=1.25,0.5,0.5"}, {"'a'", "'b'", "(1.25, 0.5, 0.5)"});
    Soup without_wall = rooms();
    std::vector<char> is_wall;
    for (const std::int32_t patch : without_wall.patch) is_wall.push_back(patch == 2);
    drop_facets(without_wall, is_wall);
    InputOptions options;
    options.regions = {"a=0.5,0.5,0.5", "b=1.5,0.5,0.5"};
    expect_refused([&] { check_soup(without_wall, options); }, {"'a'", "'b'", "no facets are between"});
}

class WallsBeside : public testing::Test {
 protected:
    // The rooms as an OBJ with groups, and what is said of them.
    Input read(const Soup& soup, const std::string& json) const {
        std::ofstream obj(folder_.file("rooms.obj"));
        obj.precision(17);
        for (const Vec3& p : soup.vertices) obj << "v " << p.transpose() << "\n";
        for (std::size_t f = 0; f < soup.facets.size(); ++f) {
            const auto& [a, b, c] = soup.facets[f];
            obj << "g " << soup.patch_names[static_cast<std::size_t>(soup.patch[f])] << "\nf " << a + 1 << ' ' << b + 1
                << ' ' << c + 1 << "\n";
        }
        obj.close();
        std::ofstream(folder_.file("rooms.obj.regions.json")) << json;
        return read_input(folder_.file("rooms.obj"));
    }
    void refuses(const Soup& soup, const std::string& json, const std::vector<std::string>& parts) const {
        expect_refused([&] { read(soup, json); }, parts);
    }
    test::TemporaryFolder folder_;
};

constexpr const char* usual_walls =
    R"({"wall": ["bone", "cement"], "left": ["bone", null], "right": [null, "cement"]})";

TEST_F(WallsBeside, SayWhatPatchesBoundWhateverTheNormals) {
    const Input input = read(rooms(), usual_walls);
    const auto names = input.complex.region_names();
    EXPECT_EQ(std::vector<std::string>(names.begin(), names.end()), (std::vector<std::string>{"bone", "cement"}));
    ASSERT_EQ(input.regions.size(), 2U);
    EXPECT_EQ(input.regions[0].volume, 1);
    EXPECT_EQ(input.regions[1].volume, 1);
    const Input other = read(rooms(), R"({"left": ["a", null], "right": [null, "b"], "wall": ["b", "a"]})");
    EXPECT_NE(other.file_hash, input.file_hash);
}

TEST_F(WallsBeside, ThatAreWronglySaidAreRefused) {
    const std::string file = "rooms.obj.regions.json";
    refuses(rooms(), "[1, 2]", {file, "JSON object"});
    refuses(rooms(), R"({"wall": ["bone")", {file, "JSON object"});
    refuses(rooms(), R"({"wall": ["bone", "cement"], "left": ["bone", null], "roof": [null, "cement"]})",
            {file, "'roof'", "left"});
    refuses(rooms(), R"({"wall": ["bone", "cement"], "left": ["bone", null]})", {file, "'right'", "missing"});
    for (const char* bad : {R"(["bone", "bone"])", R"([null, null])", R"("bone")", R"(["bone"])", R"(["", "a"])"})
        refuses(rooms(), R"({"wall": )" + std::string(bad) + R"(, "left": ["a", null], "right": ["b", null]})",
                {file, "'wall'"});
    refuses(rooms(), R"({"wall": ["a", "b"], "wall": ["a", "c"], "left": ["a", null], "right": ["b", null]})",
            {file, "'wall'", "twice"});
}

TEST_F(WallsBeside, ThatDoNotFitAreRefusedWithAPlace) {
    refuses(rooms(), R"({"wall": ["bone", "cement"], "left": ["bone", null], "right": ["bone", null]})",
            {"'wall'", "'bone' and 'cement'", "at (1,"});
    refuses(rooms(), R"({"wall": ["bone", "cement"], "left": ["bone", "metal"], "right": ["cement", null]})",
            {"'left'", "'metal'", "the outside", "at ("});
    Soup with_sheet = rooms();  // in the midst of a region
    const auto first = static_cast<std::int32_t>(with_sheet.vertices.size());
    with_sheet.vertices.insert(with_sheet.vertices.end(),
                               {Vec3(0.25, 0.25, 0.5), Vec3(0.5, 0.25, 0.5), Vec3(0.25, 0.5, 0.5)});
    with_sheet.facets.push_back({first, first + 1, first + 2});
    with_sheet.patch.push_back(2);
    EXPECT_THROW(read(with_sheet, usual_walls), Error);
}

// One facet of each patch is not there.
TEST_F(WallsBeside, ThatAreOpenAreRefusedWithTheirRegions) {
    const std::vector<std::vector<std::string>> names = {{"'bone'"}, {"'cement'"}, {"'bone' and 'cement'"}};
    for (std::int32_t patch = 0; patch < 3; ++patch) {
        Soup open = rooms();
        const auto found = std::find(open.patch.begin(), open.patch.end(), patch) - open.patch.begin();
        open.facets.erase(open.facets.begin() + found);
        open.patch.erase(open.patch.begin() + found);
        std::vector<std::string> parts = names[static_cast<std::size_t>(patch)];
        parts.insert(parts.end(), {"open edge loop", "near ("});
        refuses(open, usual_walls, parts);
    }
}

// Sides that do not close a region, or say that there is none.
TEST(BadRegions, WithoutVolume) {
    const test::VoxelBody body = test::voxel_body({2, 1, 1}, [](std::array<std::int32_t, 3> c) { return c[0]; });
    const auto refuse = [&](const std::vector<FacetSides>& sides, const std::vector<std::string>& parts) {
        expect_refused([&] { make_input(body.facets.vertices, body.facets.facets, sides, {"bone", "cement"}); }, parts);
    };
    std::vector<FacetSides> sides = body.sides;
    for (FacetSides& facet : sides)
        if (facet.is_wall()) facet = test::facet_sides(-1, 0);  // cement is open
    refuse(sides, {"'cement'", "("});
    expect_refused(
        [&] {
            make_input(body.facets.vertices, body.facets.facets, body.sides, {"bone", "cement", "metal"});
        },
        {"'metal'", "no facets"});
    sides = body.sides;
    sides.front() = test::facet_sides(0, 0);
    refuse(sides, {"'bone'", "("});
}

TEST(RegionInput, LargestCellsOfAFileAreItsRegionsSizes) {
    Soup soup = rooms();
    soup.seeds = {{"fine", Vec3(0.5, 0.5, 0.5), 0.01}, {"any", Vec3(1.5, 0.5, 0.5), 0}};
    const test::TemporaryFolder folder;
    std::ofstream poly(folder.file("rooms.poly"));
    poly << soup.vertices.size() << " 3\n";
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) poly << v + 1 << ' ' << soup.vertices[v].transpose() << "\n";
    poly << soup.facets.size() << "\n";
    for (const auto& [a, b, c] : soup.facets) poly << "1\n3 " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << "\n";
    poly << "0\n2\n1 0.5 0.5 0.5 4 0.01\n2 1.5 0.5 0.5 7\n";
    poly.close();
    const Input input = read_input(folder.file("rooms.poly"));
    EXPECT_EQ(max_volumes_of_regions({}, input), (std::vector<double>{0.01, 0}));
    SizeOptions sizes;
    sizes.in_region = {"region_4=1"};
    const Array<RegionIndex, double> both = max_volumes_of_regions(sizes, input);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_GT(both[0], 0.1);
    EXPECT_EQ(both[1], 0);
    sizes.in_region = {"region_*=1", "region_7=0.5"};
    const Array<RegionIndex, double> finer = max_volumes_of_regions(sizes, input);
    EXPECT_EQ(finer[0], both[0]);
    EXPECT_LT(finer[1], finer[0]);
}

}  // namespace
}  // namespace kerf
