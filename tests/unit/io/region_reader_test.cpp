// Files of several volumes: facets between them and around them, each once, and what is on their sides.
#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/predicates.h"
#include "base/geometry/tetrahedron.h"
#include "files/io/inside/tet_skin.h"
#include "files/io/surface_reader.h"
#include "region_files.h"
#include "support/facet_sides.h"
#include "support/seeded_numbers.h"

namespace kerf {
namespace {

using namespace test::regions;
using Notes = std::vector<std::string>;

Soup read_volumes(const File& file) { return read_surface_bytes(file.bytes, file.name); }

std::string refusal_of(const File& file) {
    try {
        read_volumes(file);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    ADD_FAILURE() << "accepted";
    return "";
}

// Each facet once, with the smaller region behind it; the facets of each region close, and enclose this volume.
void expect_regions(const Soup& soup, const std::vector<double>& volumes) {
    ASSERT_EQ(soup.sides.size(), soup.facets.size());
    ASSERT_EQ(soup.patch.size(), soup.facets.size());
    ASSERT_EQ(soup.region_names.size(), volumes.size());
    Array<RegionIndex, double> enclosed(volumes.size(), 0);
    std::map<std::pair<RegionIndex, UndirectedEdge>, int> balance;
    std::vector<Triangle> sorted = soup.facets;
    for (Triangle& t : sorted) std::sort(t.begin(), t.end());
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        const auto& [front, back] = soup.sides[f];
        ASSERT_TRUE(back.is_valid() && (!front.is_valid() || front > back));
        for (const auto& [region, sign] : {std::pair(back, 1), {front, -1}}) {
            if (!region.is_valid()) continue;
            const auto& p = soup.vertices;
            enclosed[region] += sign * p[t[0]].cross(p[t[1]]).dot(p[t[2]]) / 6;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::int32_t from = t[i], to = t[(i + 1) % 3];
                balance[{region, undirected(from, to)}] += from < to ? sign : -sign;
            }
        }
    }
    for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0) << "region " << edge.first.value();
    for (std::size_t r = 0; r < volumes.size(); ++r) EXPECT_NEAR(enclosed[r], volumes[r], 1e-12) << "region " << r;
}

std::int64_t wall_count(const Soup& soup) {
    return std::count_if(soup.sides.begin(), soup.sides.end(), [](const FacetSides& s) { return s.is_wall(); });
}

std::string patch_name_of(const Soup& soup, std::size_t facet) {
    return soup.patch_names[static_cast<std::size_t>(soup.patch[facet])];
}

TEST(RegionReader, MakesFacetsOfAllFacesAtWhichARegionEnds) {
    for (const File& file : all_files(two_tets())) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        const bool has_names = file.name.ends_with(".msh");
        const std::string core = has_names ? "core" : "region_7", shell = has_names ? "outer shell" : "region_8";
        EXPECT_EQ(soup.region_names, (Names{core, shell}));
        expect_regions(soup, {1.5, 3});
        ASSERT_EQ(soup.facets.size(), 7u);
        EXPECT_EQ(wall_count(soup), 1);
        EXPECT_EQ(soup.patch_names, (Names{"outer", core + "_to_" + shell}));
        EXPECT_EQ(soup.notes, Notes{"There are 2 regions, '" + core + "', '" + shell +
                                    "': 1 of the 7 facets is between two of them."});
        EXPECT_TRUE(soup.polygon.empty());
    }
    for (const File& file : all_files(two_cubes())) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        expect_regions(soup, {1, 1});
        EXPECT_EQ(soup.facets.size(), 22u);
        EXPECT_EQ(wall_count(soup), 2);
    }
}

TEST(RegionReader, KnowsThreeRegionsAroundAnEdge) {
    for (const File& file : all_files(around_an_edge())) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        constexpr double volume = 1.0 / 3;
        expect_regions(soup, {volume, 2 * volume, volume});
        EXPECT_EQ(soup.facets.size(), 12u);
        EXPECT_EQ(wall_count(soup), 4);
        if (file.name.ends_with(".msh")) {
            EXPECT_EQ(soup.patch_names, (Names{"outer", "a_to_b", "b_to_c"}));
        }
    }
}

