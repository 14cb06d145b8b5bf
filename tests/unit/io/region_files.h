// Small meshes of several volumes, and the files that hold them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/core/types.h"
#include "support/surface_files.h"

namespace kerf::test::regions {

using Names = std::vector<std::string>;

struct Volume {
    std::string name;  // of its group
    int group = 0;     // 0: none
};

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Tetrahedron> tets;
    std::vector<std::size_t> volume_of_tet;
    std::vector<Volume> volumes;
    std::vector<Triangle> triangles = {};
    std::vector<int> surface_of_triangle = {};  // #F
};

// A tetrahedron above the triangle 0 1 2 and one below it, which is negative in the file.
inline Mesh two_tets() {
    return {{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 1), Vec3(0, 0, -2)},
            {{0, 1, 2, 3}, {0, 1, 2, 4}},
            {0, 1},
            {{"core", 7}, {"outer shell", 8}}};
}

// Four around the edge from 0 to 1, of three volumes: the second has two of them that meet at the edge alone.
inline Mesh around_an_edge() {
    return {{Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)},
            {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 2}},
            {0, 1, 2, 1},
            {{"a", 3}, {"b", 4}, {"c", 5}}};
}

// Two unit cubes side by side, each of six tetrahedra around a diagonal.
inline Mesh two_cubes() {
    Mesh mesh;
    for (int i = 0; i < 12; ++i) mesh.vertices.emplace_back(i % 3, i / 3 % 2, i / 6);
    constexpr std::array<Tetrahedron, 6> cube = {
        {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 6, 2, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
    for (const int first : {0, 1})
        for (const Tetrahedron& tet : cube) {
            Tetrahedron& placed = mesh.tets.emplace_back();
            for (std::size_t i = 0; i < 4; ++i)
                placed[i] = first + (tet[i] & 1) + 3 * (tet[i] >> 1 & 1) + 6 * (tet[i] >> 2);
            mesh.volume_of_tet.push_back(static_cast<std::size_t>(first));
        }
    mesh.volumes = {{"left side", 1}, {"right side", 2}};
    return mesh;
}

// The sections of an MSH file, whose numbers are text or bytes.
class Msh {
 public:
    Msh(const Mesh& mesh, const MshStyle& style) : mesh_(mesh), style_(style) {
        text(style.is_msh41 ? "$MeshFormat\n4.1 " : "$MeshFormat\n2.2 ").text(style.is_binary ? "1 8\n" : "0 8\n");
        if (style.is_binary) add(1);
        text("\n$EndMeshFormat\n$PhysicalNames\n");
        std::map<int, std::string> names;
        for (const Volume& volume : mesh.volumes)
            if (!volume.name.empty()) names[volume.group] = volume.name;
        text(std::to_string(names.size()) + "\n");
        for (const auto& [group, name] : names) text("3 " + std::to_string(group) + " \"" + name + "\"\n");
        text("$EndPhysicalNames\n");
        style.is_msh41 ? write_msh41() : write_msh2();
    }
    const std::string& bytes() const { return bytes_; }

 private:
    Msh& text(const std::string& text) {
        bytes_ += text;
        return *this;
    }
    template <class... Number>
    void add(Number... numbers) {
        const auto add_one = [&](auto number) {
            if (style_.is_binary)
                append(bytes_, number, style_.is_big_endian);
            else
                bytes_ += std::to_string(number) + " ";
        };
        (add_one(numbers), ...);
        if (!style_.is_binary) bytes_ += "\n";
    }
    static std::int64_t size(std::size_t value) { return static_cast<std::int64_t>(value); }
    void add_nodes() {
        for (const Vec3& p : mesh_.vertices) add(p.x(), p.y(), p.z());
    }
    template <class Cell>
    void add_element_2(int type, int group, int entity, const Cell& cell) {
        style_.is_binary ? add(type, 1, 2, 1) : add(1, type, 2);
        add(group, entity);
        for (const std::int32_t v : cell) add(v + 1);
    }
    void write_msh2() {
        text("$Nodes\n" + std::to_string(mesh_.vertices.size()) + "\n");
        for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
            add(static_cast<std::int32_t>(v + 1));
            add(mesh_.vertices[v].x(), mesh_.vertices[v].y(), mesh_.vertices[v].z());
        }
        text("\n$EndNodes\n$Elements\n" + std::to_string(mesh_.tets.size() + mesh_.triangles.size()) + "\n");
        for (std::size_t f = 0; f < mesh_.triangles.size(); ++f)
            add_element_2(2, 0, mesh_.surface_of_triangle[f], mesh_.triangles[f]);
        for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
            const std::size_t volume = mesh_.volume_of_tet[t];
            add_element_2(4, mesh_.volumes[volume].group, static_cast<int>(volume + 1), mesh_.tets[t]);
        }
        text("\n$EndElements\n");
    }
    template <class Cell>
    void add_element_41(int dimension, int entity, int type, const Cell& cell) {
        add(dimension, entity, type);
        add(size(1), size(1));
        for (const std::int32_t v : cell) add(size(0) + v + 1);
    }
    void write_msh41() {
        text("$Entities\n");
        add(size(0), size(0), size(0), size(mesh_.volumes.size()));
        for (std::size_t v = 0; v < mesh_.volumes.size(); ++v) {
            add(static_cast<int>(v + 1));
            add(0.0, 0.0, 0.0, 1.0, 1.0, 1.0);
            add(size(mesh_.volumes[v].group != 0));
            if (mesh_.volumes[v].group != 0) add(mesh_.volumes[v].group);
            add(size(0));
        }
        text("\n$EndEntities\n$Nodes\n");
        add(size(1), size(mesh_.vertices.size()), size(1), size(mesh_.vertices.size()));
        add(3, 1, 0);
        add(size(mesh_.vertices.size()));
        for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) add(size(v + 1));
        add_nodes();
        text("\n$EndNodes\n$Elements\n");
        const std::int64_t count = size(mesh_.tets.size() + mesh_.triangles.size());
        add(count, count, size(1), count);
        for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
            add_element_41(3, static_cast<int>(mesh_.volume_of_tet[t] + 1), 4, mesh_.tets[t]);
        for (std::size_t f = 0; f < mesh_.triangles.size(); ++f)
            add_element_41(2, mesh_.surface_of_triangle[f], 2, mesh_.triangles[f]);
        text("\n$EndElements\n");
    }

    const Mesh& mesh_;
    MshStyle style_;
    std::string bytes_;
};

