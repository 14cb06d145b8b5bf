// Solids that touch are regions that share walls: closed, of the right volumes, each facet once.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "cad/cad_files.h"
#include "files/cad/cad_import.h"
#include "files/io/file_bytes.h"
#include "run/prepare/input.h"
#include "support/facet_sides.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using test::box;
using test::cylinder;
using test::moved;
using test::together;

constexpr double planar = 1e-12;  // share of a volume

class CadAssembly : public testing::Test {
 protected:
    std::string write(const test::CadShape& shape, const char* ending = ".step") const {
        const std::string path = folder_.file(std::string("assembly") + ending);
        test::write_cad(path, shape);
        return path;
    }
    CadBody imported(const test::CadShape& shape, const CadOptions& options = {}, const char* ending = ".step") const {
        const std::string path = write(shape, ending);
        return import_cad(read_file(path), path, options);
    }
    std::string refusal_of(const test::CadShape& shape, const CadOptions& options = {}) const {
        const std::string path = write(shape);
        try {
            import_cad(read_file(path), path, options);
        } catch (const SolidDefect& defect) {
            EXPECT_EQ(defect.kind(), SolidDefect::touching) << defect.what();
            EXPECT_NE(std::string(defect.what()).find("--unite"), std::string::npos) << defect.what();
            return defect.what();
        }
        ADD_FAILURE() << "not refused";
        return "";
    }

    test::TemporaryFolder folder_;
};

int count_walls(const Soup& soup) {
    return static_cast<int>(
        std::count_if(soup.sides.begin(), soup.sides.end(), [](const FacetSides& s) { return s.is_wall(); }));
}

double area_of_walls(const Soup& soup) {
    double area = 0;
    for (std::size_t f = 0; f < soup.sides.size(); ++f) {
        const auto& [a, b, c] = soup.facets[f];
        if (soup.sides[f].is_wall())
            area += (soup.vertices[b] - soup.vertices[a]).cross(soup.vertices[c] - soup.vertices[a]).norm() / 2;
    }
    return area;
}

// Without defects, each facet once, all regions closed and of these volumes.
void expect_regions(const CadBody& body, const std::vector<double>& volumes, double tolerance) {
    const Soup& soup = body.soup;
    ASSERT_EQ(soup.sides.size(), soup.facets.size());
    ASSERT_EQ(soup.region_names.size(), volumes.size());
    EXPECT_EQ(body.solids, static_cast<std::int32_t>(volumes.size()));
    const CheckedSoup checked = check_soup(soup);
    EXPECT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
    EXPECT_EQ(checked.tidied.dropped_facets + checked.tidied.welded_vertices + checked.tidied.unused_vertices, 0);
    const Input input =
        make_input(soup.vertices, soup.facets, soup.sides, soup.region_names, soup.patch, soup.patch_names);
    ASSERT_EQ(input.regions.size(), volumes.size());
    for (std::size_t r = 0; r < volumes.size(); ++r)
        EXPECT_NEAR(input.regions[r].volume, volumes[r], tolerance * volumes[r]) << soup.region_names[r];
}

TEST_F(CadAssembly, BoxesOfOneFaceShareIt) {
    for (const char* ending : {".step", ".brep"}) {
        const test::CadShape shape = together({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})});
        const CadBody body = imported(shape, {}, ending);
        expect_regions(body, {1, 2}, planar);
        EXPECT_EQ(count_walls(body.soup), 2);
        EXPECT_EQ(body.soup.facets.size(), 22u);
        EXPECT_EQ(body.soup.vertices.size(), 12u);
        EXPECT_EQ(body.faces, 11);
        EXPECT_EQ(body.soup.region_names, (std::vector<std::string>{"solid_1", "solid_2"}));
        const auto& names = body.soup.patch_names;
        EXPECT_EQ(std::count(names.begin(), names.end(), "solid_1_to_solid_2"), 1);
        for (std::size_t f = 0; f < body.soup.sides.size(); ++f)
            if (body.soup.sides[f].is_wall()) {
                EXPECT_EQ(body.soup.sides[f], test::facet_sides(1, 0));
                EXPECT_EQ(names[body.soup.patch[f]], "solid_1_to_solid_2");
            }
        const auto& notes = body.soup.notes;
        EXPECT_NE(std::find(notes.begin(), notes.end(), "Solids touch: they are 2 regions that share 1 face."),
                  notes.end());
        EXPECT_EQ(to_cad_bytes({0, "", body}), to_cad_bytes({0, "", imported(shape, {}, ending)}));
    }
}

TEST_F(CadAssembly, FacesThatTouchInPartAreSplit) {
    const CadBody body =
        imported(together({box({0, 0, 0}, {4, 4, 1}), box({1, 1, 1}, {1, 1, 1}), box({2.5, 3, 1}, {2, 2, 1})}));
    expect_regions(body, {16, 1, 4}, planar);
    EXPECT_NEAR(area_of_walls(body.soup), 1 + 1.5 * 1, 1e-12) << "the third one stands out over two edges";
    EXPECT_EQ(body.faces, 6 + 5 + 6 + 2) << "a part of the third one's bottom is free";
}