TEST(RegionReader, KnowsRegionsThatDoNotTouch) {
    Mesh mesh = two_tets();
    for (int i = 0; i < 3; ++i) mesh.vertices.push_back(mesh.vertices[i] - Vec3(0, 0, 1));
    mesh.tets[1] = {5, 6, 7, 4};
    for (const File& file : all_files(mesh)) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        expect_regions(soup, {1.5, 1.5});
        EXPECT_EQ(soup.facets.size(), 8u);
        EXPECT_EQ(soup.patch_names, Names{"outer"});
    }
}

TEST(RegionReader, KeepsThePatchesOfTrianglesThatAreThere) {
    Mesh mesh = two_cubes();
    mesh.triangles = {{1, 4, 10}, {9, 11, 8}, {0, 1, 4}, {4, 10, 1}, {0, 4, 10}};  // wall, none, outer, wall, inside
    mesh.surface_of_triangle = {5, 6, 7, 8, 9};
    for (const File& file : all_files(mesh)) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        expect_regions(soup, {1, 1});
        ASSERT_EQ(soup.facets.size(), 22u);
        const std::string begin = file.name.ends_with(".mesh") ? "reference_" : "surface_";
        const bool is_vtu = file.name.ends_with(".vtu");
        EXPECT_TRUE(soup.sides[0].is_wall());
        EXPECT_FALSE(soup.sides[1].is_wall());
        EXPECT_EQ(patch_name_of(soup, 0), is_vtu ? "region_1_to_region_2" : begin + "5");
        EXPECT_EQ(patch_name_of(soup, 1), is_vtu ? "outer" : begin + "7");
        EXPECT_EQ(soup.patch_names.size(), is_vtu ? 2u : 4u) << "those of triangles that are left out are gone";
        EXPECT_EQ(soup.polygon[1], 2) << "the number in the file";
        EXPECT_EQ(soup.polygon[2], 5) << "numbers behind those of the file";
        ASSERT_GE(soup.notes.size(), 2u);
        EXPECT_EQ(soup.notes[0], "2 triangles at which no region ends were ignored.");
        EXPECT_EQ(soup.notes[1], "1 triangle that the file has twice was ignored.");
    }
}

TEST(RegionReader, JoinsVolumesOfTheSameName) {
    Mesh mesh = two_tets();
    mesh.volumes[1] = mesh.volumes[0];
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    mesh.surface_of_triangle = {1, 2};
    for (const File& file : msh_files(mesh)) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        EXPECT_TRUE(soup.sides.empty() && soup.region_names.empty());
        EXPECT_EQ(soup.facets.size(), 6u);
        EXPECT_EQ(soup.patch_names, (Names{"surface_2", "surface"}));
        EXPECT_EQ(soup.notes,
                  (Notes{"2 volumes are one region, 'core'.", "1 triangle at which no region ends was ignored."}));
    }
    mesh = around_an_edge();
    mesh.volumes[2] = {"a", 9};
    for (const File& file : msh_files(mesh)) {
        SCOPED_TRACE(file.name);
        const Soup soup = read_volumes(file);
        EXPECT_EQ(soup.region_names, (Names{"a", "b"}));
        expect_regions(soup, {2.0 / 3, 2.0 / 3});
    }
}

TEST(RegionReader, NamesVolumesWithoutANameByTheirNumbers) {
    Mesh mesh = two_tets();
    mesh.volumes = {{"", 12}, {"", 0}};
    for (const File& file : msh_files(mesh)) {
        SCOPED_TRACE(file.name);
        EXPECT_EQ(read_volumes(file).region_names, (Names{"volume_2", "physical_12"}));
    }
    mesh.volumes = {{"", 4}, {"", -3}};
    EXPECT_EQ(read_volumes({"medit.mesh", to_medit(mesh)}).region_names, (Names{"region_-3", "region_4"}));
}

