#include "files/io/surface_reader.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/io/inside/tet_skin.h"
#include "support/archives.h"
#include "support/shapes.h"
#include "support/surface_files.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;
using namespace test;

// A file in the folder for temporary files that disappears with its object.
class TemporaryFile {
 public:
    explicit TemporaryFile(const std::string& bytes, const std::string& ending = "")
        : path_(fs::temp_directory_path() / ("kerf_surface_reader_test_" + std::to_string(getpid()) + ending)) {
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    ~TemporaryFile() { fs::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    std::string path() const { return path_.string(); }

 private:
    fs::path path_;
};

Soup read_bytes(const std::string& bytes, const std::string& ending = "") {
    return read_surface(TemporaryFile(bytes, ending).path());
}

std::string message_of(const std::string& bytes, const std::string& ending = "") {
    try {
        read_bytes(bytes, ending);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
        EXPECT_NE(std::string(error.what()).find("kerf_surface_reader_test"), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "accepted:\n" << bytes;
    return "";
}

std::vector<Soup> shapes() {
    return {tetrahedron(), box(Vec3(-1, 2, 1.0 / 3), Vec3(5, 7, 11), 3), icosphere(2, 1e-5, Vec3(100, 0, 0)),
            torus(3, 1, 7, 5)};
}

void expect_same(const Soup& a, const Soup& b) {
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.facets, b.facets);
}

// The corners of all facets as they are in a binary STL.
std::vector<Vec3> float_corners(const Soup& soup) {
    std::vector<Vec3> corners;
    for (const Triangle& t : soup.facets)
        for (std::int32_t v : t) corners.push_back(soup.vertices[v].cast<float>().cast<double>());
    return corners;
}

TEST(SurfaceReader, GivesBackWhatTheIndexedFormatsHold) {
    for (const Soup& soup : shapes()) {
        SCOPED_TRACE(soup.patch_names.front());
        for (const std::string& bytes :
             {to_obj(soup), to_off(soup), to_ascii_ply(soup), to_binary_ply(soup, false), to_binary_ply(soup, true)}) {
            SCOPED_TRACE(bytes.substr(0, 40));
            expect_same(read_bytes(bytes), soup);
        }
        const Soup from_obj = read_bytes(to_obj(soup));
        EXPECT_EQ(from_obj.patch, soup.patch);
        EXPECT_EQ(from_obj.patch_names, soup.patch_names);
    }
}

TEST(SurfaceReader, GivesBackWhatMeditAndTetgenHold) {
    for (const Soup& soup : shapes()) {
        SCOPED_TRACE(soup.patch_names.front());
        std::vector<Soup> read = {read_bytes(to_medit(soup))};
        for (const int first : {0, 1}) {
            read.push_back(read_bytes(to_tetgen(soup, first, false), ".smesh"));
            read.push_back(read_bytes(to_tetgen(soup, first, true), ".poly"));
        }
        for (std::size_t i = 0; i < read.size(); ++i) {
            SCOPED_TRACE(i);
            expect_same(read[i], soup);
            EXPECT_EQ(read[i].patch, soup.patch);
            EXPECT_EQ(read[i].patch_names.front(), i == 0 ? "reference_10" : "marker_10");
        }
    }
}

TEST(SurfaceReader, GivesBackWhatGmshHolds) {
    for (const Soup& soup : shapes())
        for (const bool is_msh41 : {false, true})
            for (const auto& [is_binary, is_big_endian] : {std::pair(false, false), {true, false}, {true, true}}) {
                SCOPED_TRACE(soup.patch_names.front() + (is_msh41 ? " 4.1" : " 2.2"));
                SCOPED_TRACE(is_binary ? is_big_endian ? "big endian" : "little endian" : "text");
                const Soup read = read_bytes(to_msh(soup, {is_msh41, is_binary, is_big_endian}));
                expect_same(read, soup);
                EXPECT_EQ(read.patch, soup.patch);
                EXPECT_EQ(read.patch_names, soup.patch_names);
                EXPECT_EQ(read.notes, (std::vector<std::string>{"1 line was ignored.", "1 point was ignored."}));
            }
}

TEST(SurfaceReader, GivesBackWhatVtkHolds) {
    using enum VtuStyle::Values;
    for (const Soup& soup : shapes()) {
        std::vector<std::string> files;
        for (const auto values : {text, base64, compressed_base64, appended, compressed_appended, appended_base64})
            for (const bool is_big_endian : {false, true})
                files.push_back(to_vtp(soup, {values, is_big_endian, !is_big_endian}));
        for (const bool is_binary : {false, true})
            for (const bool is_version_5 : {false, true})
                for (const bool is_grid : {false, true})
                    files.push_back(to_vtk(soup, {is_binary, is_version_5, is_grid}));
        for (const std::string& bytes : files) {
            SCOPED_TRACE(soup.patch_names.front() + " of " + bytes.substr(0, 120));
            const Soup read = read_bytes(bytes);
            expect_same(read, soup);
            EXPECT_EQ(read.patch, soup.patch);
            EXPECT_EQ(read.patch_names, soup.patch_names);
            EXPECT_EQ(read.notes, std::vector<std::string>{"1 cell that is no tetrahedron or triangle was ignored."});
        }
    }
}

TEST(VtkReader, ReadsPolygonsStripsAndAllKindsOfArrays) {
    const std::string text =
        "# vtk DataFile Version 4.2\n\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1\n"
        "METADATA\nINFORMATION 0\n\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\nPOLYGONS 2 9\n3 0 1 4\n4 3 2 1 0\n"
        "CELL_DATA 3\nSCALARS temperature float\nLOOKUP_TABLE own\n1 2 3\nLOOKUP_TABLE own 1\n1 1 1 1\n"
        "COLOR_SCALARS c 3\n0 0 0 0 0 0 0 0 0\nVECTORS v double\n1 2 3 4 5 6 7 8 9\nFIELD f 2\n"
        "two%20words 2 3 int\n1 2 3 4 5 6\nPatch 1 3 short\n4 1 4\nPOINT_DATA 5\nNORMALS n float\n"
        "0 0 1 0 0 1 0 0 1 0 0 1 0 0 1\nTEXTURE_COORDINATES t 2 float\n0 0 0 0 0 0 0 0 0 0\n";
    const Soup soup = read_bytes(text);
    // Polygons come before strips, whatever their order in the file, and the arrays of cells count them so.
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 4}, {3, 2, 1}, {3, 1, 0}, {0, 1, 3}, {3, 1, 2}}));
    EXPECT_EQ(soup.patch_names, (std::vector<std::string>{"patch_4", "patch_1"}));
    EXPECT_EQ(soup.patch, (std::vector<std::int32_t>{0, 1, 1, 0, 0}));
}

