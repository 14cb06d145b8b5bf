// Volume meshes of other programs: the same mesh in every format is the same mesh, and what is broken is refused.
#include "files/io/tet_mesh_reader.h"

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "base/core/elements.h"
#include "base/core/error.h"
#include "files/io/surface_reader.h"
#include "fill/mesh/edge_table.h"
#include "support/archives.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using namespace test;

struct Mesh {
    Soup boundary;  // and its vertices
    std::vector<Tetrahedron> tets;
};

// A cone over every facet of a star-shaped body.
Mesh cones(Soup boundary, const Vec3& apex) {
    Mesh mesh{std::move(boundary), {}};
    const auto top = static_cast<std::int32_t>(mesh.boundary.vertices.size());
    mesh.boundary.vertices.push_back(apex);
    for (const auto& [a, b, c] : mesh.boundary.facets) mesh.tets.push_back({top, a, b, c});
    return mesh;
}

std::vector<Mesh> meshes() {
    return {cones(tetrahedron(), Vec3(0.125, 0.25, 0.375)),
            cones(box(Vec3(-1, 2, 1.0 / 3), Vec3(5, 7, 11), 3), Vec3(1, 4, 5)),
            cones(icosphere(2, 1e-5, Vec3(100, 0, 0)), Vec3(100, 0, 0))};
}

class TetFiles : public testing::Test {
 protected:
    std::string write(const SurfaceFile& file) const {
        std::ofstream(folder_.file(file.name), std::ios::binary) << file.bytes;
        return folder_.file(file.name);
    }
    TetFile read(const SurfaceFile& file) const { return read_tet_file(write(file)); }
    TetFile read_tetgen(const Mesh& mesh, int first, const std::string& ending) const {
        write({"mesh.node", to_node_list(mesh.boundary, first)});
        write({"mesh.ele", to_element_list(mesh.tets, first)});
        return read_tet_file(folder_.file("mesh." + ending));
    }
    void expect_refused(const SurfaceFile& file, const std::string& words) const {
        SCOPED_TRACE(file.name);
        try {
            read(file);
            ADD_FAILURE() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(file.name), std::string::npos) << error.what();
        }
    }

    TemporaryFolder folder_;
};

void expect_mesh(const TetFile& read, const Mesh& mesh, bool has_facets = true) {
    EXPECT_EQ(read.mesh.vertices, mesh.boundary.vertices);
    EXPECT_EQ(read.mesh.tets, mesh.tets);
    EXPECT_EQ(read.facets, has_facets ? mesh.boundary.facets : std::vector<Triangle>());
    EXPECT_EQ(read.turned_tets, 0);
    EXPECT_EQ(std::count(read.is_interface.begin(), read.is_interface.end(), 1), 0);
}

TEST_F(TetFiles, SayTheSameInEveryFormat) {
    for (const Mesh& mesh : meshes()) {
        for (const SurfaceFile& file : to_all_mesh_formats(mesh.boundary, mesh.tets)) {
            SCOPED_TRACE(file.name);
            expect_mesh(read(file), mesh);
            expect_mesh(read({file.name + ".gz", gzip(file.bytes)}), mesh);
        }
        for (const int first : {0, 1})
            for (const char* ending : {"node", "ele"}) expect_mesh(read_tetgen(mesh, first, ending), mesh, false);
    }
}

TEST_F(TetFiles, OfNegativeOrientationAreTurnedAndCounted) {
    const Mesh mesh = meshes()[1];
    std::vector<Tetrahedron> tets = mesh.tets;
    std::int64_t expected = 0;
    for (std::size_t t = 0; t < tets.size(); t += 3, ++expected) std::swap(tets[t][2], tets[t][3]);
    for (const SurfaceFile& file : to_all_mesh_formats(mesh.boundary, tets)) {
        SCOPED_TRACE(file.name);
        const TetFile turned = read(file);
        EXPECT_EQ(turned.turned_tets, expected);
        EXPECT_EQ(turned.mesh.tets, mesh.tets);
    }
}

