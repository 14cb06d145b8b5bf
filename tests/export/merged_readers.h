// Small readers of the formats that hold a mesh in one piece. They know the formats from their documentation, not from
// the writers.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/core/types.h"
#include "support/file_contents.h"

namespace kerf::test {

using GlobalTet = std::array<std::int64_t, 4>;
using GlobalTriangle = std::array<std::int64_t, 3>;

/// What every format says. Vertices are numbered from 0.
struct MergedMesh {
    std::vector<Vec3> points;
    std::vector<GlobalTet> tets;
    std::vector<std::int64_t> part;  ///< #T; as the file numbers them; empty: the format says nothing
    std::vector<std::int64_t> body;  ///< #T; from 1; empty: the format says nothing
    std::vector<GlobalTriangle> triangles;
    std::vector<std::array<std::int64_t, 6>> on_edges;    ///< #T of order 2, else empty; of edges 01 12 02 03 13 23
    std::vector<GlobalTriangle> on_triangle_edges;        ///< #F, if the format has them; of edges 01 12 02
    std::vector<std::string> patch;                       ///< #F; its name or number in the file
    std::map<std::string, std::set<std::int64_t>> nodes;  ///< of each patch; empty: the format says nothing
};

/// The file without what stands behind the comment character in each line.
inline std::istringstream text_of(const std::string& path, char comment) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    std::string text, line;
    while (std::getline(file, line)) text += line.substr(0, line.find(comment)) + "\n";
    return std::istringstream(text);
}

template <class Number>
Number read_number(std::istream& text) {
    Number number{};
    EXPECT_TRUE(text >> number);
    return number;
}

inline Vec3 read_point(std::istream& text) {
    const auto x = read_number<double>(text), y = read_number<double>(text), z = read_number<double>(text);
    return {x, y, z};
}

template <std::size_t n>
std::array<std::int64_t, n> read_corners(std::istream& text, std::int64_t first) {
    std::array<std::int64_t, n> corners;
    for (std::int64_t& corner : corners) corner = read_number<std::int64_t>(text) - first;
    return corners;
}

/// The nodes of edges behind the corners; `edges`: the places of 01 12 02 03 13 23 among them.
inline void read_nodes_on_edges(std::istream& text, MergedMesh& mesh, const std::array<std::size_t, 6>& edges) {
    const auto found = read_corners<6>(text, 0);
    std::array<std::int64_t, 6> nodes;
    for (std::size_t i = 0; i < 6; ++i) nodes[i] = found[edges[i]];
    mesh.on_edges.push_back(nodes);
}

/// Medit: keyword, number of items, items with a reference behind each.
inline MergedMesh read_medit(const std::string& path) {
    MergedMesh mesh;
    std::istringstream text = text_of(path, '#');
    std::string word;
    while (text >> word && word != "End") {
        const auto count = read_number<std::int64_t>(text);
        if (word == "MeshVersionFormatted") {
            EXPECT_EQ(count, 2);
        }
        if (word == "Dimension") {
            EXPECT_EQ(count, 3);
        }
        for (std::int64_t i = 0; i < count && word == "Vertices"; ++i) {
            mesh.points.push_back(read_point(text));
            EXPECT_EQ(read_number<int>(text), 0);
        }
        for (std::int64_t i = 0; i < count && word.starts_with("Tetrahedra"); ++i) {
            mesh.tets.push_back(read_corners<4>(text, 1));
            if (word == "TetrahedraP2") mesh.on_edges.push_back(read_corners<6>(text, 1));
            mesh.body.push_back(read_number<std::int64_t>(text));
        }
        for (std::int64_t i = 0; i < count && word.starts_with("Triangles"); ++i) {
            mesh.triangles.push_back(read_corners<3>(text, 1));
            if (word == "TrianglesP2") mesh.on_triangle_edges.push_back(read_corners<3>(text, 1));
            mesh.patch.push_back(std::to_string(read_number<std::int64_t>(text)));
        }
    }
    EXPECT_EQ(word, "End");
    return mesh;
}