TEST(VtkReader, NamesThePlaceAndTheCause) {
    const std::string head = "# vtk DataFile Version 3.0\na title\nASCII\nDATASET ";
    const std::string points = head + "POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
    for (const auto& [bytes, expected] : std::vector<std::array<std::string, 2>>{
             {head.substr(0, 40), "ends too early"},
             {"# vtk DataFile Version 3.0\na\nTEXT\n", "line 3: neither ASCII nor BINARY"},
             {head + "STRUCTURED_POINTS\n", "an image of VTK"},
             {head + "RECTILINEAR_GRID\n", "is no surface"},
             {head + "POLYDATA\nPOINTS 3 fload\n", "line 5: the type \"fload\" is unknown"},
             {points, "holds no facets"},
             {points + "POLYGONS 1 4\n3 0 1 3\n", "cell 0: a facet names vertex number 3"},
             {points + "POLYGONS 1 4\n4 0 1 2\n", "line 8: cell 0 (counted from 0) ends behind the list"},
             {points + "POLYGONS 1 4\n3 0 1\n", "ends too early"},
             {points + "POLYGONS 1 400000000000\n3 0 1 2\n", "more than it can hold"},
             {points + "FACETS 1\n", "line 7: the keyword \"facets\" is unknown"},
             {points + "POLYGONS 1 4\n3 0 1 2\nCELL_DATA 2\nSCALARS Patch int\nLOOKUP_TABLE default\n1 2\n",
              "array Patch has 2 values for 1 cells"},
             {head + "UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\n",
              "1 cells and 0 types"}})
        EXPECT_NE(message_of(bytes).find(expected), std::string::npos) << message_of(bytes);
}

TEST(SurfaceReader, WeldsTheCornersOfStl) {
    for (const Soup& soup : shapes()) {
        SCOPED_TRACE(soup.patch_names.front());
        const Soup ascii = read_bytes(to_ascii_stl(soup));
        EXPECT_EQ(ascii.vertices.size(), soup.vertices.size());
        ASSERT_EQ(ascii.facets.size(), soup.facets.size());
        for (std::size_t f = 0; f < soup.facets.size(); ++f)
            for (int i = 0; i < 3; ++i) ASSERT_EQ(ascii.vertices[ascii.facets[f][i]], soup.vertices[soup.facets[f][i]]);
        EXPECT_EQ(ascii.patch, soup.patch);
        EXPECT_EQ(ascii.patch_names, soup.patch_names);
        EXPECT_EQ(float_corners(read_bytes(to_binary_stl(soup))), float_corners(soup));
    }
}

TEST(SurfaceReader, TellsBinaryStlByItsSizeWhateverItsHeaderSays) {
    for (const char* header : {"", "solid", "solid facet normal 0 0 0", "OFF", "ply", "v 1 2 3", "#"}) {
        SCOPED_TRACE(header);
        EXPECT_EQ(read_bytes(to_binary_stl(box(), header)).facets.size(), 12u);
    }
}

TEST(SurfaceReader, TellsEveryFormatByItsContentWhateverTheEnding) {
    for (const Soup& soup : shapes())
        for (const SurfaceFile& file : to_all_formats(soup)) {
            const Soup expected = read_bytes(file.bytes, fs::path(file.name).extension());
            for (const char* ending :
                 {"", ".stl", ".obj", ".ply", ".off", ".msh", ".mesh", ".smesh", ".poly", ".vtk", ".txt"}) {
                SCOPED_TRACE(file.name + " as " + ending);
                expect_same(read_bytes(file.bytes, ending), expected);
            }
        }
}

TEST(SurfaceReader, ReadsArchivesOfEveryFormat) {
    const Soup soup = box(Vec3(-1, 2, 1.0 / 3), Vec3(5, 7, 11), 2);
    for (const SurfaceFile& file : to_all_formats(soup)) {
        SCOPED_TRACE(file.name);
        const std::string ending = fs::path(file.name).extension();
        const Soup expected = read_bytes(file.bytes, ending);
        expect_same(read_bytes(gzip(file.bytes), ending + ".gz"), expected);
        expect_same(read_bytes(zstd(file.bytes), ending + ".zst"), expected);
    }
}

TEST(SurfaceReader, ReadsEveryKindOfLineEnd) {
    for (const SurfaceFile& file : to_all_formats(box())) {
        if (file.bytes.find('\0') != std::string::npos) continue;
        for (const char* line_end : {"\r\n", "\r"}) {
            SCOPED_TRACE(file.name + (line_end[1] ? " CR LF" : " CR"));
            std::string bytes;
            for (const char c : file.bytes) c == '\n' ? bytes += line_end : bytes += c;
            const Soup soup = read_bytes(bytes, fs::path(file.name).extension());
            expect_same(soup, read_bytes(file.bytes, fs::path(file.name).extension()));
            EXPECT_EQ(soup.patch_names, read_bytes(file.bytes).patch_names);
        }
    }
}

TEST(SurfaceReader, RefusesEveryTruncation) {
    const Soup soup = tetrahedron();
    for (const std::string& bytes : {to_binary_stl(soup), to_binary_stl(soup, "solid"), to_ascii_stl(soup),
                                     to_off(soup), to_ascii_ply(soup), to_binary_ply(soup, true)}) {
        // The text formats may lose their last characters without a loss of numbers or keywords.
        const std::size_t end = bytes.find("endsolid") == std::string::npos ? bytes.size() - 2 : bytes.find("endsolid");
        for (std::size_t size = 0; size < end; ++size) {
            SCOPED_TRACE(bytes.substr(0, 20) + " at " + std::to_string(size));
            message_of(bytes.substr(0, size));
        }
    }
}

TEST(SurfaceReader, RefusesEveryTruncationBeforeTheLastFacet) {
    const Soup soup = tetrahedron();
    const auto expect_refused = [](const std::string& bytes, std::size_t end, const std::string& ending) {
        for (std::size_t size = 0; size < end; ++size) {
            SCOPED_TRACE(ending + " at " + std::to_string(size));
            message_of(bytes.substr(0, size), ending);
        }
    };
    const std::string medit = to_medit(soup), smesh = to_tetgen(soup, 1, false), poly = to_tetgen(soup, 0, true);
    expect_refused(medit, medit.find("\nTetrahedra") - 1, ".mesh");  // the reference has two digits
    expect_refused(smesh, smesh.rfind(" 10 # facet"), ".smesh");     // a marker may be missing
    expect_refused(poly, poly.rfind(" # facet"), ".poly");
    for (const bool is_msh41 : {false, true})
        for (const bool is_binary : {false, true}) {
            const std::string msh = to_msh(soup, {is_msh41, is_binary, true});
            expect_refused(msh, msh.rfind("$EndElements") - 4, ".msh");
        }
}