TEST_F(TetFiles, OfPartsTellTheirInterfaces) {
    const Mesh mesh = meshes()[1];
    std::vector<std::int32_t> neighbours(mesh.boundary.facets.size(), -1);
    neighbours[3] = 0, neighbours[7] = 5;
    const TetFile part = read({"part.vtu", to_vtu(mesh.boundary, mesh.tets, {}, neighbours)});
    for (std::size_t f = 0; f < neighbours.size(); ++f) EXPECT_EQ(part.is_interface[f], neighbours[f] >= 0) << f;
}

TEST_F(TetFiles, SayWhatWasPassedOver) {
    const Mesh mesh = meshes()[0];
    EXPECT_EQ(read({"a.vtu", to_vtu(mesh.boundary, mesh.tets, {})}).notes,
              std::vector<std::string>{"1 cell that is no tetrahedron or triangle was ignored."});
    EXPECT_EQ(read({"a.msh", to_msh(mesh.boundary, {}, mesh.tets)}).notes,
              (std::vector<std::string>{"1 line was ignored.", "1 point was ignored."}));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
}

// VTK writes ranges of vectors into their arrays, behind the values.
TEST_F(TetFiles, OfVtkMayHaveKeysInArrays) {
    const Mesh mesh = meshes()[0];
    const std::string key =
        "\n<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\">\n"
        "<Value index=\"0\">0</Value>\n</InformationKey>\n</DataArray>";
    std::string vtu = to_vtu(mesh.boundary, mesh.tets, {}), with_keys;
    for (std::size_t at = 0; (at = vtu.find("</DataArray>")) != vtu.npos; vtu = vtu.substr(at + 12))
        with_keys += vtu.substr(0, at) + key;
    EXPECT_EQ(read({"keys.vtu", with_keys + vtu}).mesh.tets, mesh.tets);
}

TEST_F(TetFiles, ThatCannotBeMeasuredAreRefusedByName) {
    const Mesh mesh = meshes()[0];
    const std::string vtu = to_vtu(mesh.boundary, mesh.tets, {}), medit = to_medit(mesh.boundary, mesh.tets);
    const std::string msh =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n"
        "$EndNodes\n$Elements\n1\n";
    expect_refused({"surface.off", to_off(mesh.boundary)}, "no volume mesh");
    expect_refused({"surface.mesh", to_medit(mesh.boundary, {})}, "holds no tetrahedra");
    expect_refused({"hexahedra.msh", msh + "1 1 0 1 2\n$EndElements\n"}, "holds no tetrahedra");
    expect_refused({"unknown.msh", msh + "1 99 0 1 2 3 4\n$EndElements\n"}, "elements of type 99");
    expect_refused({"third.mesh", replaced(medit, "Tetrahedra\n", "TetrahedraP3\n")}, "TetrahedraP3");
    expect_refused({"few_nodes.vtu", replaced(vtu, "10 10 ", "24 10 ")}, "type 24");
    expect_refused({"hexahedra.vtu", replaced(vtu, "10 10 ", "25 10 ")}, "type 25");
    expect_refused({"list.pvtu", replaced(vtu, "type=\"Un", "type=\"PUn")}, "list of parts");
    expect_refused({"image.vti", replaced(vtu, "UnstructuredGrid", "ImageData")}, "an image of VTK");
    expect_refused({"lz4.vtu", replaced(vtu, "byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order")}, "LZ4");
    expect_refused({"cut.vtu", vtu.substr(0, vtu.find("offsets"))}, "a tag does not end");
    expect_refused({"short.vtu", vtu.substr(0, vtu.find("<DataArray", vtu.find("Cells>")))}, "no array");
    expect_refused({"nested.vtu", replaced(vtu, "</Cells>", "</Cell>")}, "XML is damaged at byte");
    expect_refused({"binary.mesh", std::string("\1\0\0\0\2\0\0\0", 8)}, "no volume mesh");
    expect_refused({"far.msh", msh + "1 4 0 1 2 3 9\n$EndElements\n"}, "names node 9");
    expect_refused({"far.mesh", replaced(medit, "Tetrahedra\n4\n5 ", "Tetrahedra\n4\n9 ")}, "vertex number 8");
    expect_refused({"nan.mesh", replaced(medit, "0.125", "nan")}, "vertex 4 (counted from 0) is not finite");
    expect_refused({"large.mesh", replaced(medit, "0.125", "1e200")}, "too large");
    expect_refused({"types.vtu", replaced(vtu, "10 10 ", "10 5 ")}, "4 corners");
    expect_refused({"few.vtu", replaced(vtu, "NumberOfCells=\"9\"", "NumberOfCells=\"8\"")}, "not 8");
    expect_refused({"many.vtu", replaced(vtu, "NumberOfPoints=\"5\"", "NumberOfPoints=\"9000000000000000000\"")},
                   "claims");
    EXPECT_THROW(read_tet_file(folder_.file("none.msh")), Error);
}