/// TetGen: three files, each with a line of counts; items begin with their number, from 0.
inline MergedMesh read_tetgen(const std::string& path) {
    MergedMesh mesh;
    const std::string stem = path.substr(0, path.rfind('.'));
    std::istringstream nodes = text_of(path, '#'), elements = text_of(stem + ".ele", '#'),
                       faces = text_of(stem + ".face", '#');
    const auto node_count = read_number<std::int64_t>(nodes);
    EXPECT_EQ((read_corners<3>(nodes, 0)), (GlobalTriangle{3, 0, 0})) << "dimension, attributes, markers";
    for (std::int64_t i = 0; i < node_count; ++i) {
        EXPECT_EQ(read_number<std::int64_t>(nodes), i);
        mesh.points.push_back(read_point(nodes));
    }
    const auto element_count = read_number<std::int64_t>(elements);
    const auto nodes_of_element = read_number<int>(elements);
    EXPECT_TRUE(nodes_of_element == 4 || nodes_of_element == 10);
    EXPECT_EQ(read_number<int>(elements), 1) << "attributes";
    for (std::int64_t i = 0; i < element_count; ++i) {
        EXPECT_EQ(read_number<std::int64_t>(elements), i);
        mesh.tets.push_back(read_corners<4>(elements, 0));
        // As TetGen's -o2 numbers the edges of a single tetrahedron: 23 03 01 12 13 02.
        if (nodes_of_element == 10) read_nodes_on_edges(elements, mesh, {2, 3, 5, 1, 4, 0});
        mesh.body.push_back(read_number<std::int64_t>(elements));
    }
    const auto face_count = read_number<std::int64_t>(faces);
    EXPECT_EQ(read_number<int>(faces), 1) << "markers";
    for (std::int64_t i = 0; i < face_count; ++i) {
        EXPECT_EQ(read_number<std::int64_t>(faces), i);
        mesh.triangles.push_back(read_corners<3>(faces, 0));
        mesh.patch.push_back(std::to_string(read_number<std::int64_t>(faces)));
    }
    std::string rest;
    EXPECT_FALSE(nodes >> rest || elements >> rest || faces >> rest) << rest;
    return mesh;
}

/// SU2: keywords that end with '='; cells begin with their type in VTK and end with their number, points, too.
inline MergedMesh read_su2(const std::string& path) {
    MergedMesh mesh;
    std::istringstream text = text_of(path, '%');
    std::string word, tag;
    std::set<std::string> tags;
    std::int64_t markers = 0;
    while (text >> word) {
        if (word == "MARKER_TAG=") {
            text >> tag;
            EXPECT_TRUE(tags.insert(tag).second) << tag;
            continue;
        }
        const auto count = read_number<std::int64_t>(text);
        if (word == "NDIME=") {
            EXPECT_EQ(count, 3);
        }
        if (word == "NMARK=") markers = count;
        for (std::int64_t i = 0; i < count && word == "NELEM="; ++i) {
            EXPECT_EQ(read_number<int>(text), 10);
            mesh.tets.push_back(read_corners<4>(text, 0));
            EXPECT_EQ(read_number<std::int64_t>(text), i);
        }
        for (std::int64_t i = 0; i < count && word == "NPOIN="; ++i) {
            mesh.points.push_back(read_point(text));
            EXPECT_EQ(read_number<std::int64_t>(text), i);
        }
        if (word == "MARKER_ELEMS=") {
            EXPECT_GT(count, 0) << tag;
        }
        for (std::int64_t i = 0; i < count && word == "MARKER_ELEMS="; ++i) {
            EXPECT_EQ(read_number<int>(text), 5);
            mesh.triangles.push_back(read_corners<3>(text, 0));
            mesh.patch.push_back(tag);
        }
    }
    EXPECT_EQ(static_cast<std::int64_t>(tags.size()), markers);
    return mesh;
}

/// Abaqus input: keyword lines with parameters, data lines with commas. Names do not depend on case.
class AbaqusReader {
 public:
    explicit AbaqusReader(const std::string& path) {
        std::ifstream file(path);
        EXPECT_TRUE(file) << path;
        std::string line;
        while (std::getline(file, line)) {
            if (line.starts_with("**")) continue;
            EXPECT_LE(line.size(), 132U) << line;
            if (line.starts_with("*"))
                start(upper_case(line));
            else
                read(fields_of(line));
        }
        for (const auto& [name, faces] : surfaces_) add_surface(name, faces);
        EXPECT_EQ(node_sets_.at("NALL").size(), mesh_.points.size());
        EXPECT_EQ(element_sets_.at("EALL").size(), mesh_.tets.size());
        read_bodies();
        mesh_.nodes = node_sets_;
        mesh_.nodes.erase("NALL");
    }
    const MergedMesh& mesh() const { return mesh_; }

 private:
    using Fields = std::vector<std::string>;