TEST(RegionReader, TakesTheArrayOfVtuThatTellsRegions) {
    Mesh mesh = two_tets();
    mesh.volumes = {{"", 1}, {"", 0}};
    for (const char* name : {"Region", "gmsh:physical", "medit:ref", "attribute"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(read_volumes({"mesh.vtu", to_vtu(mesh, {"Other", name})}).region_names,
                  (Names{"region_0", "region_1"}));
    }
    for (const char* name : {"Other", "Real", "Patch"}) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(read_volumes({"mesh.vtu", to_vtu(mesh, {name})}).sides.empty());
    }
    const std::string names("shell of steel\0core\0", 20);
    const Soup soup = read_volumes({"mesh.vtu", to_vtu(mesh, {"Region"}, names)});
    EXPECT_EQ(soup.region_names, (Names{"shell of steel", "core"}));
    EXPECT_EQ(soup.patch_names[1], "shell of steel_to_core");
    mesh.volumes[0].group = 2;
    EXPECT_EQ(read_volumes({"mesh.vtu", to_vtu(mesh, {"Region"}, names)}).region_names,
              (Names{"shell of steel", "region_2"}));
}

// Two tetrahedra on a common triangle, the arrays named in any case.
TEST(RegionReader, TakesTheSidesOfTrianglesOfVtu) {
    const auto vtu = [](const std::string& front, const std::string& back, const std::string& names) {
        return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><FieldData>" + names +
               "</FieldData><Piece NumberOfPoints=\"5\" NumberOfCells=\"7\"><Points><DataArray type=\"Float64\" "
               "NumberOfComponents=\"3\">0 0 0 3 0 0 0 3 0 0 0 1 0 0 -2</DataArray></Points><Cells><DataArray "
               "type=\"Int64\" Name=\"connectivity\">0 1 2 0 1 3 1 2 3 2 0 3 1 0 4 2 1 4 0 2 4</DataArray><DataArray "
               "type=\"Int64\" Name=\"offsets\">3 6 9 12 15 18 21</DataArray><DataArray type=\"UInt8\" "
               "Name=\"types\">5 5 5 5 5 5 5</DataArray></Cells><CellData>" +
               front + back + "</CellData></Piece></UnstructuredGrid></VTKFile>";
    };
    const auto array = [](const char* type, const char* name, const char* values) {
        return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\">" + values + "</DataArray>";
    };
    const std::string front = array("Int32", "Front", "1 -1 -1 -1 -1 -1 -1"),
                      back = array("Int64", "BACK", "3 1 1 1 3 3 3");
    const Soup soup = read_surface_bytes(vtu(front, back, ""), "surface.vtu");
    EXPECT_EQ(soup.region_names, (std::vector<std::string>{"region_1", "region_3"}));
    ASSERT_EQ(soup.sides.size(), 7U);
    EXPECT_EQ(soup.sides[0], test::facet_sides(1, 0));  // the smaller one is behind it
    EXPECT_EQ(soup.sides[1], test::facet_sides(-1, 0));
    EXPECT_EQ(soup.sides[4], test::facet_sides(-1, 1));
    const std::string names = array("Int8", "RegionNames", "0 97 0 0 98 0");
    EXPECT_EQ(read_surface_bytes(vtu(front, back, names), "surface.vtu").region_names,
              (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(read_surface_bytes(vtu(front, "", ""), "surface.vtu").sides.empty());
    const std::string real = array("Float64", "back", "3 1 1 1 3 3 3");
    EXPECT_TRUE(read_surface_bytes(vtu(front, real, ""), "surface.vtu").sides.empty());
}

TEST(RegionReader, RefusesTetrahedraThatOverlap) {
    Mesh mesh = two_tets();
    mesh.tets[1] = {0, 1, 2, 3};
    for (const File& file : all_files(mesh)) {
        SCOPED_TRACE(file.name);
        const std::string message = refusal_of(file);
        EXPECT_NE(message.find("overlap near (1, 1, 0)"), std::string::npos) << message;
    }
    mesh = two_tets();
    mesh.tets.push_back({0, 2, 1, 4});
    mesh.volume_of_tet.push_back(0);
    EXPECT_NE(refusal_of({"a.mesh", to_medit(mesh)}).find("'region_7' and 'region_8' overlap"), std::string::npos);
}

// Of a cell that is nearly flat a rounded volume may have the wrong sign.
TEST(RegionFaces, KnowTheSidesOfFlatTetrahedra) {
    test::SeededNumbers random(1);
    const auto point = [&] { return Vec3(random.share(), random.share(), random.share()); };
    int misleading = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<Vec3> p = {point(), point(), point()};
        const double u = random.share(), v = random.share();
        p.emplace_back(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]));
        const int side = orientation(p[0], p[1], p[2], p[3]);
        if (side == 0) continue;
        p.emplace_back(p[0] - side * (p[1] - p[0]).cross(p[2] - p[0]));  // on the other side
        misleading += side * six_volumes_of(p[0], p[1], p[2], p[3]) < 0;
        const RegionFaces found = region_faces(p, {{0, 1, 2, 3}, {0, 1, 2, 4}}, {RegionIndex(0), RegionIndex(1)});
        ASSERT_FALSE(found.overlap.has_value());
        for (const RegionFace& face : found.faces) {
            const auto& [a, b, c] = face.corners;
            const std::int32_t apex =
                face.sides.back == RegionIndex(1) ? 4 : 3;  // of the cell behind it, or its other corner
            for (const std::int32_t inside : {0, 1, 2, apex}) EXPECT_LE(orientation(p[a], p[b], p[c], p[inside]), 0);
        }
    }
    EXPECT_GT(misleading, 0);
}

