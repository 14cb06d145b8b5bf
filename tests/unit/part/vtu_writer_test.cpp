#include "files/part/vtu_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/core/error.h"
#include "files/io/file_bytes.h"
#include "files/part/vtu_reader.h"
#include "fill/mesh/quality.h"
#include "support/io_error.h"
#include "support/random_part.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class VtuWriter : public testing::Test {
 protected:
    std::string path(const std::string& name) const { return folder_.file(name); }

 private:
    test::TemporaryFolder folder_;
};

const VtuLayout all_fields{~CellFieldSet(), 4};

void expect_surface(const Part& file, const Part& part) {
    EXPECT_EQ(file.facets, part.facets);
    EXPECT_EQ(file.patch, part.patch);
    EXPECT_EQ(file.facet, part.facet);
    EXPECT_EQ(file.neighbour, part.neighbour);
    EXPECT_EQ(file.id, part.id);
    EXPECT_EQ(file.patch_names, part.patch_names);
    EXPECT_EQ(file.mesh.boundary_vertex_count, part.mesh.boundary_vertex_count);
}

template <class T>
std::vector<T> array_values(const std::string& file, const std::string& bytes, const std::string& name) {
    const VtuHeader header = parse_vtu_header(bytes, file);
    const VtuHeader::Array* array = header.find(name);
    if (!array) return {};
    std::vector<T> values(array->tuples * array->components);
    std::memcpy(values.data(), bytes.data() + array->position + 8, values.size() * sizeof(T));
    return values;
}

TEST_F(VtuWriter, PartsComeBackAsTheyWere) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Part part = test::random_part(seed);
        VtuLayout layout{CellFieldSet(seed), 1 << seed % 3};
        if (layout.tag_bytes == 1) part.id = NodeId(part.id.value() % 128);
        write_part(path("part.vtu"), part, layout);
        const Part file = read_part(path("part.vtu"));
        expect_surface(file, part);
        EXPECT_EQ(file.mesh.vertices, part.mesh.vertices);
        EXPECT_EQ(file.mesh.tets, part.mesh.tets);
        EXPECT_EQ(file.global_id, part.global_id);
        const VtuLayout read = read_layout(path("part.vtu"));
        EXPECT_EQ(read.fields, layout.fields);
        EXPECT_EQ(read.tag_bytes, layout.tag_bytes);
        for (std::size_t field = 0; field < cell_fields.size(); ++field)
            EXPECT_EQ(has_cell_values(path("part.vtu"), cell_fields[field].array), layout.fields[field]);
    }
}

// The shortest that have room for the numbers of all parts and patches, and four bytes where there may be others.
TEST_F(VtuWriter, TagsAreAsShortAsTheMeshAllows) {
    for (const auto& [largest, bytes] :
         std::vector<std::pair<std::int32_t, int>>{{1, 1}, {127, 1}, {128, 2}, {32767, 2}, {32768, 4}, {1 << 30, 4}}) {
        SCOPED_TRACE(largest);
        MeshOutline outline;
        for (const std::int32_t id : {1, largest, largest / 2}) outline.parts.push_back({.id = NodeId(id)});
        EXPECT_EQ(layout_for(outline, {}).tag_bytes, bytes);
        outline.is_whole = false;
        EXPECT_EQ(layout_for(outline, {}).tag_bytes, 4);
    }
    MeshOutline of_patches;
    of_patches.patch_names.resize(200);
    EXPECT_EQ(layout_for(of_patches, {}).tag_bytes, 2);
}

TEST_F(VtuWriter, FieldsAreChosenByName) {
    EXPECT_EQ(parse_cell_fields(""), parse_cell_fields("min-dihedral"));
    EXPECT_EQ(parse_cell_fields("all").count(), cell_fields.size());
    EXPECT_TRUE(parse_cell_fields("none").none());
    CellFieldSet fields;
    std::string list;
    for (std::size_t field = cell_fields.size(); field-- > 0;) {
        list += (list.empty() ? "" : ",") + std::string(cell_fields[field].name);
        fields.set(field);
        EXPECT_EQ(parse_cell_fields(list), fields) << list;
    }
    for (const char* wrong : {"volume", "all,shape", "shape,", ",", "shape,,aspect", "Shape"})
        EXPECT_THROW(parse_cell_fields(wrong), Error) << wrong;
}