    static std::string upper_case(std::string text) {
        for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        return text;
    }
    static Fields fields_of(const std::string& line) {
        Fields fields;
        std::istringstream text(line);
        for (std::string field; std::getline(text, field, ',');) {
            field.erase(0, field.find_first_not_of(' '));
            field.erase(field.find_last_not_of(' ') + 1);
            fields.push_back(field);
        }
        EXPECT_LE(fields.size(), 16U) << line;
        return fields;
    }
    std::string parameter(const std::string& name) const {
        for (const std::string& field : fields_of(keyword_line_))
            if (field.starts_with(name + "=")) return field.substr(name.size() + 1);
        return "";
    }
    bool is(const std::string& keyword) const { return fields_of(keyword_line_).front() == keyword; }

    void start(const std::string& line) {
        keyword_line_ = line;
        for (const char* name : {"NSET", "ELSET", "NAME"}) EXPECT_LE(parameter(name).size(), 80U);
        if (is("*ELEMENT")) {
            EXPECT_TRUE(parameter("TYPE") == "C3D4" || parameter("TYPE") == "C3D10");
        }
        if (is("*SURFACE")) {
            EXPECT_TRUE(surfaces_.try_emplace(parameter("NAME")).second) << line;
        }
        if (is("*NSET")) {
            EXPECT_FALSE(node_sets_.contains(parameter("NSET"))) << line;
        }
        if (is("*ELSET")) {
            EXPECT_FALSE(element_sets_.contains(parameter("ELSET"))) << line;
        }
    }
    void read(const Fields& fields) {
        if (is("*NODE")) return read_node(fields);
        if (is("*ELEMENT")) return read_element(fields);
        if (is("*SURFACE")) return surfaces_[parameter("NAME")].push_back({upper_case(fields.at(0)), fields.at(1)});
        const bool is_of_nodes = is("*NSET");
        EXPECT_TRUE(is_of_nodes || is("*ELSET")) << keyword_line_;
        auto& set = is_of_nodes ? node_sets_[parameter("NSET")] : element_sets_[parameter("ELSET")];
        if (keyword_line_.ends_with("GENERATE")) {
            for (std::int64_t i = std::stoll(fields.at(0)); i <= std::stoll(fields.at(1)); ++i) set.insert(i - 1);
            return;
        }
        for (const std::string& field : fields) EXPECT_TRUE(set.insert(std::stoll(field) - 1).second) << "twice";
    }
    void read_node(const Fields& fields) {
        EXPECT_EQ(std::stoull(fields.at(0)), mesh_.points.size() + 1);
        for (std::size_t i = 1; i <= 3; ++i) EXPECT_LE(fields.at(i).size(), 20U) << "more is not read";
        node_sets_[parameter("NSET")].insert(std::stoll(fields[0]) - 1);
        mesh_.points.emplace_back(std::stod(fields[1]), std::stod(fields[2]), std::stod(fields[3]));
    }
    void read_element(const Fields& fields) {
        EXPECT_EQ(std::stoull(fields.at(0)), mesh_.tets.size() + 1);
        const std::string set = parameter("ELSET");
        EXPECT_TRUE(set.starts_with("SUBDOMAIN_")) << set;
        mesh_.part.push_back(std::stoll(set.substr(10)));
        GlobalTet tet;
        for (std::size_t i = 0; i < 4; ++i) tet[i] = std::stoll(fields.at(i + 1)) - 1;
        mesh_.tets.push_back(tet);
        EXPECT_EQ(fields.size(), parameter("TYPE") == "C3D4" ? 5U : 11U);
        if (fields.size() < 11) return;
        std::array<std::int64_t, 6> on_edges;  // 5 to 10 between 1-2, 2-3, 1-3, 1-4, 2-4, 3-4
        for (std::size_t i = 0; i < 6; ++i) on_edges[i] = std::stoll(fields.at(i + 5)) - 1;
        mesh_.on_edges.push_back(on_edges);
    }
    // Every element is in one of BODY_1, BODY_2, ..., or of the regions of test bodies: REGION_0, REGION_1, ...
    void read_bodies() {
        mesh_.body.assign(mesh_.tets.size(), 0);
        const bool has_regions = element_sets_.contains("REGION_0");
        const auto name_of = [&](std::int64_t body) {
            return has_regions ? "REGION_" + std::to_string(body - 1) : "BODY_" + std::to_string(body);
        };
        for (std::int64_t body = 1; element_sets_.contains(name_of(body)); ++body)
            for (const std::int64_t element : element_sets_.at(name_of(body))) {
                std::int64_t& of_element = mesh_.body.at(static_cast<std::size_t>(element));
                EXPECT_EQ(of_element, 0) << "in one body";
                of_element = body;
            }
    }
    void add_surface(const std::string& name, const std::vector<std::array<std::string, 2>>& faces) {
        // S1 to S4 of a tetrahedron, seen from outside.
        static const std::map<std::string, std::array<std::size_t, 3>> corners = {
            {"S1", {0, 2, 1}}, {"S2", {0, 1, 3}}, {"S3", {1, 2, 3}}, {"S4", {2, 0, 3}}};
        EXPECT_FALSE(faces.empty()) << name;
        for (const auto& [set, face] : faces)
            for (const std::int64_t element : element_sets_.at(set)) {
                const GlobalTet& tet = mesh_.tets.at(static_cast<std::size_t>(element));
                const auto& [a, b, c] = corners.at(face);
                mesh_.triangles.push_back({tet[a], tet[b], tet[c]});
                mesh_.patch.push_back(name);
            }
    }