TEST(SurfaceReader, ReportsATruncatedBinaryStlThatBeginsWithSolidAsSuch) {
    std::string bytes = to_binary_stl(icosphere(1), "solid part");
    bytes.resize(bytes.size() - 75);
    const std::string message = message_of(bytes);
    EXPECT_NE(message.find("binary STL is truncated"), std::string::npos) << message;
    EXPECT_NE(message.find("claims 80 facets"), std::string::npos) << message;
    EXPECT_NE(message.find("facet 78 "), std::string::npos) << message;
}

TEST(SurfaceReader, KeepsIndicesInRangeOnDamagedFiles) {
    const Soup soup = box();
    const std::vector<std::array<std::string, 2>> files = {{to_binary_stl(soup), ".stl"},
                                                           {to_ascii_stl(soup), ".stl"},
                                                           {to_obj(soup), ".obj"},
                                                           {to_off(soup), ".off"},
                                                           {to_ascii_ply(soup), ".ply"},
                                                           {to_binary_ply(soup, false), ".ply"},
                                                           {to_msh(soup, {false, false, false}), ".msh"},
                                                           {to_msh(soup, {true, true, true}), ".msh"},
                                                           {to_medit(soup), ".mesh"},
                                                           {to_vtk(soup, {false, false, false}), ".vtk"},
                                                           {to_vtk(soup, {true, true, true}), ".vtk"},
                                                           {to_vtp(soup, {}), ".vtp"},
                                                           {to_tetgen(soup, 0, false), ".smesh"},
                                                           {to_tetgen(soup, 1, true), ".poly"}};
    for (const auto& [bytes, ending] : files)
        for (unsigned seed = 1; seed <= 300; ++seed) {
            SCOPED_TRACE(bytes.substr(0, 20) + " seed " + std::to_string(seed));
            std::mt19937 random(seed);
            std::string damaged = bytes;
            for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
            try {
                const Soup read = read_bytes(damaged, ending);
                ASSERT_EQ(read.patch.size(), read.facets.size());
                for (const Triangle& t : read.facets)
                    for (std::int32_t v : t) ASSERT_LT(static_cast<std::size_t>(v), read.vertices.size());
                for (std::int32_t p : read.patch) ASSERT_LT(static_cast<std::size_t>(p), read.patch_names.size());
            } catch (const Error& error) {
                ASSERT_EQ(error.code(), ErrorCode::input) << error.what();
            }
        }
}

TEST(SurfaceReader, DoesNotBelieveClaimedCounts) {
    message_of("OFF\n2000000000 2000000000 0\n0 0 0\n");
    message_of(
        "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n");
    message_of("ply\nformat ascii 1.0\nelement nothing 9000000000000000000\nend_header\n");
    std::string list =
        "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int vertex_index\nend_header\n";
    append(list, std::numeric_limits<std::uint32_t>::max());
    message_of(list);
    message_of("MeshVersionFormatted 2 Dimension 3 Vertices 9000000000000000000 0 0 0 0");
    message_of("9000000000000000000 3\n1 0 0 0\n", ".smesh");
    message_of("1 3\n1 0 0 0\n1 0\n9000000000000000000 1 1 1", ".smesh");
}

// The corners of so many facets have no numbers. A file of this size is not made for the test: its header says enough.
TEST(SurfaceReader, RefusesMoreFacetsThanCanBeNumbered) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
        "element face ?\nproperty list uchar int vertex_index\nend_header\n";
    const std::string medit = "MeshVersionFormatted 2\nDimension 3\nVertices 0\n", nodes = "1 3 0 0\n1 0 0 0\n";
    const std::string msh41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n0 0 0 0\n$EndNodes\n";
    std::string msh2 = "$MeshFormat\n2.2 1 8\n";
    append(msh2, std::int32_t{1});
    msh2 += "\n$EndMeshFormat\n$Elements\n900000000\n";
    append(msh2, std::int32_t{2});  // triangles
    struct Case {
        std::string name, ending;
        std::function<std::string(std::uint32_t)> bytes;
    };
    const auto text = [](const std::string& pattern) {
        return [pattern](std::uint32_t count) {
            std::string bytes;
            for (const char c : pattern) bytes += c == '?' ? std::to_string(count) : std::string(1, c);
            return bytes;
        };
    };
    const auto binary = [](const std::string& begin) {
        return [begin](std::uint32_t count) {
            std::string bytes = begin;
            append(bytes, count);
            return bytes + std::string(8, '\0');
        };
    };
    const std::vector<Case> cases = {{"binary STL", ".stl", binary(std::string(80, ' '))},
                                     {"PLY", ".ply", text(ply)},
                                     {"OFF", ".off", text("OFF\n0 ? 0\n")},
                                     {"MEDIT", ".mesh", text(medit + "Triangles ?\n")},
                                     {"MEDIT", ".mesh", text(medit + "Quadrilaterals ?\n")},
                                     {"TetGen", ".smesh", text(nodes + "? 0\n")},
                                     {"TetGen", ".poly", text(nodes + "? 1\n")},
                                     {"MSH 2", ".msh", binary(msh2)},
                                     {"MSH 4.1", ".msh", text(msh41 + "$Elements\n1 ? 1 ?\n2 1 2 ?\n")}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const std::string limit = "a surface can have 715827882 at most";
        EXPECT_NE(message_of(c.bytes(800'000'000), c.ending).find(limit), std::string::npos);
        EXPECT_NE(message_of(c.bytes(715'827'883), c.ending).find(limit), std::string::npos);
        EXPECT_EQ(message_of(c.bytes(715'827'882), c.ending).find(limit), std::string::npos);
    }
}

