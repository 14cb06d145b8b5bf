// 3MF files: what the program kerf-3mf makes of them, and kerf of that.
#include <fstream>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "files/io/cad_body.h"
#include "files/io/threemf_file.h"
#include "files/io/zip_archive.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "threemf/threemf_files.h"

namespace kerf {
namespace {

using test::cube;
using test::object;
using test::placed;

class Threemf : public testing::Test {
 protected:
    std::string write(const std::string& bytes) const {
        std::ofstream(part(), std::ios::binary) << bytes;
        return part();
    }
    CadAnswer answer_for(const std::string& bytes, std::vector<std::string> arguments = {}) const {
        arguments.insert(arguments.begin(), write(bytes));
        const ChildResult result = test::run_program(test::threemf_program(), arguments);
        EXPECT_EQ(result.end, ChildResult::End::exited) << result.describe();
        return from_cad_bytes(result.output);
    }
    Soup soup_of(const std::string& bytes, const std::vector<std::string>& arguments = {}) const {
        CadAnswer answer = answer_for(bytes, arguments);
        EXPECT_EQ(answer.error_code, 0) << answer.message;
        return std::move(answer.body.soup);
    }
    std::string part() const { return folder_.file("part.3mf"); }

    test::TemporaryFolder folder_;
};

double volume_of(const Soup& soup) {
    double six_volumes = 0;
    for (const auto& [a, b, c] : soup.facets)
        six_volumes += soup.vertices[a].dot(soup.vertices[b].cross(soup.vertices[c]));
    return six_volumes / 6;
}

Eigen::AlignedBox3d box_of(const Soup& soup) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : soup.vertices) box.extend(p);
    return box;
}

TEST_F(Threemf, ObjectsArePatchesWhereItemsAndComponentsPlaceThem) {
    // A table whose leg is a cube of 1 x 2 x 3 turned by a quarter about z, so that x becomes y: 2 x 1 x 3 at (-2, 0).
    const std::string leg = placed("component", 1, "0 1 0 -2 0 0 0 0 3 0 0 0");
    const std::string other = placed("component", 1, "1 0 0 0 1 0 0 0 1 5 0 0");
    const std::string bytes = test::threemf(
        object(1, "name=\"leg\"", cube()) +
            object(2, "name=\"table\"", "<components>" + leg + other + "</components>") + object(3, "", cube()),
        placed("item", 2, "1 0 0 0 1 0 0 0 1 100 0 0") + placed("item", 3, "1 0 0 0 1 0 0 0 1 0 50 0"));
    const Soup soup = soup_of(bytes);
    EXPECT_EQ(soup.patch_names, (std::vector<std::string>{"table/leg", "table/leg 2", "object 3"}));
    EXPECT_EQ(soup.facets.size(), 36u);
    EXPECT_EQ(soup.patch[12], 1);
    EXPECT_NEAR(volume_of(soup), 6 + 1 + 1, 1e-12);
    const std::vector<Eigen::AlignedBox3d> boxes = {
        {Vec3(98, 0, 0), Vec3(100, 1, 3)}, {Vec3(105, 0, 0), Vec3(106, 1, 1)}, {Vec3(0, 50, 0), Vec3(1, 51, 1)}};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        Soup one = soup;
        one.vertices = {soup.vertices.begin() + 8 * static_cast<std::ptrdiff_t>(i),
                        soup.vertices.begin() + 8 * static_cast<std::ptrdiff_t>(i + 1)};
        EXPECT_TRUE(box_of(one).isApprox(boxes[i])) << i << ": " << box_of(one).min().transpose();
    }
    EXPECT_FALSE(soup.is_of_model) << "its triangles were chosen";
    const Soup second = soup_of(bytes, {"--solid", "2"});
    EXPECT_EQ(second.patch_names, std::vector<std::string>{"object 3"});
    EXPECT_EQ(answer_for(bytes, {"--solid", "3"}).error_code, 2);
}

TEST_F(Threemf, UnitsAreConverted) {
    const std::string bytes = test::threemf(object(1, "", cube()), placed("item", 1), "inch");
    const Soup in_mm = soup_of(bytes), in_inch = soup_of(bytes, {"--unit", "inch"});
    EXPECT_DOUBLE_EQ(box_of(in_mm).max().x(), 25.4);
    EXPECT_DOUBLE_EQ(box_of(in_inch).max().x(), 1);
    EXPECT_EQ(in_mm.notes.front(), "3MF: unit inch -> mm, 1 build item, 1 object.");
}

// By whatever wrote to a stream: the table of contents counts.
TEST_F(Threemf, SizesMayFollowTheFiles) {
    const std::string resources = object(1, "", cube()), item = placed("item", 1);
    for (const test::ZipSizes sizes : {test::ZipSizes::behind, test::ZipSizes::behind_by_64_bits}) {
        SCOPED_TRACE(static_cast<int>(sizes));
        EXPECT_EQ(volume_of(soup_of(test::threemf(resources, item, "millimeter", 0, sizes))), 1);
        const CadAnswer bomb = answer_for(test::threemf(resources, item, "millimeter", 200'000'000, sizes));
        EXPECT_NE(bomb.message.find("grows to more than 128 times its size"), std::string::npos) << bomb.message;
        const std::string whole = test::threemf(resources, item, "millimeter", 0, sizes);
        for (const std::size_t missing : {std::size_t{20}, std::size_t{40}, whole.size() / 2})
            EXPECT_EQ(answer_for(whole.substr(0, whole.size() - missing)).error_code, 3) << missing;
    }
}