    MergedMesh mesh_;
    std::string keyword_line_;
    std::map<std::string, std::set<std::int64_t>> node_sets_, element_sets_;
    std::map<std::string, std::vector<std::array<std::string, 2>>> surfaces_;
};

inline MergedMesh read_abaqus(const std::string& path) { return AbaqusReader(path).mesh(); }

/// VTU with appended raw arrays, each behind its size.
class VtuReader {
 public:
    explicit VtuReader(const std::string& path) : bytes_(bytes_of_file(path)) {
        const std::string begin = "<AppendedData encoding=\"raw\">\n_";
        data_ = bytes_.find(begin) + begin.size();
        EXPECT_TRUE(bytes_.ends_with("\n</AppendedData>\n</VTKFile>\n"));
    }
    bool has(const std::string& name) const { return bytes_.find(" Name=\"" + name + "\"") < data_; }
    template <class T>
    std::vector<T> values(const std::string& name) {
        const std::size_t element = bytes_.find(" Name=\"" + name + "\"");
        EXPECT_LT(element, data_) << name;
        const std::string offset = " offset=\"";
        const std::size_t at = data_ + std::stoull(bytes_.substr(bytes_.find(offset, element) + offset.size(), 20));
        std::uint64_t size = 0;
        std::memcpy(&size, bytes_.data() + at, sizeof size);
        EXPECT_EQ(size % sizeof(T), 0U);
        std::vector<T> values(size / sizeof(T));
        if (size > 0) std::memcpy(static_cast<void*>(values.data()), bytes_.data() + at + sizeof size, size);
        return values;
    }

 private:
    std::string bytes_;
    std::size_t data_ = 0;
};

inline MergedMesh read_vtu(const std::string& path) {
    VtuReader file(path);
    MergedMesh mesh;
    mesh.points = file.values<Vec3>("Points");
    const auto types = file.values<std::uint8_t>("types");
    const auto offsets = file.values<std::int64_t>("offsets");
    const auto corners = file.values<std::int32_t>("connectivity");
    const auto part = file.values<std::int32_t>("Part"), patch = file.values<std::int32_t>("Patch");
    const auto ids = file.values<std::int64_t>("GlobalVertexId");
    const auto region = file.has("Region") ? file.values<std::int32_t>("Region") : std::vector<std::int32_t>();
    for (std::size_t v = 0; v < ids.size(); ++v) EXPECT_EQ(ids[v], static_cast<std::int64_t>(v));
    std::size_t begin = 0;
    for (std::size_t cell = 0; cell < types.size(); ++cell) {
        const std::int32_t* corner = corners.data() + begin;
        begin = static_cast<std::size_t>(offsets[cell]);
        if (types[cell] == 10) {
            mesh.tets.push_back({corner[0], corner[1], corner[2], corner[3]});
            mesh.part.push_back(part[cell]);
            if (!region.empty()) mesh.body.push_back(region[cell] + 1);
            EXPECT_EQ(patch[cell], -1);
        } else {
            EXPECT_EQ(types[cell], 5);
            mesh.triangles.push_back({corner[0], corner[1], corner[2]});
            mesh.patch.push_back(std::to_string(patch[cell]));
        }
    }
    EXPECT_EQ(begin, corners.size());
    return mesh;
}

}  // namespace kerf::test