TEST(SurfaceReader, NamesThePlaceAndTheCause) {
    struct Case {
        std::string bytes, expected, ending = "";
    };
    const std::string medit = "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n";
    const std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
    const std::string nodes = "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";
    const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
    const std::vector<Case> cases = {
        {"", "empty"},
        {"PK\x03\x04 something else", "this is a ZIP archive"},
        {std::string("PK\x03\x04\0\0", 6) + std::string(100, '\0') + "_rels/.rels 3D/3dmodel.model",
         "this is a 3MF file"},
        {"PK\x03\x04 something else", "has no 3MF model in it", ".3mf"},
        {"1 2 3\n4 5 6\n", "not recognised"},
        {"0.5 3 0\n", "not recognised"},
        {std::string("\1\0\0\0\3\0\0\0\3\0\0\0", 12), "binary MEDIT (.meshb) is not supported"},
        {std::string("\0\0\0\1\0\0\0\2\0\0\0\3", 12), "binary MEDIT (.meshb) is not supported"},
        {"solid a\nendsolid a\n", "no facets"},
        {"solid a\n" + facet, "truncated"},
        {"solid a\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 0 0 blah\n", "line 5: a number is expected"},
        {"solid a\n" + facet + "facette\n", "line 3: \"facet\" or \"endsolid\" is expected"},
        {"solid a\n" + facet + "end facet\n", "line 3: \"solid\" is expected, not \"facet\""},
        {"solid a\nfacet normal 0 0 1 outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\n",
         "line 6: \"endloop\" is expected"},
        {to_binary_stl(tetrahedron()) + std::string(50, 'x'), "longer than its header claims 4 facets"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: a facet names vertex number 3 (counted from 0)"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4: a face names vertex 0"},
        {"v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3: a facet has less than three vertices"},
        {"v 0 0\nv 1 0 0\n", "line 1: a vertex has less than three coordinates"},
        {"v 0 0 1,5\n", "line 1: a number is expected, not \"1,5\""},
        {"v 0 0 0\nf 1 1 99999999999999999999\n", "line 2: the number \"99999999999999999999\" is too large"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n", "line 6: a facet names vertex number 5"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "line 7: the file goes on after the 1 facets"},
        {"OFF\n-3 1 0\n", "line 2: a number of elements is negative"},
        {"OFF BINARY\n", "binary OFF is not supported"},
        {"4OFF\n", "three dimensions"},
        {"ply\nformat ascii 2.0\nelement vertex 1\nproperty quad x\n", "line 4: the type \"quad\" is unknown"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
         "the vertices have no property z"},
        {"ply\nformat binary_middle_endian 1.0\n", "line 2: the format"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar float vertex_index\nend_header\n3 0 1 0.5\n",
         "line 6: a whole number is expected"},
        {"MeshVersionFormatted 2\nDimension 2\n", "line 2: the dimension is not 3"},
        {medit, "no facets"},
        {medit + "Triangles 1\n1 2 4 0\n", "line 8: a facet names vertex number 3"},
        {medit + "Triangles 1\n0 2 3 0\n", "line 8: an index is 0, but the file counts from 1"},
        {medit + "0 0 1 0\n", "line 7: a keyword is expected, not \"0\""},
        {medit + "TrianglesP3 1\n1 2 3 1 2 3 1 2 3 1 0\n", "line 7: curved elements (TrianglesP3)"},
        {medit + "TrianglesP2 1\n1 2 3 1 2 0 0\n", "line 8: an index is 0, but the file counts from 1"},
        {medit + "Triangles -1\n", "line 7: a number of elements is negative"},
        {"$NOD\n1\n",
         "line 1: MSH version 1 ($NOD, $ELM) cannot be read. Save the mesh as MSH 2.2 or 4.1, for "
         "example with gmsh FILE -save -format msh41 -o NEW.msh."},
        {"$Comments\nx\n$EndComments\n$ELM\n1\n", "MSH version 1 ($NOD, $ELM) cannot be read"},
        {"$MeshFormat\n4 0 8\n", "line 2: MSH version 4 cannot be read"},
        {"$MeshFormat\n4.1 1 8\n\x02\x01\x01\x02$EndMeshFormat\n", "order of the bytes is not 1"},
        {"$MeshFormat\n4.1 0 4\n", "line 2: the size of a real number is not 8"},
        {"$Nodes\n0\n", "$MeshFormat is missing"},
        {msh, "no facets"},
        {msh + "$Elements\n1\n1 2 0 1 2 4\n", "line 12: element 1 names node 4, which the file does not have"},
        {msh + "$Elements\n1\n1 9 0 1 2 3 1 2\n", "line 12: the file ends too early"},
        {msh + "$Elements\n1\n1 77 0 1 2 3\n", "line 12: elements of type 77 cannot be read"},
        {msh + "$Elements\n1\n1 2 0 1 2\n", "line 12: the file ends too early"},
        {msh + "$Nodes\n2\n1 0 0 0\n1 0 0 0\n", "there are two nodes 1"},
        {"3 2 0 0\n1 0 0\n", "line 1: the dimension is not 3", ".poly"},
        {"2 3\n1 0 0 0\n3 0 0 0\n", "line 3: the nodes are not numbered one by one", ".smesh"},
        {"1 3\n2 0 0 0\n", "line 2: the nodes are not numbered one by one", ".smesh"},
        {nodes + "1 0\n3 1 2 4\n", "line 6: a facet names vertex number 3", ".smesh"},
        {nodes + "1 0\n3 1 2 0\n", "line 6: an index is 0, but the file counts from 1", ".smesh"},
        {nodes + "1 0\n2 1 2\n", "line 6: a facet has less than three", ".smesh"},
        {nodes + "1 0\n0\n", "line 6: a facet has no polygon", ".poly"},
        {nodes + "1 0\n2\n3 1 2 3\n0\n", "line 8: a polygon has no vertices", ".poly"},
        {nodes + "1 0\n2\n3 1 2 3\n2 1 4\n", "line 8: a facet names vertex number 3", ".poly"},
        {nodes + "1 0\n1 1\n3 1 2 3\n1 0.5 0 0\n", "line 8: facet 0 (counted from 0) has its hole point", ".poly"},
        {nodes + "1 0\n3 1 2 3\n0\n0\n3 1 2 3\n", "line 9: the file goes on after its lists", ".smesh"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.bytes);
        const std::string message = message_of(c.bytes, c.ending);
        EXPECT_NE(message.find(c.expected), std::string::npos) << message;
    }
}

TEST(SurfaceReader, ReadsNumbersBeyondTheDoublesAsTheNearest) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<std::pair<std::string, double>> numbers = {{"1e-400", 0},
                                                                 {"-1e-400", 0},
                                                                 {"123456e-500", 0},
                                                                 {"1e-99999999999999999999", 0},
                                                                 {"inf", infinity},
                                                                 {"1e999", infinity},
                                                                 {"1e+99999999999999999999", infinity},
                                                                 {"-1e999", -infinity},
                                                                 {"4.9e-324", 5e-324},
                                                                 {"0.00001e310", 1e305},
                                                                 {"-Infinity", -infinity},
                                                                 {"1000000000e301", infinity}};
    for (const auto& [word, value] : numbers) {
        SCOPED_TRACE(word);
        EXPECT_EQ(read_bytes("v 0 0 " + word + "\nf 1 1 1\n").vertices[0], Vec3(0, 0, value));
    }
    EXPECT_TRUE(read_bytes("v 0 0 nan\nf 1 1 1\n").vertices[0].hasNaN());
}