// What the default says of a cell takes no more room than it must.
TEST_F(VtuWriter, ATetrahedronTakesThirtyBytesAndFourAField) {
    Part part = test::random_part(3);
    part.id = NodeId(9);
    const auto size = [&](std::string_view fields) {
        write_part(path("part.vtu"), part, {parse_cell_fields(fields), 1});
        return static_cast<std::int64_t>(fs::file_size(path("part.vtu")));
    };
    std::vector<std::int64_t> sizes;
    for (const char* fields : {"none", "", "all"}) {
        part.mesh.tets.resize(100'000, {0, 1, 2, 3});
        const std::int64_t fewer = size(fields);
        part.mesh.tets.resize(200'000, {0, 1, 2, 3});
        sizes.push_back((size(fields) - fewer) / 100'000);
    }
    EXPECT_EQ(sizes, (std::vector<std::int64_t>{24, 28, 44}));  // and 32 a vertex
}

TEST_F(VtuWriter, SurfacesComeBackAsTheyWere) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Part part = test::random_part(seed);
        write_part_surface(path("part.surface.vtu"), part);
        const Part file = read_part(path("part.surface.vtu"));
        expect_surface(file, part);
        EXPECT_EQ(file.mesh.vertices, boundary_of(part).mesh.vertices);
        EXPECT_TRUE(file.mesh.tets.empty());
        EXPECT_EQ(file.global_id, boundary_of(part).global_id);
    }
}

TEST_F(VtuWriter, SomeValuesOfACellArrayAreThoseOfTheWhole) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Part part = test::random_part(seed);
        const std::string file = path("part.vtu");
        write_part(file, part, all_fields);
        const PartCellCounts counts = read_cell_counts(file);
        EXPECT_EQ(counts.tets, static_cast<std::int64_t>(part.mesh.tets.size()));
        EXPECT_EQ(counts.facets, static_cast<std::int64_t>(part.facets.size()));
        const std::int64_t cells = counts.tets + counts.facets;
        for (const char* array : {"MinDihedralAngle", "RadiusEdgeRatio", "AspectRatio", "Shape"}) {
            const std::vector<float> all = array_values<float>(file, read_file(file), array);
            ASSERT_EQ(static_cast<std::int64_t>(all.size()), cells);
            for (const auto& [first, count] : {std::pair{std::int64_t{0}, cells},
                                               {counts.tets, counts.facets},
                                               {cells / 3, cells / 2},
                                               {cells, std::int64_t{0}}}) {
                const std::vector<float> some = read_cell_values(file, array, first, count);
                ASSERT_EQ(static_cast<std::int64_t>(some.size()), count);
                EXPECT_TRUE(count == 0 || std::memcmp(some.data(), all.data() + first, count * sizeof(float)) == 0);
            }
        }
        for (const auto& [first, count] : {std::pair{std::int64_t{-1}, std::int64_t{1}},
                                           {cells, std::int64_t{1}},
                                           {std::int64_t{0}, cells + 1},
                                           {std::int64_t{1}, std::int64_t{-1}},
                                           {std::int64_t{1} << 60, std::int64_t{1} << 60}})
            EXPECT_NE(test::io_error([&, begin = first, n = count] { read_cell_values(file, "Shape", begin, n); }), "");
        for (const char* array : {"Part", "GlobalVertexId", "Points", "Nothing"})
            EXPECT_NE(test::io_error([&] { read_cell_values(file, array, 0, 1); }), "") << array;
        fs::resize_file(file, array_values<char>(file, read_file(file), "Part").size());
        EXPECT_NE(test::io_error([&] { read_cell_values(file, "Shape", counts.tets, counts.facets); }), "");
    }
    EXPECT_NE(test::io_error([&] { read_cell_counts(path("missing.vtu")); }), "");
}

