#include "part/vtu_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/error.h"
#include "io/file_bytes.h"
#include "mesh/quality.h"
#include "part/vtu_reader.h"
#include "support/io_error.h"
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

// Arrays of the right sizes with random content: the writer has no opinion about geometry.
struct WrittenPart {
    TetMesh mesh;
    SurfaceArrays surface;
    std::vector<std::int32_t> tet_at_facet;
    PartArrays arrays;
};

WrittenPart random_part(unsigned seed) {
    std::mt19937 engine(seed);
    const auto number = [&](std::int32_t below) { return static_cast<std::int32_t>(engine() % below); };
    const auto coordinate = [&] { return std::uniform_real_distribution<double>(-1e3, 1e3)(engine); };
    WrittenPart part;
    const std::int32_t boundary = 4 + number(50), interior = number(40), tets = 1 + number(300),
                       facets = 1 + number(90);
    for (std::int32_t v = 0; v < boundary + interior; ++v)
        part.mesh.vertices.emplace_back(coordinate(), coordinate(), coordinate());
    part.mesh.boundary_vertex_count = boundary;
    part.surface.vertices.assign(part.mesh.vertices.begin(), part.mesh.vertices.begin() + boundary);
    for (std::int32_t t = 0; t < tets; ++t) {
        Tetrahedron& tet = part.mesh.tets.emplace_back();
        for (std::int32_t& corner : tet) corner = number(boundary + interior);
    }
    for (std::int32_t f = 0; f < facets; ++f) {
        part.surface.facets.push_back({number(boundary), number(boundary), number(boundary)});
        part.surface.patch.push_back(number(4) - 1);
        part.surface.facet_key.push_back(make_key(number(3), number(1000)));
        part.arrays.neighbour.push_back(number(20) - 1);
        part.tet_at_facet.push_back(number(tets + 1) - 1);
    }
    for (std::int32_t v = 0; v < boundary; ++v) part.arrays.boundary_id.push_back((std::int64_t{v} << 33) + number(9));
    part.arrays.part = 1 + number(1000);
    part.arrays.patch_names = {"body", "",
                               "l\xc3\xaf"
                               "d <&\">",
                               std::string(seed * 100, 'x')};
    return part;
}

void write(const std::string& path, const WrittenPart& part) {
    write_part(path, part.mesh, part.surface, tet_qualities(part.mesh), part.tet_at_facet, part.arrays);
}

std::vector<std::int64_t> expected_ids(const WrittenPart& part, std::int64_t first_interior) {
    std::vector<std::int64_t> ids = part.arrays.boundary_id;
    for (std::int32_t i = 0; i < part.mesh.interior_vertex_count(); ++i) ids.push_back(first_interior + i);
    return ids;
}

void expect_surface(const Part& file, const WrittenPart& part) {
    EXPECT_EQ(file.facets, part.surface.facets);
    EXPECT_EQ(file.patch, part.surface.patch);
    EXPECT_EQ(file.neighbour, part.arrays.neighbour);
    for (std::size_t f = 0; f < file.facet.size(); ++f) {
        const Key key = part.surface.facet_key[f];
        EXPECT_EQ(file.facet[f], key_node(key) == 0 ? key_index(key) : -1);
    }
    EXPECT_EQ(file.id, part.arrays.part);
    EXPECT_EQ(file.patch_names, part.arrays.patch_names);
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
        const WrittenPart part = random_part(seed);
        write(path("part.vtu"), part);
        const Part file = read_part(path("part.vtu"));
        expect_surface(file, part);
        EXPECT_EQ(file.mesh.vertices, part.mesh.vertices);
        EXPECT_EQ(file.mesh.tets, part.mesh.tets);
        EXPECT_EQ(file.global_id, expected_ids(part, 0));
    }
}

TEST_F(VtuWriter, SurfacesComeBackAsTheyWere) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const WrittenPart part = random_part(seed);
        write_part_surface(path("part.surface.vtu"), part.surface, part.arrays);
        const Part file = read_part(path("part.surface.vtu"));
        expect_surface(file, part);
        EXPECT_EQ(file.mesh.vertices, part.surface.vertices);
        EXPECT_TRUE(file.mesh.tets.empty());
        EXPECT_EQ(file.global_id, part.arrays.boundary_id);
    }
}

TEST_F(VtuWriter, SomeValuesOfACellArrayAreThoseOfTheWhole) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const WrittenPart part = random_part(seed);
        const std::string file = path("part.vtu");
        write(file, part);
        const PartCellCounts counts = read_cell_counts(file);
        EXPECT_EQ(counts.tets, static_cast<std::int64_t>(part.mesh.tets.size()));
        EXPECT_EQ(counts.facets, static_cast<std::int64_t>(part.surface.facets.size()));
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