TEST(SurfaceReader, RefusesWhatCannotBeOpened) {
    for (const std::string& path : {std::string("/no/such/file.stl"), std::string("-"), std::string("/")}) {
        SCOPED_TRACE(path);
        try {
            read_surface(path);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::io);
            EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
        }
    }
}

TEST(StlReader, AcceptsOddSpacingCapitalsAndKeywordsInNames) {
    const Soup soup = read_bytes(
        "\r\n  SOLID  endsolid facet vertex 1 \r\n\tFacet\tNORMAL nan -1.#IND 0\r\nOuter Loop Vertex +0 0 0\r\n\r\n"
        "vertex 1e0 0 0 VERTEX 0 .1E+1 -0 EndLoop\r\nENDFACET endsolid facet\r\n\r\n");
    EXPECT_EQ(soup.vertices, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
    EXPECT_EQ(soup.patch_names, std::vector<std::string>{"endsolid facet vertex 1"});
}

TEST(StlReader, PassesOverPadding) {
    const std::string text = to_ascii_stl(box()), binary = to_binary_stl(box());
    for (const std::string& padding : {std::string("\x1a"), std::string("\0\0\0", 3), std::string("\r\n \x1a\0", 5)})
        expect_same(read_bytes(text + padding), read_bytes(text));
    for (const std::size_t size : {1u, 2u, 49u}) {
        const Soup padded = read_bytes(binary + std::string(size, '\1'));
        expect_same(padded, read_bytes(binary));
        const std::string bytes = size == 1 ? "1 byte behind the last facet was" : " bytes behind the last facet were";
        ASSERT_EQ(padded.notes.size(), 1u);
        EXPECT_NE(padded.notes[0].find(bytes + " ignored."), std::string::npos) << padded.notes[0];
    }
}

// As Geomagic and RINGMesh write them.
TEST(StlReader, AcceptsEndSolidInTwoWordsAndFacetsWithoutTheirEnd) {
    const std::string text = to_ascii_stl(box());
    const auto replaced = [&](const std::string& word, const std::string& by) {
        std::string other = text;
        for (std::size_t at = other.find(word); at != other.npos; at = other.find(word, at + by.size()))
            other.replace(at, word.size(), by);
        return read_bytes(other);
    };
    const Soup two_words = replaced("endsolid", "End Solid"), without_end = replaced("endfacet", "");
    expect_same(two_words, read_bytes(text));
    EXPECT_TRUE(two_words.notes.empty());
    expect_same(without_end, read_bytes(text));
    ASSERT_EQ(without_end.notes.size(), 1u);
    EXPECT_NE(without_end.notes[0].find("12 facets end without \"endfacet\""), std::string::npos);
}

TEST(StlReader, MakesPatchesOfSolids) {
    const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
    const Soup soup = read_bytes("solid a\n" + facet + "endsolid\nsolid\nendsolid\nsolid\n" + facet +
                                 "endsolid\nsolid \"a\"\n" + facet + "endsolid a\n");
    EXPECT_EQ(soup.patch, (std::vector<std::int32_t>{0, 1, 0}));
    EXPECT_EQ(soup.patch_names, (std::vector<std::string>{"a", "solid_3"}));
}

TEST(ObjReader, ReadsSlashesNegativeIndicesAndPolygons) {
    const Soup soup = read_bytes(
        "# square\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 # right\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
        "f 1/1/1 2//1 3/1 -1\nf -4 -3 -2");
    EXPECT_EQ(soup.vertices.size(), 4u);
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
}

// As ZBrush writes it.
TEST(SurfaceReader, PassesOverPaddingOfTexts) {
    const std::string padding("\n\0\x1a\0", 4);
    const Soup soup = torus(3, 1, 7, 5);
    for (const std::string& text : {to_obj(soup), to_off(soup)}) expect_same(read_bytes(text + padding), soup);
}

TEST(ObjReader, TakesGroupsBeforeObjectsBeforeMaterials) {
    const auto patches = [](const std::string& first, const std::string& second) {
        return read_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + first + "f 1 2 3\n" + second + "f 3 2 1\n").patch_names;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(patches("o a\ng b c\nusemtl d\n", "o e\nusemtl f\n"), (Names{"b c"}));
    EXPECT_EQ(patches("o a\nusemtl d\n", "o e\nusemtl f\n"), (Names{"a", "e"}));
    EXPECT_EQ(patches("usemtl d\n", "usemtl f\n"), (Names{"d", "f"}));
    EXPECT_EQ(patches("", "g\n"), (Names{"surface", "default"}));
    EXPECT_EQ(patches("", ""), (Names{"surface"}));
}

TEST(OffReader, AcceptsCommentsCountsOnSeveralLinesAndColours) {
    const Soup soup = read_bytes(
        "# a comment\nCOFF # another\n4\n1 # facets\n0\n\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n"
        "1 1 0 255 0 0 255 # third\n0 1 0 255 0 0 255\n4 0 1 2 3 0.1 0.2 0.3\n");
    EXPECT_EQ(soup.vertices.size(), 4u);
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(read_bytes("OFF 3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n").facets.size(), 1u);
}

TEST(GmshReader, NamesPatchesOfGroupsElseOfSurfaces) {
    const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\n$MeshFormat\n$EndComments\n";
    const std::string nodes = "$Nodes\n4\n9 0 0 0\n-2 1 0 0\n70000 0 1 0\n1 1 1 0\n$EndNodes\n";
    const std::string names = "$PhysicalNames\n2\n1 5 \"a curve\"\n2 6 \"in let\"\n$EndPhysicalNames\n";
    const std::string elements =
        "$Elements\n6\n1 2 2 6 1 9 -2 70000\n2 2 3 5 1 0 9 70000 -2\n3 2 2 6 1 9 70000 -2\n"
        "4 2 0 9 -2 70000\n5 2 1 0 9 -2 70000\n6 3 2 0 8 9 -2 1 70000\n$EndElements\n";
    const Soup soup = read_bytes(head + names + nodes + elements);
    // Neper writes the names last.
    EXPECT_EQ(read_bytes(head + nodes + elements + names).patch_names, soup.patch_names);
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}, {0, 1, 2}, {0, 1, 2}, {0, 1, 3}, {0, 3, 2}}));
    EXPECT_EQ(soup.patch, (std::vector<std::int32_t>{0, 1, 2, 2, 3, 3}));
    EXPECT_EQ(soup.patch_names, (std::vector<std::string>{"in let", "physical_5", "surface_0", "surface_8"}));
    EXPECT_EQ(soup.polygon, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 4}));
    EXPECT_TRUE(soup.notes.empty());
}

