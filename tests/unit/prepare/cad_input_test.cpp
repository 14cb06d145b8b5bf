// What needs no OpenCASCADE: CAD files are known by their content, and the program that reads them may be missing,
// crash, hang, or say nothing.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/io/cad_body.h"
#include "files/io/program_finder.h"
#include "files/io/surface_reader.h"
#include "run/prepare/cad_input.h"
#include "support/assets.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

const std::string step = "ISO-10303-21;\nHEADER;\nENDSEC;\nEND-ISO-10303-21;\n";

CadBody triangle() {
    CadBody body;
    body.soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    body.soup.facets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    body.soup.patch = {0, 0, 1, 1};
    body.soup.patch_names = {"a/face 1", "a/face 2"};
    body.soup.notes = {"a note"};
    body.soup.model_edges = {{{0, 1}, 1}, {{1, 3}, 0}};
    body.soup.patch_colours = {{1, 2, 3, 255}, {0, 0, 0, 0}};
    body.format = "STEP";
    body.file_hash = digest_of(step);
    return body;
}

class CadInput : public testing::Test {
 protected:
    CadInput() { write("part.step", step); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.file(name), std::ios::binary) << text;
        return folder_.file(name);
    }
    // A shell script in the place of kerf-cad.
    std::string program(const std::string& commands) const {
        const std::string path = write("program", "#!/bin/sh\n" + commands + "\n");
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        return path;
    }
    std::string answering(const CadAnswer& answer) const {
        const Bytes bytes = to_cad_bytes(answer);
        return program("cat '" + write("answer", {bytes.begin(), bytes.end()}) + "'");
    }
    Error error_of(const std::string& program, double timeout_seconds = 20) const {
        try {
            read_cad(part(), digest_of(step), {}, program, timeout_seconds);
        } catch (const Error& error) {
            return error;
        }
        ADD_FAILURE() << "nothing was thrown";
        return {ErrorCode::internal, ""};
    }
    std::string part() const { return folder_.file("part.step"); }

    test::TemporaryFolder folder_;
};

TEST_F(CadInput, AnswersOfTheProgramArriveWhole) {
    const CadBody body = read_cad(part(), digest_of(step), {}, answering({0, "", triangle()}));
    EXPECT_EQ(to_cad_bytes({0, "", body}), to_cad_bytes({0, "", triangle()}));
    EXPECT_EQ(body.soup.patch_names.back(), "a/face 2");
    EXPECT_EQ(body.soup.model_edges.back().sharp, 0);
}

TEST_F(CadInput, RefusalsOfTheProgramKeepCodeAndSentence) {
    const Error error = error_of(answering({3, "part.step: it is open.", {}}));
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_STREQ(error.what(), "part.step: it is open.");
}

TEST_F(CadInput, MissingProgramIsNamedWithItsPackage) {
    const Error error = error_of("");
    EXPECT_EQ(error.code(), ErrorCode::usage);
    for (const char* word : {"part.step", "kerf-cad", "libocct-data-exchange-7.6", "libocct-data-exchange-dev", "STL"})
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    EXPECT_EQ(error_of(folder_.file("nowhere")).code(), ErrorCode::io);
}

TEST_F(CadInput, CrashesHangsAndSilenceGetASentence) {
    const Error crashed = error_of(program("kill -SEGV $$"));
    EXPECT_EQ(crashed.code(), ErrorCode::input);
    EXPECT_NE(std::string(crashed.what()).find("part.step"), std::string::npos) << crashed.what();
    EXPECT_NE(std::string(crashed.what()).find("signal 11"), std::string::npos) << crashed.what();
    const Error hung = error_of(program("exec sleep 60"), 0.2);
    EXPECT_EQ(hung.code(), ErrorCode::input);
    EXPECT_NE(std::string(hung.what()).find("0.2 s"), std::string::npos) << hung.what();
    const Error silent = error_of(program("echo libTKernel.so.7: not found >&2; exit 127"));
    EXPECT_EQ(silent.code(), ErrorCode::io);
    EXPECT_NE(std::string(silent.what()).find("libTKernel.so.7: not found"), std::string::npos) << silent.what();
}