// Two volumes, by their lists of surfaces, and up to three surfaces of triangles.
std::string to_entities(const std::string& first, const std::string& second, const std::vector<Vec3>& nodes,
                        const std::vector<std::vector<Triangle>>& surfaces) {
    const auto count = [](const auto& list) { return std::to_string(list.size()); };
    std::string text =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"core\"\n$EndPhysicalNames\n"
        "$Entities\n0 0 3 2\n1 0 0 0 1 1 1 0 0\n2 0 0 0 1 1 1 0 0\n3 0 0 0 1 1 1 0 0\n"
        "1 0 0 0 1 1 1 1 7 " +
        first + "\n2 0 0 0 1 1 1 0 " + second + "\n$EndEntities\n$Nodes\n1 " + count(nodes) + " 1 " + count(nodes) +
        "\n2 1 0 " + count(nodes) + "\n";
    for (std::size_t v = 0; v < nodes.size(); ++v) text += std::to_string(v) + "\n";
    for (const Vec3& p : nodes)
        text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    text += "$EndNodes\n$Elements\n" + count(surfaces) + " 1 1 1\n";
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        text += "2 " + std::to_string(i + 1) + " 2 " + count(surfaces[i]) + "\n";
        for (const auto& [a, b, c] : surfaces[i])
            text += "1 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    }
    return text + "$EndElements\n";
}