// The unit cube in six tetrahedra around a diagonal, every other one turned.
std::vector<Tetrahedron> tets_of_cube() {
    return {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 6, 2, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
}
Soup corners_of_cube() {
    Soup soup;
    for (int i = 0; i < 8; ++i) soup.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    return soup;
}

double enclosed_volume(const Soup& soup) {
    double six_volumes = 0;
    for (const auto& [a, b, c] : soup.facets)
        six_volumes += soup.vertices[a].cross(soup.vertices[b]).dot(soup.vertices[c]);
    return six_volumes / 6;
}

TEST(SurfaceReader, TakesTheSkinOfTetrahedraWithoutTriangles) {
    std::vector<Triangle> first;
    for (const SurfaceFile& file : to_all_mesh_formats(corners_of_cube(), tets_of_cube())) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_bytes(file.bytes);
        EXPECT_TRUE(soup.sides.empty());
        EXPECT_EQ(soup.facets.size(), 12u);
        EXPECT_EQ(enclosed_volume(soup), 1) << "outward";
        if (first.empty()) first = soup.facets;
        EXPECT_EQ(soup.facets, first);
        EXPECT_EQ(soup.patch_names, std::vector<std::string>{"surface"});
        const std::string note = "There are no triangles: the surface is the skin of the 6 tetrahedra.";
        EXPECT_EQ(std::count(soup.notes.begin(), soup.notes.end(), note), 1);
    }
}

// The places of unit cubes in a cube of size^3 that is hollow but for its outer layer.
std::vector<std::array<int, 3>> cubes_of_cavity(int size) {
    std::vector<std::array<int, 3>> cubes;
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int z = 0; z < size; ++z)
                if (std::max({x, y, z}) == size - 1 || std::min({x, y, z}) == 0) cubes.push_back({x, y, z});
    return cubes;
}

// A cube of size^3 unit cubes but for those within, six tetrahedra each, every second of them turned.
struct HollowCube {
    Soup boundary;
    std::vector<Tetrahedron> tets;
};

HollowCube hollow_cube(int size) {
    HollowCube hollow;
    std::map<std::array<int, 3>, std::int32_t> numbers;
    for (const auto& [x, y, z] : cubes_of_cavity(size))
        for (Tetrahedron tet : tets_of_cube()) {
            for (std::int32_t& corner : tet) {
                const Vec3 at = corners_of_cube().vertices[corner] + Vec3(x, y, z);
                const std::array<int, 3> place = {static_cast<int>(at.x()), static_cast<int>(at.y()),
                                                  static_cast<int>(at.z())};
                const auto [vertex, is_new] =
                    numbers.try_emplace(place, static_cast<std::int32_t>(hollow.boundary.vertices.size()));
                if (is_new) hollow.boundary.vertices.push_back(at);
                corner = vertex->second;
            }
            if (hollow.tets.size() % 2 == 1) std::swap(tet[0], tet[1]);
            hollow.tets.push_back(tet);
        }
    for (const RegionFace& face : region_faces(hollow.boundary.vertices, hollow.tets).faces)
        hollow.boundary.facets.push_back(face.corners);
    hollow.boundary.patch.assign(hollow.boundary.facets.size(), 0);
    hollow.boundary.patch_names = {"all"};
    return hollow;
}

TEST(SurfaceReader, KnowsByTetrahedraOfOneVolumeWhatIsInsideOfItsTriangles) {
    for (const int size : {3, 4, 5}) {
        const HollowCube hollow = hollow_cube(size);
        Soup written = hollow.boundary;
        for (std::size_t f = 0; f < written.facets.size(); f += 3)
            std::swap(written.facets[f][1], written.facets[f][2]);  // no normal tells where a void is
        for (const SurfaceFile& file : to_all_mesh_formats(written, hollow.tets)) {
            SCOPED_TRACE(file.name);
            const Soup soup = read_bytes(file.bytes);
            EXPECT_TRUE(soup.sides.empty());
            EXPECT_EQ(soup.facets.size(), written.facets.size());
            EXPECT_EQ(enclosed_volume(soup), size * size * size - (size - 2) * (size - 2) * (size - 2));
            EXPECT_EQ(soup.patch_names.size(), 1u);
            EXPECT_NE(soup.patch_names.front(), file.name.ends_with(".vtu") ? "" : "surface") << "that of the file";
            const std::string notes = fmt::format("{}", fmt::join(soup.notes, " "));
            EXPECT_EQ(notes.find("tetrahedra were"), std::string::npos) << notes;
        }
    }
}

TEST(SurfaceReader, AddsFacesOfOneVolumeThatNoTriangleIs) {
    HollowCube hollow = hollow_cube(3);
    const std::size_t all = hollow.boundary.facets.size();
    hollow.boundary.facets.resize(all / 2);
    const auto last = static_cast<std::int32_t>(hollow.boundary.vertices.size()) - 1;
    hollow.boundary.facets.push_back({0, last / 2, last});  // across all of it, and no face
    hollow.boundary.patch.resize(all / 2 + 1);
    for (const SurfaceFile& file : to_all_mesh_formats(hollow.boundary, hollow.tets)) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_bytes(file.bytes);
        EXPECT_EQ(soup.facets.size(), all);
        EXPECT_EQ(enclosed_volume(soup), 26);
        EXPECT_EQ(soup.patch_names.back(), "surface");
        EXPECT_EQ(std::count(soup.notes.begin(), soup.notes.end(), "1 triangle at which no region ends was ignored."),
                  1);
    }
}

TEST(MeditReader, TakesTrianglesWithReferencesAndPassesOverTheRest) {
    const Soup soup = read_bytes(
        "# a comment\nMeshVersionFormatted\n2\n\nDimension\n3\nNormals 1\nnan -1e-3 0\nVertices\n4\n0 0 0 1\n1 0 0 1\n"
        "1 1 0 1\n0 1 0 1\nRequiredVertices 1 1\nTriangles\n2 # with references\n1 2 3 -7\n1 3 4 2\nRequiredTriangles "
        "1\n"
        "1\nEdges 1 1 2 0\nTetrahedra 2\n1 2 3 4 0\n1 2 3 4 0\nPyramids 1 1 2 3 4 1 0\nQuadrilaterals 1 1 2 3 4 "
        "-7\nEnd\nTriangles 1 1 2 3 0");
    EXPECT_EQ(soup.vertices.size(), 4u);
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(soup.polygon, (std::vector<std::int32_t>{0, 1, 2, 2}));
    EXPECT_EQ(soup.patch, (std::vector<std::int32_t>{0, 1, 0, 0}));
    EXPECT_EQ(soup.patch_names, (std::vector<std::string>{"reference_-7", "reference_2"}));
    EXPECT_EQ(soup.notes, (std::vector<std::string>{"1 pyramid was ignored.", "2 tetrahedra were ignored."}));
}