TEST_F(TetFiles, OfTetgenMayHaveNodesOnEdges) {
    const Mesh mesh = meshes()[1];
    std::string cells = std::to_string(mesh.tets.size()) + " 10 0\n";
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        cells += std::to_string(t);
        for (const std::int32_t v : mesh.tets[t]) cells += " " + std::to_string(v);
        cells += " 0 0 0 0 0 0\n";
    }
    write({"mesh.node", to_node_list(mesh.boundary, 0)});
    expect_mesh(read({"mesh.ele", cells}), mesh, false);
}

TEST_F(TetFiles, OfTetgenAreRefusedByName) {
    Mesh mesh = meshes()[0];
    write({"mesh.node", to_node_list(mesh.boundary, 1)});
    expect_refused({"mesh.ele", "1 8 0\n1 1 2 3 4 5 1 2 3\n"}, "8 nodes");
    expect_refused({"mesh.ele", "1 4 0\n1 1 2 3 6\n"}, "vertex number 5");
    expect_refused({"mesh.ele", "1 4 0\n1 0 2 3 4\n"}, "counts from 1");
    expect_refused({"mesh.ele", "0 4 0\n"}, "holds no tetrahedra");
    expect_refused({"mesh.ele", "2 4 0\n1 1 2 3 4\n"}, "ends too early");
    EXPECT_THROW(read_tet_file(folder_.file("other.ele")), Error);
}

// Cells with a node on each edge, as text of every format that has them. Those nodes come first, so that corners are
// not the first nodes of the file.
std::vector<SurfaceFile> quadratic_files(const Mesh& mesh) {
    const auto& [boundary, tets] = mesh;
    const EdgeTable edges(tets, boundary.vertices.size());
    std::vector<Vec3> nodes(edges.size());
    edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
        nodes[e] = (boundary.vertices[edge[0]] + boundary.vertices[edge[1]]) / 2 + Vec3(0, 0, 1e-9);
    });
    nodes.insert(nodes.end(), boundary.vertices.begin(), boundary.vertices.end());
    const auto text_of = [&](const auto& cell, const auto& cell_edges, int first) {
        std::string text;
        for (const std::int32_t v : cell) text += std::to_string(std::ssize(edges) + v + first) + " ";
        for (const auto& [i, j] : cell_edges)
            text += std::to_string(edges.find(undirected(cell[i], cell[j])) + first) + " ";
        return text;
    };
    const std::string tet_count = std::to_string(tets.size()), facet_count = std::to_string(boundary.facets.size());
    std::ostringstream places, numbered;
    places.precision(17), numbered.precision(17);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        places << nodes[n].transpose() << " 0\n";
        numbered << n + 1 << " " << nodes[n].transpose() << "\n";
    }
    std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(nodes.size()) + "\n" +
                      numbered.str() + "$EndNodes\n$Elements\n" + std::to_string(tets.size() + boundary.facets.size()) +
                      "\n";
    std::string medit = "MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(nodes.size()) + "\n" +
                        places.str() + "TrianglesP2\n" + facet_count + "\n";
    std::string corners, ends, types;
    for (const Triangle& facet : boundary.facets) {
        msh += "1 9 0 " + text_of(facet, triangle_edges, 1) + "\n";
        medit += text_of(facet, triangle_edges, 1) + "7\n";
        corners += text_of(facet, triangle_edges, 0);
        ends += std::to_string(6 * (std::ssize(types) / 3 + 1)) + " ";
        types += "22 ";
    }
    medit += "TetrahedraP2\n" + tet_count + "\n";
    for (std::size_t t = 0; t < tets.size(); ++t) {
        msh += "1 11 0 " + text_of(tets[t], tet_edges, 1) + "\n";
        medit += text_of(tets[t], tet_edges, 1) + "3\n";
        corners += text_of(tets[t], tet_edges, 0);
        ends += std::to_string(6 * std::ssize(boundary.facets) + 10 * (t + 1)) + " ";
        types += "24 ";
    }
    std::ostringstream points;
    points.precision(17);
    for (const Vec3& p : nodes) points << p.transpose() << " ";
    const auto array = [](const std::string& name, const std::string& values) {
        return "<DataArray type=\"" + std::string(name == "Points" ? "Float64" : "Int64") + "\" Name=\"" + name +
               "\" NumberOfComponents=\"" + (name == "Points" ? "3" : "1") + "\" format=\"ascii\">" + values +
               "</DataArray>\n";
    };
    const std::string vtu =
        "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
        std::to_string(nodes.size()) + "\" NumberOfCells=\"" + std::to_string(tets.size() + boundary.facets.size()) +
        "\">\n<Points>\n" + array("Points", points.str()) + "</Points>\n<Cells>\n" + array("connectivity", corners) +
        array("offsets", ends) + array("types", types) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return {{"second.msh", msh + "$EndElements\n"}, {"second.mesh", medit + "End\n"}, {"second.vtu", vtu}};
}