// The reference of a volume is its group.
inline std::string to_medit(const Mesh& mesh) {
    std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices " + std::to_string(mesh.vertices.size()) + "\n";
    for (const Vec3& p : mesh.vertices)
        text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + " 0\n";
    const auto add_cells = [&](const std::string& keyword, const auto& cells, const auto& reference) {
        if (cells.empty()) return;
        text += keyword + " " + std::to_string(cells.size()) + "\n";
        for (std::size_t i = 0; i < cells.size(); ++i) {
            for (const std::int32_t v : cells[i]) text += std::to_string(v + 1) + " ";
            text += std::to_string(reference(i)) + "\n";
        }
    };
    add_cells("Triangles", mesh.triangles, [&](std::size_t f) { return mesh.surface_of_triangle[f]; });
    add_cells("Tetrahedra", mesh.tets, [&](std::size_t t) { return mesh.volumes[mesh.volume_of_tet[t]].group; });
    return text + "End\n";
}

// The number of a volume is its group; arrays of cells have these names, and RegionNames these bytes.
inline std::string to_vtu(const Mesh& mesh, const Names& arrays, const std::string& region_names = "") {
    std::string numbers, points, corners, ends, types;
    std::size_t end = 0;
    const auto add_cell = [&](const auto& cell, int type, int number) {
        for (const std::int32_t v : cell) corners += std::to_string(v) + " ";
        ends += std::to_string(end += cell.size()) + " ";
        types += std::to_string(type) + " ";
        numbers += std::to_string(number) + " ";
    };
    for (const Vec3& p : mesh.vertices)
        for (const double x : p) points += std::to_string(x) + " ";
    for (const Triangle& t : mesh.triangles) add_cell(t, 5, 99);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        add_cell(mesh.tets[t], 10, mesh.volumes[mesh.volume_of_tet[t]].group);
    const auto array = [](const std::string& type, const std::string& name, const std::string& values) {
        return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>\n";
    };
    std::string text = "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
    if (!region_names.empty()) {
        std::string bytes;
        for (const char c : region_names) bytes += std::to_string(static_cast<int>(c)) + " ";
        text += "<FieldData>\n<Array type=\"String\" Name=\"RegionNames\" format=\"ascii\">" + bytes +
                "</Array>\n</FieldData>\n";
    }
    text += "<Piece NumberOfPoints=\"" + std::to_string(mesh.vertices.size()) + "\" NumberOfCells=\"" +
            std::to_string(mesh.tets.size() + mesh.triangles.size()) + "\">\n<Points>\n" +
            array("Float64", "Points", points) + "</Points>\n<Cells>\n" + array("Int64", "connectivity", corners) +
            array("Int64", "offsets", ends) + array("UInt8", "types", types) + "</Cells>\n<CellData>\n";
    for (const std::string& name : arrays)
        text += array(name == "Real" ? "Float64" : "Int32", name == "Real" ? "Region" : name, numbers);
    return text + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

struct File {
    std::string name, bytes;
};

inline std::vector<File> msh_files(const Mesh& mesh) {
    std::vector<File> files;
    for (const bool is_msh41 : {false, true})
        for (const auto& [is_binary, is_big_endian] : {std::pair(false, false), {true, false}, {true, true}})
            files.push_back({std::string(is_msh41 ? "msh41" : "msh22") + (is_binary ? "_binary" : "") +
                                 (is_big_endian ? "_big" : "") + ".msh",
                             Msh(mesh, {is_msh41, is_binary, is_big_endian}).bytes()});
    return files;
}

inline std::vector<File> all_files(const Mesh& mesh) {
    std::vector<File> files = msh_files(mesh);
    files.push_back({"medit.mesh", to_medit(mesh)});
    files.push_back({"mesh.vtu", to_vtu(mesh, {"Region"})});
    return files;
}

}  // namespace kerf::test::regions