TEST_F(CadAssembly, PinInItsHole) {
    constexpr double pi = std::numbers::pi;
    const test::CadShape plate = test::cut(box({-3, -3, 0}, {6, 6, 1}), moved(cylinder(1, 3), {0, 0, -1}));
    const test::CadShape pin = moved(cylinder(1, 3), {0, 0, -1});
    const CadBody body = imported(together({plate, pin}));
    expect_regions(body, {36 - pi, 3 * pi}, 1e-6);
    EXPECT_NEAR(area_of_walls(body.soup), 2 * pi, 0.02);
    const CadBody rough = imported(together({plate, pin}), {.deflection = 0.02});
    expect_regions(rough, {36 - pi, 3 * pi}, 0.05);
    EXPECT_LE(rough.soup.facets.size(), body.soup.facets.size());
    EXPECT_GT(std::abs(rough.volume / rough.exact_volume - 1), 1e-6) << "its vertices stay on the faces";
}

TEST_F(CadAssembly, CurvedWallsBetweenManyRegions) {
    constexpr double pi = std::numbers::pi;
    const test::CadShape ball = test::sphere(1), shell = test::cut(test::sphere(2), test::sphere(1));
    const test::CadShape block = test::cut(box({-3, -3, -3}, {6, 6, 6}), test::sphere(2));
    expect_regions(imported(together({ball, shell, block})), {4 * pi / 3, 4 * pi / 3 * 7, 216 - 4 * pi / 3 * 8},
                   CadOptions::volume_tolerance);
}

TEST_F(CadAssembly, ThreeBoxesAroundAnEdge) {
    const CadBody body =
        imported(together({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {1, 1, 1}), box({0, 1, 0}, {2, 1, 1})}));
    expect_regions(body, {1, 1, 2}, planar);
    EXPECT_NEAR(area_of_walls(body.soup), 3, 1e-12);
    const CadBody four = imported(together(
        {box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {1, 1, 1}), box({0, 1, 0}, {1, 1, 1}), box({1, 1, 0}, {1, 1, 1})}));
    expect_regions(four, {1, 1, 1, 1}, planar);
    EXPECT_EQ(count_walls(four.soup), 8);
}

TEST_F(CadAssembly, EdgesAndVerticesAreCommonToo) {
    const test::CadShape first = box({0, 0, 0}, {1, 1, 1});
    const CadBody edge = imported(together({first, box({1, 1, 0}, {1, 1, 1})}));
    expect_regions(edge, {1, 1}, planar);
    EXPECT_EQ(count_walls(edge.soup), 0);
    EXPECT_EQ(edge.soup.vertices.size(), 14u);
    const CadBody vertex = imported(together({first, box({1, 1, 1}, {1, 1, 1})}));
    expect_regions(vertex, {1, 1}, planar);
    EXPECT_EQ(vertex.soup.vertices.size(), 15u);
    const CadBody crossed = imported(together({box({0, 0, 0}, {3, 1, 1}), box({1, 1, 1}, {1, 1, 3})}));
    expect_regions(crossed, {3, 3}, planar);
    EXPECT_EQ(crossed.soup.vertices.size(), 16u) << "an edge lies on a part of another";
}

// OpenCASCADE has no triangles that end at it: a gap must not be left.
TEST_F(CadAssembly, VertexInAFaceIsRefused) {
    const std::string path = write(together({box({-2, -2, 1}, {4, 4, 1}), test::cone(1, 1)}));
    try {
        import_cad(read_file(path), path);
        ADD_FAILURE() << "not refused";
    } catch (const SolidDefect& defect) {
        EXPECT_NE(std::string(defect.what()).find("a vertex of another solid lies in 'solid 1/face "),
                  std::string::npos)
            << defect.what();
    }
}

TEST_F(CadAssembly, ApartAndTouchingInOneFile) {
    const CadBody body =
        imported(together({box({0, 0, 0}, {1, 1, 1}), box({5, 0, 0}, {1, 1, 1}), box({0, 0, 1}, {1, 1, 1})}));
    expect_regions(body, {1, 1, 1}, planar);
    EXPECT_EQ(count_walls(body.soup), 2);
    EXPECT_TRUE(imported(together({box({0, 0, 0}, {1, 1, 1}), box({5, 0, 0}, {1, 1, 1})})).soup.sides.empty());
}