TEST_F(TetFiles, OfSecondOrderAreTheirCorners) {
    for (const Mesh& mesh : meshes()) {
        const std::string note = std::to_string(mesh.tets.size() + mesh.boundary.facets.size()) +
                                 " cells of higher order were read by their corners.";
        for (const SurfaceFile& file : quadratic_files(mesh)) {
            SCOPED_TRACE(file.name);
            const TetFile found = read(file);
            expect_mesh(found, mesh);
            EXPECT_EQ(found.notes, std::vector<std::string>{note});
            Soup surface = read_surface_bytes(file.bytes, file.name);
            drop_unused_vertices(surface);
            EXPECT_EQ(std::count(surface.notes.begin(), surface.notes.end(), note), 1);
            EXPECT_EQ(surface.facets.size(), mesh.boundary.facets.size());
            EXPECT_EQ(surface.vertices.size(), mesh.boundary.vertices.size() - 1);  // without the apex
        }
    }
}

// Whatever is cut off or changed, a reader ends with an Error or with a mesh that is one.
void expect_error_or_mesh(const SurfaceFile& damaged) {
    try {
        const TetFile file = read_tet_bytes(damaged.bytes, damaged.name);
        EXPECT_TRUE(are_in_range(file.mesh.tets, file.mesh.vertices.size()));
        EXPECT_TRUE(are_in_range(file.facets, file.mesh.vertices.size()));
        EXPECT_FALSE(file.mesh.tets.empty());
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
    }
}

TEST(TetBytes, ThatAreTruncatedOrDamagedAreNoSurprise) {
    const Mesh mesh = meshes()[0];
    constexpr unsigned seed = 11;
    std::mt19937 random(seed);
    std::vector<SurfaceFile> files = to_all_mesh_formats(mesh.boundary, mesh.tets);
    for (const SurfaceFile& file : quadratic_files(mesh)) files.push_back(file);
    for (const SurfaceFile& file : files) {
        SCOPED_TRACE(file.name);
        for (std::size_t size = 0; size < file.bytes.size(); size += 1 + file.bytes.size() / 60)
            expect_error_or_mesh({file.name, file.bytes.substr(0, size)});
        for (int change = 0; change < 100; ++change) {
            std::string bytes = file.bytes;
            bytes[random() % bytes.size()] = static_cast<char>(random());
            SCOPED_TRACE(change);
            expect_error_or_mesh({file.name, bytes});
        }
    }
}

}  // namespace
}  // namespace kerf