TEST_F(VtuWriter, HashesAreThoseOfTheFiles) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Part part = test::random_part(seed);
        const std::string file = path("part.vtu");
        const VtuLayout layout{CellFieldSet(seed), seed % 2 ? 2 : 4};
        const FileHash of_part = write_part(file, part, layout);
        EXPECT_EQ(of_part, digest_of(read_file(file)));
        EXPECT_EQ(of_part, hash_of_part(part, layout));
        const FileHash of_surface = write_part_surface(file, part);
        EXPECT_EQ(of_surface, digest_of(read_file(file)));
        EXPECT_EQ(of_surface, hash_of_part_surface(part));
    }
}

TEST_F(VtuWriter, SameInputGivesTheSameBytes) {
    const Part part = test::random_part(5);
    write_part(path("a.vtu"), part);
    write_part(path("b.vtu"), part);
    EXPECT_EQ(read_file(path("a.vtu")), read_file(path("b.vtu")));
}

TEST_F(VtuWriter, QualityIsThatOfTheTetrahedronAndOfTheOneBehindAFacet) {
    const Part part = test::random_part(9);
    write_part(path("part.vtu"), part, all_fields);
    const std::string bytes = read_file(path("part.vtu"));
    const auto expect = [&](const char* name, double TetQuality::*measure) {
        SCOPED_TRACE(name);
        const auto values = array_values<float>(path("part.vtu"), bytes, name);
        ASSERT_EQ(values.size(), part.mesh.tets.size() + part.tet_at_facet.size());
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
            const auto& p = part.mesh.vertices;
            const auto& [a, b, c, d] = part.mesh.tets[t];
            EXPECT_EQ(values[t], static_cast<float>(tet_quality(p[a], p[b], p[c], p[d]).*measure));
        }
        for (std::size_t f = 0; f < part.tet_at_facet.size(); ++f) {
            const float value = values[part.mesh.tets.size() + f];
            if (part.tet_at_facet[f] < 0)
                EXPECT_TRUE(std::isnan(value));
            else
                EXPECT_EQ(value, values[part.tet_at_facet[f]]);
        }
    };
    EXPECT_NE(std::count(part.tet_at_facet.begin(), part.tet_at_facet.end(), -1), part.tet_at_facet.size());
    expect("MinDihedralAngle", &TetQuality::min_dihedral_deg);
    expect("MaxDihedralAngle", &TetQuality::max_dihedral_deg);
    expect("RadiusEdgeRatio", &TetQuality::radius_edge);
    expect("AspectRatio", &TetQuality::aspect);
    expect("Shape", &TetQuality::shape);
}