TEST_F(Threemf, MirroredObjectsStayTurnedOutwards) {
    const std::string bytes = test::threemf(object(1, "", cube()), placed("item", 1, "-1 0 0 0 1 0 0 0 1 0 0 0"));
    EXPECT_NEAR(volume_of(soup_of(bytes)), 1, 1e-12);
}

TEST_F(Threemf, SupportsArePassedOver) {
    const std::string bytes = test::threemf(object(1, "", cube()) + object(2, "type=\"support\"", cube()),
                                            placed("item", 1) + placed("item", 2));
    const Soup soup = soup_of(bytes);
    EXPECT_EQ(soup.facets.size(), 12u);
    EXPECT_EQ(soup.notes.back(), "1 object that supports others was ignored.");
}

TEST_F(Threemf, WhatCannotBeReadHasASentence) {
    const std::string good = test::threemf(object(1, "", cube()), placed("item", 1));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {test::threemf(object(1, "", cube()), ""), "holds no facets"},
        {test::threemf("<object", placed("item", 1)), "lib3mf cannot read this 3MF file"},
        {good.substr(0, good.size() - 30), "the archive is truncated"},
        {test::threemf(object(1, "", cube()), placed("item", 1), "millimeter", 200'000'000),
         "grows to more than 128 times its size"}};
    for (const auto& [bytes, sentence] : cases) {
        const CadAnswer answer = answer_for(bytes);
        EXPECT_EQ(answer.error_code, 3) << sentence;
        EXPECT_EQ(answer.message.rfind(part() + ": ", 0), 0u) << answer.message;
        EXPECT_NE(answer.message.find(sentence), std::string::npos) << answer.message;
    }
    for (const std::vector<std::string>& option :
         {std::vector<std::string>{"--unite"}, std::vector<std::string>{"--deflection", "0.1"}})
        EXPECT_EQ(answer_for(good, option).error_code, 2);
}

// Objects of which each is `copies` of the one before: copies^levels cubes, which a library that follows them never
// ends to count.
std::string repeated(int levels, int copies) {
    std::string resources = object(1, "", cube());
    for (int id = 2; id <= levels + 1; ++id) {
        std::string components;
        for (int i = 0; i < copies; ++i)
            components += placed("component", id - 1, "1 0 0 0 1 0 0 0 1 " + std::to_string(2 * i) + " 0 0");
        resources += object(id, "", "<components>" + components + "</components>");
    }
    return test::threemf(resources, placed("item", levels + 1));
}

TEST_F(Threemf, ObjectsThatAreRepeatedWithoutEndAreRefused) {
    for (const auto& [levels, copies] : {std::pair(18, 2), {40, 2}, {60, 9}, {120, 1}}) {
        SCOPED_TRACE(levels);
        const CadAnswer answer = answer_for(repeated(levels, copies));
        EXPECT_EQ(answer.error_code, 3);
        EXPECT_NE(answer.message.find("components repeat objects to more than"), std::string::npos) << answer.message;
    }
    EXPECT_EQ(soup_of(repeated(6, 2)).facets.size(), 12u * 64);
    EXPECT_EQ(soup_of(repeated(90, 1)).facets.size(), 12u);
}

TEST_F(Threemf, KerfMeshesBodiesThatAreApartAndNamesThoseThatMeet) {
    const std::string resources = object(1, "name=\"a\"", cube()) + object(2, "name=\"b\"", cube());
    const std::string out = folder_.file("out");
    write(test::threemf(resources, placed("item", 1) + placed("item", 2, "1 0 0 0 1 0 0 0 1 2 0 0")));
    const ChildResult meshed = test::run_kerf({"mesh", part(), "-o", out, "-n", "1", "--workers", "1"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    EXPECT_NE(meshed.log.find("3MF: unit mm -> mm, 2 build items, 2 objects."), std::string::npos) << meshed.log;
    write(test::threemf(resources, placed("item", 1) + placed("item", 2, "1 0 0 0 1 0 0 0 1 0.5 0 0")));
    const ChildResult overlapping = test::run_kerf({"check", part()});
    EXPECT_EQ(overlapping.exit_code, 3);
    EXPECT_NE(test::output_of(overlapping).find("self-intersection"), std::string::npos)
        << test::output_of(overlapping);
}

TEST(ThreemfFile, IsKnownByItsContent) {
    EXPECT_TRUE(is_threemf(test::threemf("", "")));
    EXPECT_FALSE(is_threemf(test::zip({{"part.stl", "solid"}})));
    EXPECT_TRUE(is_zip(test::zip({{"part.stl", "solid"}})));
    EXPECT_FALSE(is_zip("solid"));
}

}  // namespace
}  // namespace kerf