TEST(SurfaceReader, NamesFormatsThatItDoesNotRead) {
    const std::string hdf5("\x89HDF\r\n\x1a\n\0\0\0\0\0\0\0\0", 16);
    const std::vector<std::array<std::string, 3>> cases = {
        {hdf5, ".h5", "this is an HDF5 file"},
        {hdf5, ".med", "this is a MED file"},
        {"$ a comment\nSOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\n", ".bdf", "input of NASTRAN"},
        {"GRID           1              0.      0.      0.\n", ".nas", "input of NASTRAN"},
        {"*HEADING\n*NODE\n1, 0, 0, 0\n", ".inp", "input of Abaqus"}};
    for (const auto& [bytes, ending, sentence] : cases) {
        const std::string message = message_of(bytes, ending);
        EXPECT_NE(message.find(sentence), std::string::npos) << message;
        EXPECT_NE(message.find("Convert it to"), std::string::npos) << message;
    }
    EXPECT_EQ(read_bytes("$Comments\nGRID\n$EndComments\n" + to_msh(box(), {})).facets.size(), 12u);
}

TEST(SurfaceReader, NamesFilesThatAreNoSurfaces) {
    const std::string zeros(400, '\0'), header = "\x5c\x01" + std::string(342, '\0');
    for (const auto& [bytes, name] : std::vector<std::array<std::string, 2>>{
             {"NRRD0004\ntype: short\n\n" + zeros, "NRRD"},
             {header + "n+1" + zeros, "NIfTI"},
             {header + "ni1" + zeros, "NIfTI"},
             {"ObjectType = Image\nNDims = 3\nElementDataFile = a.raw\n", "MetaImage"},
             {std::string(128, '\0') + "DICM" + zeros, "DICOM"},
             {"<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\">\n</VTKFile>\n", "an image of VTK"}}) {
        const std::string message = message_of(bytes), archived = message_of(gzip(bytes));
        for (const std::string& each : {message, archived}) {
            EXPECT_NE(each.find(name), std::string::npos) << each;
            EXPECT_NE(each.find("Make a surface of it first"), std::string::npos) << each;
        }
    }
    const std::string tess = message_of("***tess\n **format\n   3.4\n", ".tess");
    EXPECT_NE(tess.find("tessellation of Neper"), std::string::npos) << tess;
    for (const char* text : {"some geometry\n1 2 3\n", "8 12\n0 0 0\n1 0 0\n"})
        EXPECT_NE(message_of(text, ".tri").find("not recognised"), std::string::npos);
}