TEST_F(VtuWriter, LargeArraysAreWrittenInSeveralChunks) {
    Part part = test::random_part(3);
    const Tetrahedron tet = part.mesh.tets.front();
    part.mesh.tets.assign(300'001, tet);
    part.mesh.vertices.resize(200'003, Vec3(1, 2, 3));
    part.global_id.resize(part.mesh.vertices.size(), 7);
    write_part(path("part.vtu"), part);
    const Part file = read_part(path("part.vtu"));
    EXPECT_EQ(file.mesh.tets, part.mesh.tets);
    EXPECT_EQ(file.mesh.vertices, part.mesh.vertices);
    EXPECT_EQ(file.global_id, part.global_id);
    expect_surface(file, part);
}

TEST_F(VtuWriter, PvtuNamesItsPiecesAndTheArraysOfThePieces) {
    const Part part = test::random_part(4);
    const VtuLayout layout{~CellFieldSet(), 2};
    write_part(path("part.vtu"), part, layout);
    write_pvtu(path("mesh.pvtu"), {"parts/part_0002.vtu", "parts/a&\"<.vtu"}, layout);
    const std::string pvtu = read_file(path("mesh.pvtu"));
    EXPECT_NE(pvtu.find("<Piece Source=\"parts/part_0002.vtu\"/>"), pvtu.npos);
    EXPECT_NE(pvtu.find("<Piece Source=\"parts/a&amp;&quot;&lt;.vtu\"/>"), pvtu.npos);
    const VtuHeader header = parse_vtu_header(read_file(path("part.vtu")), "part.vtu");
    int shared = 0;
    for (const VtuHeader::Array& array : header.arrays)
        shared += pvtu.find("type=\"" + array.type + "\" Name=\"" + array.name + "\"") != pvtu.npos;
    EXPECT_EQ(shared, 10);  // GlobalVertexId, 3 tags, 5 measures, Points
}

TEST_F(VtuWriter, AFullDiskIsAnErrorThatNamesTheFile) {
    const Part part = test::random_part(1);
    for (const std::string& message : {test::io_error([&] { write_part("/dev/full", part); }),
                                       test::io_error([&] { write_part_surface("/dev/full", part); }),
                                       test::io_error([&] { write_pvtu("/dev/full", {"parts/part_0001.vtu"}); })}) {
        EXPECT_NE(message.find("/dev/full"), message.npos) << message;
        EXPECT_NE(message.find("No space left on device"), message.npos) << message;
    }
}

TEST_F(VtuWriter, AMissingFolderIsAnErrorThatNamesTheFile) {
    const std::string missing = path("missing/part.vtu");
    const std::string message = test::io_error([&] { write_part(missing, test::random_part(1)); });
    EXPECT_NE(message.find(missing), message.npos) << message;
    EXPECT_NE(message.find("No such file"), message.npos) << message;
}

TEST_F(VtuWriter, ArraysOfOtherSizesAreABug) {
    for (int which = 0; which < 5; ++which) {
        SCOPED_TRACE(which);
        Part part = test::random_part(2);
        if (which == 0) part.global_id.pop_back();
        if (which == 1) part.neighbour.pop_back();
        if (which == 2) part.patch.pop_back();
        if (which == 3) part.tet_at_facet.pop_back();
        if (which == 4) part.facet.pop_back();
        EXPECT_THROW(write_part(path("part.vtu"), part), Error);
    }
}

TEST_F(VtuWriter, FilesThatEndTooEarlyAreRefused) {
    write_part(path("part.vtu"), test::random_part(6));
    const std::string bytes = read_file(path("part.vtu"));
    const std::string cut = path("cut.vtu");
    for (std::size_t missing = 1; missing <= bytes.size(); missing += missing < 300 ? 1 : 97) {
        SCOPED_TRACE(missing);
        std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() - missing);
        EXPECT_NE(test::io_error([&] { read_part(cut); }).find(cut), std::string::npos);
    }
}

TEST_F(VtuWriter, TellsFilesThatAreStillBeingWritten) {
    const Part part = test::random_part(9);
    write_part(path("part.vtu"), part);
    write_part_surface(path("surface.vtu"), part);
    for (const char* name : {"part.vtu", "surface.vtu"}) {
        EXPECT_TRUE(is_complete_part_file(path(name)));
        for (const std::uintmax_t size :
             {fs::file_size(path(name)) - 1, fs::file_size(path(name)) / 2, std::uintmax_t{0}}) {
            fs::resize_file(path(name), size);
            EXPECT_FALSE(is_complete_part_file(path(name))) << name << ' ' << size;
        }
    }
    EXPECT_FALSE(is_complete_part_file(path("missing.vtu")));
}

TEST_F(VtuWriter, DamagedFilesAreRefusedOrReadButNeverWorse) {
    write_part(path("part.vtu"), test::random_part(8));
    const std::string bytes = read_file(path("part.vtu"));
    int refused = 0;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 engine(seed);
        std::string damaged = bytes;
        // Half of the damage goes to the header, which is a small part of the file.
        const std::size_t range = seed % 2 ? bytes.find("AppendedData") : bytes.size();
        damaged[engine() % range] = static_cast<char>(engine());
        std::ofstream(path("damaged.vtu"), std::ios::binary) << damaged;
        refused += !test::io_error([&] { read_part(path("damaged.vtu")); }).empty();
    }
    EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace kerf