// Around the upper of two_tets(), between the two, and around the lower one.
const std::vector<std::vector<Triangle>> surfaces_of_two = {
    {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {{0, 1, 2}}, {{1, 0, 4}, {2, 1, 4}, {0, 2, 4}}};

TEST(RegionReader, TakesSidesFromTheSurfacesOfVolumes) {
    const std::vector<Vec3> nodes = two_tets().vertices;
    for (const char* first : {"2 1 -2", "2 -1 2", "2 1 2"})
        for (const char* second : {"2 2 3", "2 -2 -3", "2 -2 3"})
            for (const bool is_turned : {false, true}) {
                SCOPED_TRACE(std::string(first) + ", " + second);
                std::vector<std::vector<Triangle>> surfaces = surfaces_of_two;
                if (is_turned) std::swap(surfaces[1][0][0], surfaces[1][0][1]);
                const Soup soup = read_volumes({"a.msh", to_entities(first, second, nodes, surfaces)});
                expect_regions(soup, {3, 1.5});
                EXPECT_EQ(soup.region_names, (Names{"volume_2", "core"}));
                EXPECT_EQ(soup.facets.size(), 7u);
                EXPECT_EQ(wall_count(soup), 1);
                EXPECT_EQ(soup.patch_names, (Names{"surface_1", "surface_2", "surface_3"}));
            }
    const Soup one =
        read_volumes({"a.msh", to_entities("2 1 2", "2 2 3", nodes, {surfaces_of_two[0], surfaces_of_two[1]})});
    EXPECT_EQ(one.facets.size(), 4u);
    EXPECT_TRUE(one.sides.empty()) << "only one of the volumes is there";
}

TEST(RegionReader, KnowsVolumesInsideOfOthersByTheirSurfaces) {
    std::vector<Vec3> nodes = {Vec3(0, 0, 0), Vec3(8, 0, 0), Vec3(0, 8, 0), Vec3(0, 0, 8)};
    for (int i = 0; i < 4; ++i) nodes.emplace_back(nodes[i] / 8 + Vec3(1, 1, 1));
    nodes.emplace_back(9, 9, 9);
    const std::vector<Triangle> outer = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                                inner = {{4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}}, inside = {{0, 1, 8}};
    const std::string bytes = to_entities("4 1 2 3 -3", "1 2", nodes, {outer, inner, inside});
    const Soup soup = read_volumes({"a.msh", bytes});
    expect_regions(soup, {1.0 / 6, 511.0 / 6});
    EXPECT_EQ(soup.facets.size(), 8u);
    EXPECT_EQ(wall_count(soup), 4);
    EXPECT_EQ(soup.patch_names, (Names{"surface_1", "surface_2"}));
    EXPECT_EQ(soup.notes.front(), "1 triangle at which no region ends was ignored.");
}

// Whatever is cut off or changed, a reader ends with an Error or with sides that are some.
// The least of the damage below that an exact sign of it made undefined.
TEST(RegionReader, TakesCoordinatesThatAreNotFiniteAsTheyAre) {
    for (const char* number : {"nan", "inf", "-inf", "1e308"}) {
        SCOPED_TRACE(number);
        const std::string bytes = "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 " +
                                  std::string(number) + " 0\n0 0 -1 0\nTetrahedra 2\n1 2 3 4 1\n1 3 2 5 2\nEnd\n";
        const Soup soup = read_volumes({"damaged.mesh", bytes});
        EXPECT_EQ(soup.vertices.size(), 5U);
    }
}

TEST(RegionReader, IsNotSurprisedByDamage) {
    std::mt19937 random(5);
    std::vector<File> files = all_files(two_cubes());
    files.push_back({"entities.msh", to_entities("2 1 -2", "2 2 3", two_tets().vertices, surfaces_of_two)});
    for (const File& file : files)
        for (int change = 0; change < 300; ++change) {
            SCOPED_TRACE(file.name + ", change " + std::to_string(change));
            File damaged = file;
            if (change % 3 == 0) damaged.bytes.resize(random() % damaged.bytes.size());
            for (int i = 0; i < 2 && !damaged.bytes.empty(); ++i)
                damaged.bytes[random() % damaged.bytes.size()] = static_cast<char>(random());
            try {
                const Soup soup = read_volumes(damaged);
                ASSERT_TRUE(soup.sides.empty() || soup.sides.size() == soup.facets.size());
                const RegionIndex count(soup.region_names.size());
                for (const FacetSides& s : soup.sides)
                    ASSERT_TRUE(s.back.is_valid() && s.back < count && s.front < count && s.front != s.back);
                for (const std::int32_t p : soup.patch) ASSERT_LT(static_cast<std::size_t>(p), soup.patch_names.size());
            } catch (const Error& error) {
                ASSERT_EQ(error.code(), ErrorCode::input) << error.what();
            }
        }
}

}  // namespace
}  // namespace kerf