TEST(SurfaceReader, NotesPolygonsThatNoFanCovers) {
    const std::string triangle = "f 1 2 3\n";
    const std::vector<std::string> unfit = {
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.001\n",  // not planar
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 1 0\n",      // crosses itself
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n",      // no area
    };
    for (const std::string& vertices : unfit) {
        SCOPED_TRACE(vertices);
        const Soup soup = read_bytes(vertices + triangle + "f 1 2 3 4\n" + triangle + "f 4 3 2 1\n");
        EXPECT_EQ(soup.unfit_polygons, (std::vector<std::int32_t>{1, 3}));
        EXPECT_EQ(soup.polygon, (std::vector<std::int32_t>{0, 1, 1, 2, 3, 3}));
    }
    EXPECT_TRUE(read_bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").unfit_polygons.empty());
    const std::string repeated =
        "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
        "Quadrilaterals 1\n1 2 3 3 0\n";
    EXPECT_EQ(read_bytes(repeated).unfit_polygons, std::vector<std::int32_t>{0});
}

TEST(TetgenReader, AcceptsPolygonsCommentsAndMissingLists) {
    const std::string nodes = "# box\n4\n0 0 0 0 # origin\n1 1 0 0 0.5 0.5 9\n\n2 1 1 0\n3 0 1 0\n";
    const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(read_bytes(nodes + "1\n4 0 1\n2 3", ".smesh").facets, fan);
    EXPECT_EQ(read_bytes(nodes + "1\n1\n4 0 1 2 3\n0\n", ".poly").facets, fan);
    EXPECT_EQ(read_bytes(nodes + "1 1\n4 0 1 2 3 5", ".smesh").patch_names, std::vector<std::string>{"marker_5"});
    EXPECT_EQ(read_bytes(nodes + "1 0\n4 0 1 2 3 5", ".smesh").patch_names, std::vector<std::string>{"surface"});
}

TEST(TetgenReader, KeepsHolesAndRegions) {
    for (const bool is_poly : {false, true}) {
        const Soup soup = read_bytes(to_tetgen(box(), 1, is_poly), ".smesh");
        EXPECT_EQ(soup.holes, (std::vector<Vec3>{Vec3(0.5, 0.5, 0.5)}));
        EXPECT_EQ(soup.seeds.size(), 1u);
        EXPECT_TRUE(soup.notes.empty());
    }
}

TEST(TetgenReader, NamesRegionsByTheirAttributes) {
    const std::string nodes = "4 3\n1 0 0 0\n2 3 0 0\n3 0 3 0\n4 0 0 1\n",
                      smesh = "4 0\n3 1 3 2\n3 1 2 4\n3 2 3 4\n3 3 1 4\n",
                      poly = "4 0\n1\n3 1 3 2\n1\n3 1 2 4\n1\n3 2 3 4\n1\n3 3 1 4\n",
                      lists = "1\n1 9 9 9\n4\n1 0.1 0.2 0.3 10 0.25\n2 0 0 1 -2.0 -1 # none\n3 1 0 0 0.5\n4 1 1 1\n";
    for (const bool is_poly : {false, true}) {
        const Soup soup = read_bytes(nodes + (is_poly ? poly : smesh) + lists, is_poly ? ".poly" : ".smesh");
        EXPECT_EQ(soup.holes.size(), 1u);
        ASSERT_EQ(soup.seeds.size(), 4u);
        const std::vector<std::string> names = {"region_10", "region_-2", "region_0.5", "region_4"};
        for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(soup.seeds[i].name, names[i]);
        EXPECT_EQ(soup.seeds[0].point, Vec3(0.1, 0.2, 0.3));
        EXPECT_EQ(soup.seeds[0].largest_cell, 0.25);
        for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(soup.seeds[i].largest_cell, 0);
        EXPECT_TRUE(soup.notes.empty() && soup.sides.empty());
    }
}

// A block with a square tunnel, whose ends are facets of two polygons and a hole.
std::string tunnel(const std::string& first_end) {
    return "16 3\n1 0 0 0\n2 3 0 0\n3 3 3 0\n4 0 3 0\n5 0 0 2\n6 3 0 2\n7 3 3 2\n8 0 3 2\n"
           "9 1 1 0\n10 2 1 0\n11 2 2 0\n12 1 2 0\n13 1 1 2\n14 2 1 2\n15 2 2 2\n16 1 2 2\n10 1\n" +
           first_end +
           "2 1 7\n4 5 6 7 8\n4 13 14 15 16\n1 1.5 1.5 2\n1\n4 1 2 6 5\n1\n4 2 3 7 6\n1\n4 3 4 8 7\n1\n4 4 1 5 8\n"
           "1\n4 9 10 14 13\n1\n4 10 11 15 14\n1\n4 11 12 16 15\n1\n4 12 9 13 16\n0\n";
}

TEST(TetgenReader, TriangulatesFacetsOfSeveralPolygonsWithHoles) {
    const Soup soup = read_bytes(tunnel("2 1 7 # with a comment\n4 1 2 3 4\n4 9 10 11 12\n1 1.5 1.5 0\n"), ".poly");
    EXPECT_EQ(soup.vertices.size(), 16u) << "no new ones";
    EXPECT_EQ(soup.facets.size(), 32u);
    EXPECT_TRUE(soup.unfit_polygons.empty());
    EXPECT_EQ(soup.polygon.front(), 0);
    EXPECT_EQ(soup.polygon.back(), 9);
    EXPECT_EQ(std::count(soup.polygon.begin(), soup.polygon.end(), 1), 8);
    EXPECT_EQ(soup.patch_names[0], "marker_7");
    std::map<UndirectedEdge, int> facets_at;
    for (const Triangle& t : soup.facets)
        for (std::size_t i = 0; i < 3; ++i) ++facets_at[undirected(t[i], t[(i + 1) % 3])];
    for (const auto& [edge, count] : facets_at) EXPECT_EQ(count, 2) << edge[0] << " " << edge[1];
}

TEST(TetgenReader, SaysWhichFacetIsNotPlanarOrCrossesItself) {
    const std::string bent = message_of(tunnel("2\n4 1 2 3 4\n4 9 10 11 16\n"), ".poly");
    EXPECT_NE(bent.find(".poly, line 21: facet 0 (counted from 0) is not planar: its corners (0, 0, 0) and (1, 2, 2)"),
              std::string::npos)
        << bent;
    const std::string crossing = message_of(tunnel("2\n4 1 2 3 4\n4 9 11 10 12\n"), ".poly");
    EXPECT_NE(crossing.find("facet 0 (counted from 0) has edges that cross near (1.5, 1.5, 0)"), std::string::npos)
        << crossing;
}

TEST(TetgenReader, TakesEdgesAndPointsOfFacetsAndNotesTheOthers) {
    const std::string nodes = "7 3\n1 0 0 0\n2 4 0 0\n3 4 4 0\n4 0 4 0\n5 1 1 0\n6 2 1 0\n7 9 9 0\n";
    const Soup soup = read_bytes(nodes + "3\n4\n4 1 2 3 4\n2 5 6\n1 6\n1 7\n1\n2 1 3\n1\n3 1 2 3\n", ".poly");
    EXPECT_EQ(soup.facets.size(), 7u);
    EXPECT_EQ(soup.polygon.back(), 2) << "a facet without area has its number";
    EXPECT_EQ(soup.notes, (std::vector<std::string>{"1 facet of edges or points alone was ignored.",
                                                    "1 edge or point outside of its facet was ignored."}));
}

TEST(TetgenReader, TriangulatesPolygonsThatNoFanCovers) {
    const std::string nodes = "8 3\n1 0 0 0\n2 3 0 0\n3 3 2 0\n4 2 2 0\n5 2 1 0\n6 1 1 0\n7 1 2 0\n8 0 2 0\n";
    for (const bool is_poly : {false, true}) {
        const Soup soup =
            read_bytes(nodes + (is_poly ? "1\n1\n" : "1\n") + "8 1 2 3 4 5 6 7 8\n", is_poly ? ".poly" : ".smesh");
        EXPECT_TRUE(soup.unfit_polygons.empty());
        EXPECT_EQ(soup.facets.size(), 6u);
    }
    const std::string crossed = nodes + "1\n1\n4 1 3 2 8\n";
    EXPECT_EQ(read_bytes(crossed, ".poly").unfit_polygons.size(), 1u) << "kerf check tells them all";
}

TEST(TetgenReader, TakesTheNodesBesideAFileThatHasNone) {
    const Soup soup = box();
    const TemporaryFile nodes(to_node_list(soup, 1), ".node");
    expect_same(read_bytes("0 3 0 0\n" + to_facet_list(soup, 1, false), ".smesh"), soup);
    expect_same(read_bytes("0\n" + to_facet_list(soup, 1, true), ".poly"), soup);
    const TemporaryFile damaged("1 3\n1 0 0 x\n", ".node");
    const std::string message = message_of("0\n" + to_facet_list(soup, 1, true), ".poly");
    EXPECT_NE(message.find(".node, line 2: a number is expected"), std::string::npos) << message;
}

TEST(TetgenReader, NamesAMissingNodeFile) {
    const TemporaryFile file("0 3\n1 0\n3 1 2 3\n", ".smesh");
    try {
        read_surface(file.path());
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io);
        EXPECT_NE(std::string(error.what()).find(".node"), std::string::npos) << error.what();
    }
}

TEST(PlyReader, ReadsStripsOfTriangles) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";
    const Soup soup = read_bytes(head + "13 0 1 2 3 -1 2 3 4 5 -1 -1 0 1\n");
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}));
    const Soup joined = read_bytes(head + "10 0 1 2 3 3 2 2 3 4 5\n");
    EXPECT_EQ(joined.facets, soup.facets) << "corners that are repeated lead from one strip to the next";
    EXPECT_NE(message_of(head + "3 0 1 6\n").find("names vertex number 6"), std::string::npos);
    EXPECT_NE(message_of(head + "3 0 1 -2\n").find("names vertex number -2"), std::string::npos);
}

TEST(PlyReader, PassesOverOtherElementsAndProperties) {
    const Soup soup = read_bytes(
        "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement camera 1\r\nproperty list uchar float view\r\n"
        "element vertex 3\r\nproperty uchar flag\r\nproperty int16 x\r\nproperty float32 y\r\nproperty double z\r\n"
        "element face 1\r\nproperty uint8 flag\r\nproperty list uint8 uint32 vertex_index\r\n"
        "property list uchar float texcoord\r\nend_header\r\n2 0.5 0.5\r\n9 0 0 0\r\n9 1 0 0\r\n9 0 1 0\r\n"
        "7 3 0 1 2 2 0.1 0.2\r\n");
    EXPECT_EQ(soup.vertices, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
    EXPECT_EQ(soup.facets, (std::vector<Triangle>{{0, 1, 2}}));
}

}  // namespace
}  // namespace kerf