TEST_F(CadInput, CutAnswersAreNoAnswers) {
    const Bytes bytes = to_cad_bytes({0, "", triangle()});
    for (const std::size_t length : {std::size_t{0}, std::size_t{5}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_THROW(from_cad_bytes(std::span(bytes).first(length)), Error) << length;
}

TEST_F(CadInput, FileThatChangedMeanwhileIsRefused) {
    CadBody other = triangle();
    other.file_hash[0] ^= 1;
    EXPECT_EQ(error_of(answering({0, "", other})).code(), ErrorCode::io);
}

TEST(CadFormats, AreKnownByTheirFirstBytes) {
    EXPECT_EQ(cad_format(step), CadFormat::step);
    EXPECT_EQ(cad_format("\r\n " + step), CadFormat::step);
    EXPECT_EQ(cad_format("DBRep_DrawableShape\n\nCASCADE Topology V1"), CadFormat::brep);
    EXPECT_EQ(cad_format("CASCADE Topology V1, (c) Matra-Datavision"), CadFormat::brep);
    EXPECT_EQ(cad_format(std::string(72, ' ') + "S      1\n"), CadFormat::iges);
    for (const std::string& text : {std::string(), std::string(" \n"), std::string("solid cube"), "x" + step,
                                    std::string(72, ' ') + "S shape\n", std::string(72, ' ') + "S"})
        EXPECT_EQ(cad_format(text), CadFormat::none) << text;
}

TEST_F(CadInput, ThreemfHasAProgramOfItsOwn) {
    const std::string threemf = std::string("PK\3\4") + " _rels/.rels 3D/3dmodel.model";
    write("part.3mf", threemf);
    try {
        read_surface_or_cad(folder_.file("part.3mf"));
        ADD_FAILURE() << "read without a program";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        for (const char* word : {"part.3mf", "kerf-3mf", "lib3mf1", "lib3mf-dev", "STL"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
    CadBody body = triangle();
    body.file_hash = digest_of(threemf);
    std::filesystem::rename(answering({0, "", body}), folder_.file("kerf-3mf"));
    setenv(programs_variable, folder_.file("").c_str(), 1);
    EXPECT_EQ(read_surface_or_cad(folder_.file("part.3mf")).soup.facets, body.soup.facets);
    unsetenv(programs_variable);
}

TEST(CadFormats, AreRefusedWhereOnlyTrianglesAreRead) { EXPECT_THROW(read_surface_bytes(step, "part.step"), Error); }

TEST(CadOptionsText, ComesBackAsItWas) {
    CadOptions options{
        .solid = 3, .unite = true, .no_imprint = true, .unit = LengthUnit::inch, .deflection = 1.0 / 3000};
    EXPECT_EQ(CadOptions::from_arguments(options.arguments()).arguments(), options.arguments());
    EXPECT_TRUE(CadOptions::from_arguments(options.arguments()).no_imprint);
    EXPECT_EQ(CadOptions::from_arguments(CadOptions{}.arguments()).arguments(), CadOptions{}.arguments());
    using Arguments = std::vector<std::string>;
    for (const Arguments& wrong : {Arguments{"--solid"}, Arguments{"--solid", "-1"}, Arguments{"--unit", "mile"},
                                   Arguments{"--deflection", "1"}, Arguments{"--colour", "1"}})
        EXPECT_THROW(CadOptions::from_arguments(wrong), Error) << wrong.front();
}

TEST(CadOptionsText, HasNoMeaningForTriangles) {
    InputOptions options, in_mm;
    options.cad.solid = 1;
    EXPECT_THROW(read_surface_or_cad(test::asset_path("cube"), options), Error);
    in_mm.cad.unit_is_asked = true;
    EXPECT_THROW(read_surface_or_cad(test::asset_path("cube"), in_mm), Error);
    EXPECT_EQ(read_surface_or_cad(test::asset_path("cube")).soup.facets.size(),
              read_surface(test::asset_path("cube")).facets.size());
}

TEST_F(CadInput, OthersAreScaledWithTheirHoles) {
    const std::string path = test::asset_path("cube");
    InputOptions scaled;
    scaled.scale = 0.5;
    const Soup whole = read_surface(path), half = read_surface_or_cad(path, scaled).soup;
    ASSERT_EQ(half.vertices.size(), whole.vertices.size());
    for (std::size_t v = 0; v < whole.vertices.size(); ++v) EXPECT_EQ(2 * half.vertices[v], whole.vertices[v]);
    const std::string poly = write("a.poly", "3 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1\n1\n3 1 2 3\n1\n1 4 6 8\n");
    EXPECT_EQ(read_surface_or_cad(poly, scaled).soup.holes, std::vector<Vec3>{Vec3(2, 3, 4)});
}

TEST(ModelEdges, FollowTheirVertices) {
    Soup soup = triangle().soup;
    soup.vertices.insert(soup.vertices.begin(), {9, 9, 9});  // used by no facet
    for (Triangle& t : soup.facets)
        for (std::int32_t& v : t) ++v;
    soup.model_edges = {{{1, 2}, 1}, {{2, 4}, 0}, {{0, 1}, 1}};
    drop_unused_vertices(soup);
    ASSERT_EQ(soup.model_edges.size(), 2u);
    EXPECT_EQ(soup.model_edges[0].vertices, (UndirectedEdge{0, 1}));
    EXPECT_EQ(soup.model_edges[1].vertices, (UndirectedEdge{1, 3}));
    weld_within(soup, 1.1);
    EXPECT_TRUE(soup.model_edges.empty()) << "all vertices are one";
}

}  // namespace
}  // namespace kerf