TEST_F(CadAssembly, RegionsHaveTheNamesOfSolids) {
    const std::string path = folder_.file("named.step");
    test::write_assembly(path, "motor",
                         {{"steel", box({0, 0, 0}, {1, 1, 1}), {0.2, 0.4, 0.6}},
                          {"copper", box({1, 0, 0}, {1, 1, 1}), {0.6, 0.4, 0.2}},
                          {"steel", box({2, 0, 0}, {1, 1, 1})}});
    const CadBody body = import_cad(read_file(path), path);
    expect_regions(body, {1, 1, 1}, planar);
    EXPECT_EQ(body.soup.region_names, (std::vector<std::string>{"steel", "copper", "steel_2"}));
    const auto& names = body.soup.patch_names;
    const auto colour_of = [&](const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        EXPECT_NE(found, names.end()) << name;
        return body.soup.patch_colours.at(static_cast<std::size_t>(found - names.begin()));
    };
    EXPECT_EQ(colour_of("steel_to_copper"), (std::array<std::uint8_t, 4>{51, 102, 153, 255}));
    EXPECT_EQ(colour_of("copper_to_steel_2"), (std::array<std::uint8_t, 4>{153, 102, 51, 255}));
    EXPECT_EQ(colour_of("motor/copper/face 3"), (std::array<std::uint8_t, 4>{153, 102, 51, 255}));
    EXPECT_EQ(names.size(), 16u);
}

TEST_F(CadAssembly, OverlapsAreRefusedWithNamesAndPlace) {
    const test::CadShape unit = box({0, 0, 0}, {1, 1, 1});
    const std::vector<std::pair<test::CadShape, test::CadShape>> overlapping = {
        {unit, box({0.5, 0.5, 0.5}, {1, 1, 1})}, {box({-1, -1, 0}, {3, 3, 3}), unit}, {unit, unit}};
    for (std::size_t i = 0; i < overlapping.size(); ++i) {
        SCOPED_TRACE(i);
        const auto& [one, other] = overlapping[i];
        const std::string message = refusal_of(together({one, box({9, 0, 0}, {1, 1, 1}), other}));
        EXPECT_NE(message.find("solids 'solid 1' and 'solid 3' overlap near ("), std::string::npos) << message;
    }
    const std::string inside =
        refusal_of(together({box({-1, -1, -1}, {3, 3, 3}), box({2, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1})}));
    EXPECT_NE(inside.find("solids 'solid 1' and 'solid 3' overlap near (0.5, 0.5, 0.5)"), std::string::npos) << inside;
    const std::string message =
        refusal_of(together({unit, box({1, 0, 0}, {1, 1, 1}), box({1.5, 0.5, 0.5}, {1, 1, 1})}));
    EXPECT_NE(message.find("solids 'solid 2' and 'solid 3' overlap near (1.75, 0.75, 0.75)"), std::string::npos)
        << message;
}

TEST_F(CadAssembly, RoundingOfOtherProgramsIsNoOverlap) {
    for (const double off : {1e-6, -1e-6, 3e-6}) {
        const test::CadShape shape =
            together({box({0, 0, 0}, {1, 1, 1}), box({1 - off, 0, 0}, {1, 1, 1}), box({0, 0, 1}, {1, 1, 1})});
        expect_regions(imported(shape), {1, 1, 1}, 1e-5);
    }
}

// A line or a point in which curved faces touch others may not be found by OpenCASCADE: then that is said.
TEST_F(CadAssembly, TangentFacesWorkOrAreRefused) {
    const test::CadShape floor = box({-3, -3, -3}, {6, 6, 2});
    for (const test::CadShape& round : {test::sphere(1), test::torus(2, 1)}) {
        const std::string path = write(together({floor, round}));
        try {
            const CadBody body = import_cad(read_file(path), path);
            expect_regions(body, {72, body.exact_volume - 72}, CadOptions::volume_tolerance);
        } catch (const SolidDefect& defect) {
            EXPECT_NE(std::string(defect.what()).find("--unite"), std::string::npos) << defect.what();
        }
    }
}

TEST_F(CadAssembly, WithoutImprintTheyAreRefused) {
    const test::CadShape shape = together({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {1, 1, 1})});
    EXPECT_NE(refusal_of(shape, {.no_imprint = true}).find("'solid 1' and 'solid 2' touch or overlap near ("),
              std::string::npos);
    EXPECT_TRUE(imported(shape, {.unite = true}).soup.sides.empty());
    EXPECT_TRUE(imported(shape, {.unite = true, .no_imprint = true}).soup.sides.empty());
    EXPECT_TRUE(imported(shape, {.solid = 2, .no_imprint = true}).soup.sides.empty());
}

TEST_F(CadAssembly, IsMeshedAndVerified) {
    const std::string path = write(together(
        {box({-2, -2, -1}, {4, 4, 1}), cylinder(1, 2), test::cut(moved(cylinder(1.5, 1), {0, 0, 0}), cylinder(1, 1))}));
    const ChildResult checked = test::run_kerf({"check", path});
    EXPECT_EQ(checked.exit_code, 0) << test::output_of(checked);
    EXPECT_NE(test::output_of(checked).find("3 regions that share"), std::string::npos) << test::output_of(checked);
    const ChildResult refused = test::run_kerf({"check", path, "--no-imprint"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_NE(test::output_of(refused).find("touching solids: "), std::string::npos) << test::output_of(refused);
    const std::string out = folder_.file("out");
    const ChildResult meshed = test::run_kerf({"mesh", path, "-o", out, "-n", "4", "--workers", "1"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    const ChildResult verified = test::run_kerf({"verify", out});
    EXPECT_EQ(verified.exit_code, 0) << test::output_of(verified) << verified.log;
}

}  // namespace
}  // namespace kerf