TEST_F(VtuWriter, NumberingTouchesTheInteriorIdsAlone) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const WrittenPart part = random_part(seed);
        const std::string file = path("part.vtu");
        write(file, part);
        const std::string before = read_file(file);
        number_interior_vertices(file, 7'000'000'000);
        const std::string numbered = read_file(file);
        EXPECT_EQ(read_part(file).global_id, expected_ids(part, 7'000'000'000));
        ASSERT_EQ(numbered.size(), before.size());
        const std::size_t begin =
            parse_vtu_header(before, file).find("GlobalVertexId")->position + 8 + 8 * part.arrays.boundary_id.size();
        const std::size_t end = begin + 8 * static_cast<std::size_t>(part.mesh.interior_vertex_count());
        EXPECT_EQ(numbered.substr(0, begin), before.substr(0, begin));
        EXPECT_EQ(numbered.substr(end), before.substr(end));
        number_interior_vertices(file, 0);
        EXPECT_EQ(read_file(file), before);
    }
}

TEST_F(VtuWriter, SameInputGivesTheSameBytes) {
    const WrittenPart part = random_part(5);
    write(path("a.vtu"), part);
    write(path("b.vtu"), part);
    EXPECT_EQ(read_file(path("a.vtu")), read_file(path("b.vtu")));
}

TEST_F(VtuWriter, QualityIsThatOfTheTetrahedronAndOfTheOneBehindAFacet) {
    const WrittenPart part = random_part(9);
    write(path("part.vtu"), part);
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
    WrittenPart part = random_part(3);
    const Tetrahedron tet = part.mesh.tets.front();
    part.mesh.tets.assign(300'001, tet);
    part.mesh.vertices.resize(200'003, Vec3(1, 2, 3));
    write(path("part.vtu"), part);
    const Part file = read_part(path("part.vtu"));
    EXPECT_EQ(file.mesh.tets, part.mesh.tets);
    EXPECT_EQ(file.mesh.vertices, part.mesh.vertices);
    EXPECT_EQ(file.global_id, expected_ids(part, 0));
    expect_surface(file, part);
}

TEST_F(VtuWriter, PvtuNamesItsPiecesAndTheArraysOfThePieces) {
    const WrittenPart part = random_part(4);
    write(path("part.vtu"), part);
    write_pvtu(path("mesh.pvtu"), {"parts/part_0002.vtu", "parts/a&\"<.vtu"});
    const std::string pvtu = read_file(path("mesh.pvtu"));
    EXPECT_NE(pvtu.find("<Piece Source=\"parts/part_0002.vtu\"/>"), pvtu.npos);
    EXPECT_NE(pvtu.find("<Piece Source=\"parts/a&amp;&quot;&lt;.vtu\"/>"), pvtu.npos);
    const VtuHeader header = parse_vtu_header(read_file(path("part.vtu")), "part.vtu");
    int shared = 0;
    for (const VtuHeader::Array& array : header.arrays)
        shared += pvtu.find("type=\"" + array.type + "\" Name=\"" + array.name + "\"") != pvtu.npos;
    EXPECT_EQ(shared, 11);  // GlobalVertexId, 4 tags, 5 measures, Points
}

TEST_F(VtuWriter, AFullDiskIsAnErrorThatNamesTheFile) {
    const WrittenPart part = random_part(1);
    for (const std::string& message : {test::io_error([&] { write("/dev/full", part); }), test::io_error([&] {
                                           write_part_surface("/dev/full", part.surface, part.arrays);
                                       }),
                                       test::io_error([&] { write_pvtu("/dev/full", {"parts/part_0001.vtu"}); })}) {
        EXPECT_NE(message.find("/dev/full"), message.npos) << message;
        EXPECT_NE(message.find("No space left on device"), message.npos) << message;
    }
}

TEST_F(VtuWriter, AMissingFolderIsAnErrorThatNamesTheFile) {
    const std::string missing = path("missing/part.vtu");
    for (const std::string& message : {test::io_error([&] { write(missing, random_part(1)); }),
                                       test::io_error([&] { number_interior_vertices(missing, 0); })}) {
        EXPECT_NE(message.find(missing), message.npos) << message;
        EXPECT_NE(message.find("No such file"), message.npos) << message;
    }
}

TEST_F(VtuWriter, ArraysOfOtherSizesAreABug) {
    for (int which = 0; which < 5; ++which) {
        SCOPED_TRACE(which);
        WrittenPart part = random_part(2);
        if (which == 0) part.arrays.boundary_id.pop_back();
        if (which == 1) part.arrays.neighbour.pop_back();
        if (which == 2) part.surface.patch.pop_back();
        if (which == 3) part.tet_at_facet.pop_back();
        if (which == 4) --part.mesh.boundary_vertex_count;
        EXPECT_THROW(write(path("part.vtu"), part), Error);
    }
}

TEST_F(VtuWriter, FilesThatEndTooEarlyAreRefused) {
    write(path("part.vtu"), random_part(6));
    const std::string bytes = read_file(path("part.vtu"));
    const std::string cut = path("cut.vtu");
    for (std::size_t missing = 1; missing <= bytes.size(); missing += missing < 300 ? 1 : 97) {
        SCOPED_TRACE(missing);
        std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() - missing);
        EXPECT_NE(test::io_error([&] { read_part(cut); }).find(cut), std::string::npos);
    }
}

TEST_F(VtuWriter, TellsFilesThatAreStillBeingWritten) {
    const WrittenPart part = random_part(9);
    write(path("part.vtu"), part);
    write_part_surface(path("surface.vtu"), part.surface, part.arrays);
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
    write(path("part.vtu"), random_part(8));
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
        test::io_error([&] { number_interior_vertices(path("damaged.vtu"), 5); });
    }
    EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace kerf
