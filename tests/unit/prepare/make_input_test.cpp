// Arrays as an input: the same as a file, and refused by the row that is wrong.
#include <limits>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/io/obj_writer.h"
#include "run/prepare/input.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

Input input_of(Soup soup) {
    return make_input(std::move(soup.vertices), std::move(soup.facets), std::move(soup.patch),
                      std::move(soup.patch_names));
}

Error error_of(Soup soup) {
    try {
        input_of(std::move(soup));
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return {ErrorCode::internal, ""};
}

void expect_rows(const Error& error, ElementKind kind, const std::vector<std::int64_t>& rows,
                 const std::string& words) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    ASSERT_EQ(error.elements().size(), 1u) << error.what();
    EXPECT_EQ(error.elements()[0].kind, kind);
    EXPECT_EQ(error.elements()[0].ids, rows);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
}

TEST(MakeInput, IsThatOfAFile) {
    const test::TemporaryFolder folder;
    const Soup box = test::box(Vec3::Zero(), Vec3(1, 2, 3), 2);
    write_obj(folder.file("box.obj"), box.vertices, box.facets, box.patch, box.patch_names);
    const Input read = read_input(folder.file("box.obj")), made = input_of(box);
    EXPECT_EQ(made.complex.arrays().vertices, read.complex.arrays().vertices);
    EXPECT_EQ(made.complex.arrays().facets, read.complex.arrays().facets);
    EXPECT_EQ(made.complex.arrays().patch, read.complex.arrays().patch);
    EXPECT_EQ(made.patch_names, read.patch_names);
    EXPECT_EQ(made.volume, read.volume);
}

TEST(MakeInput, PatchesMayHaveNoNamesOrNotBeThere) {
    Soup box = test::box();
    box.patch_names.clear();
    EXPECT_EQ(input_of(box).patch_names,
              (std::vector<std::string>{"patch_0", "patch_1", "patch_2", "patch_3", "patch_4", "patch_5"}));
    box.patch.clear();
    EXPECT_EQ(input_of(box).patch_names, std::vector<std::string>{"patch_0"});
}

TEST(MakeInput, HashTellsArraysApart) {
    const Soup box = test::box();
    Soup other = box;
    other.vertices[3] *= 2;
    Soup named = box;
    named.patch_names[0] = "inlet";
    EXPECT_EQ(input_of(box).file_hash, input_of(box).file_hash);
    EXPECT_NE(input_of(box).file_hash, input_of(other).file_hash);
    EXPECT_NE(input_of(box).file_hash, input_of(named).file_hash);
}

TEST(MakeInput, NamesTheRowsThatAreWrong) {
    Soup beyond = test::box();
    beyond.facets[7][2] = 8;
    beyond.facets[9][0] = -1;
    expect_rows(error_of(beyond), ElementKind::facet, {7, 9}, "facets[7] is (");
    EXPECT_NE(std::string(error_of(beyond).what()).find("1 more"), std::string::npos);
    Soup repeated = test::box();
    repeated.facets[4][1] = repeated.facets[4][0];
    expect_rows(error_of(repeated), ElementKind::facet, {4}, "facets[4] is (");
    Soup infinite = test::box();
    infinite.vertices[5].y() = std::numeric_limits<double>::quiet_NaN();
    expect_rows(error_of(infinite), ElementKind::vertex, {5}, "vertices[5] is (");
    Soup unnamed = test::box();
    unnamed.patch[11] = 6;
    expect_rows(error_of(unnamed), ElementKind::facet, {11}, "patch[11] is 6");
    unnamed.patch_names.clear();
    unnamed.patch[11] = std::numeric_limits<std::int32_t>::max();
    expect_rows(error_of(unnamed), ElementKind::facet, {11}, "patch[11] is 2147483647");
}

TEST(MakeInput, RefusesSizesThatDoNotFit) {
    Soup box = test::box();
    box.patch.pop_back();
    EXPECT_EQ(error_of(box).code(), ErrorCode::usage);
    EXPECT_EQ(error_of({}).code(), ErrorCode::input);
}

// What a file is refused for has elements, too: a hole has the facets around it and the names of their patches.
TEST(MakeInput, AHoleHasElements) {
    Soup open = test::box();
    open.facets.pop_back();
    open.patch.pop_back();
    const Error error = error_of(open);
    EXPECT_NE(std::string(error.what()).find("open edge loop"), std::string::npos) << error.what();
    ASSERT_EQ(error.elements().size(), 1u);
    EXPECT_EQ(error.elements()[0].kind, ElementKind::facet);
    EXPECT_EQ(error.elements()[0].ids.size(), 3u);
    EXPECT_EQ(error.elements()[0].points.size(), 1u);
    EXPECT_FALSE(error.elements()[0].names.empty());
}

}  // namespace
}  // namespace kerf
