// Small readers of further formats that hold a mesh in one piece, as in merged_readers.h. What is HDF5 is judged by
// programs of others (tests/oracles).
#pragma once

#include <algorithm>
#include <bit>
#include <functional>
#include <regex>

#include "export/merged_readers.h"

namespace kerf::test {

/// Sets the numbers of bodies: "volume" is the first, others end with their number, regions of test bodies count from
/// 0.
inline std::int64_t body_called(const std::string& name) {
    if (name == "volume") return 1;
    const std::int64_t number = std::stoll(name.substr(name.rfind('_') + 1));
    return name.starts_with("region") ? number + 1 : number;
}

/// VTK's legacy format, binary: keywords on lines, big-endian values behind them.
class VtkReader {
 public:
    explicit VtkReader(const std::string& path) : bytes_(bytes_of_file(path)) {
        EXPECT_TRUE(
            bytes_.starts_with("# vtk DataFile Version 3.0\nMesh of Kerf\nBINARY\nDATASET UNSTRUCTURED_GRID\n"));
        read_points();
        read_cells();
        while (at_ < bytes_.size()) {
            std::istringstream line(next_line());
            std::string word;
            line >> word;
            if (word == "FIELD") read_fields(line);
        }
    }
    MergedMesh mesh() {
        MergedMesh mesh = mesh_;
        for (std::size_t cell = 0; cell < ints_["Patch"].size(); ++cell) {
            if (cell >= mesh.tets.size()) {
                mesh.patch.push_back(std::to_string(ints_["Patch"][cell]));
                continue;
            }
            EXPECT_EQ(ints_["Patch"][cell], -1);
            mesh.part.push_back(ints_["Part"][cell]);
            if (ints_.contains("Region")) mesh.body.push_back(ints_["Region"][cell] + 1);
        }
        return mesh;
    }

 private:
    std::string next_line() {
        const std::size_t end = bytes_.find('\n', at_), begin = at_;
        at_ = end + 1;
        return bytes_.substr(begin, end - begin);
    }
    template <class T>
    T next() {
        std::array<char, sizeof(T)> big;
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), sizeof(T), big.rbegin());
        at_ += sizeof(T);
        return std::bit_cast<T>(big);
    }
    std::size_t count_behind(const std::string& keyword) {
        const std::string line = next_line();
        EXPECT_TRUE(line.starts_with(keyword + " ")) << line;
        return std::stoull(line.substr(keyword.size() + 1));
    }
    void end_of_values() { EXPECT_EQ(next_line(), ""); }

    void read_points() {
        const std::size_t count = count_behind("POINTS");
        for (std::size_t i = 0; i < count; ++i) {
            const auto x = next<double>(), y = next<double>(), z = next<double>();
            mesh_.points.emplace_back(x, y, z);
        }
        end_of_values();
    }
    void read_cells() {
        const std::size_t count = count_behind("CELLS");
        std::vector<std::vector<std::int64_t>> cells(count);
        for (auto& cell : cells) {
            cell.resize(static_cast<std::size_t>(next<std::int32_t>()));
            for (std::int64_t& node : cell) node = next<std::int32_t>();
        }
        end_of_values();
        EXPECT_EQ(count_behind("CELL_TYPES"), count);
        for (const auto& cell : cells) add(cell, next<std::int32_t>());
        end_of_values();
    }
    void add(const std::vector<std::int64_t>& n, std::int32_t type) {
        if (type == 10 || type == 24) mesh_.tets.push_back({n.at(0), n.at(1), n.at(2), n.at(3)});
        if (type == 24) mesh_.on_edges.push_back({n.at(4), n.at(5), n.at(6), n.at(7), n.at(8), n.at(9)});
        if (type == 5 || type == 22) mesh_.triangles.push_back({n.at(0), n.at(1), n.at(2)});
        if (type == 22) mesh_.on_triangle_edges.push_back({n.at(3), n.at(4), n.at(5)});
        EXPECT_TRUE(type == 10 || type == 24 || type == 5 || type == 22) << type;
    }
    void read_fields(std::istream& head) {
        std::string name;
        head >> name;
        for (auto count = read_number<int>(head); count-- > 0;) {
            std::istringstream line(next_line());
            std::string type;
            line >> name;
            const auto components = read_number<std::size_t>(line), tuples = read_number<std::size_t>(line);
            line >> type;
            if (type == "int") {
                for (std::size_t i = 0; i < components * tuples; ++i) ints_[name].push_back(next<std::int32_t>());
            } else {
                EXPECT_EQ(type, "unsigned_char");
                at_ += components * tuples;
            }
            end_of_values();
        }
    }

    std::string bytes_;
    std::size_t at_ =
        std::string("# vtk DataFile Version 3.0\nMesh of Kerf\nBINARY\nDATASET UNSTRUCTURED_GRID\n").size();
    MergedMesh mesh_;
    std::map<std::string, std::vector<std::int32_t>> ints_;
};

inline MergedMesh read_vtk(const std::string& path) { return VtkReader(path).mesh(); }

/// I-DEAS universal file: datasets between lines with -1.
class UnvReader {
 public:
    explicit UnvReader(const std::string& path) : text_(path) {
        std::string line;
        while (std::getline(text_, line)) {
            EXPECT_EQ(line, "    -1");
            std::getline(text_, line);
            const int dataset = std::stoi(line);
            while (std::getline(text_, line) && line != "    -1") {
                const std::vector<std::int64_t> numbers = fields_of(line);
                if (dataset == 2411) read_node(numbers);
                if (dataset == 2412) read_element(numbers);
                if (dataset == 2477) read_group(numbers);
            }
        }
    }
    MergedMesh mesh() {
        for (std::size_t label = 1; label <= mesh_.tets.size() + mesh_.triangles.size(); ++label) {
            const std::string& name = group_of_.at(static_cast<std::int64_t>(label));
            if (label <= mesh_.tets.size())
                mesh_.body.push_back(body_called(name));
            else
                mesh_.patch.push_back(name);
        }
        return mesh_;
    }

 private:
    static std::vector<std::int64_t> fields_of(const std::string& line) {
        EXPECT_EQ(line.size() % 10, 0U) << line;
        std::vector<std::int64_t> fields;
        for (std::size_t at = 0; at + 10 <= line.size(); at += 10) fields.push_back(std::stoll(line.substr(at, 10)));
        EXPECT_LE(fields.size(), 8U);
        return fields;
    }
    void read_node(const std::vector<std::int64_t>& head) {
        EXPECT_EQ(head.at(0), static_cast<std::int64_t>(mesh_.points.size()) + 1);
        std::string line;
        std::getline(text_, line);
        EXPECT_EQ(line.size(), 75U);
        std::replace(line.begin(), line.end(), 'D', 'E');
        mesh_.points.emplace_back(std::strtod(line.substr(0, 25).c_str(), nullptr),
                                  std::strtod(line.substr(25, 25).c_str(), nullptr),
                                  std::strtod(line.substr(50, 25).c_str(), nullptr));
    }
    // Nodes of parabolic elements go round a face.
    void read_element(const std::vector<std::int64_t>& head) {
        EXPECT_EQ(head.at(0), static_cast<std::int64_t>(mesh_.tets.size() + mesh_.triangles.size()) + 1);
        const auto size = static_cast<std::size_t>(head.at(5));
        std::vector<std::int64_t> n;
        std::string line;
        while (n.size() < size && std::getline(text_, line))
            for (const std::int64_t label : fields_of(line)) n.push_back(label - 1);
        if (head[1] == 111) mesh_.tets.push_back({n.at(0), n.at(1), n.at(2), n.at(3)});
        if (head[1] == 118) {
            mesh_.tets.push_back({n.at(0), n.at(2), n.at(4), n.at(9)});
            mesh_.on_edges.push_back({n[1], n[3], n[5], n[6], n[7], n[8]});
        }
        if (head[1] == 91) mesh_.triangles.push_back({n.at(0), n.at(1), n.at(2)});
        if (head[1] == 92) {
            mesh_.triangles.push_back({n.at(0), n.at(2), n.at(4)});
            mesh_.on_triangle_edges.push_back({n[1], n[3], n[5]});
        }
    }
    void read_group(const std::vector<std::int64_t>& head) {
        std::string name, line;
        std::getline(text_, name);
        EXPECT_LE(name.size(), 40U);
        for (std::int64_t read = 0; read < head.at(7) && std::getline(text_, line);) {
            const std::vector<std::int64_t> members = fields_of(line);
            for (std::size_t i = 0; i < members.size(); i += 4, ++read) {
                EXPECT_EQ(members[i], 8);
                EXPECT_TRUE(group_of_.emplace(members.at(i + 1), name).second) << "in one group";
            }
        }
    }

    std::ifstream text_;
    MergedMesh mesh_;
    std::map<std::int64_t, std::string> group_of_;
};

inline MergedMesh read_unv(const std::string& path) { return UnvReader(path).mesh(); }

/// FEBio: an element of the XML a line.
inline MergedMesh read_feb(const std::string& path) {
    const std::regex row("<(node|elem|tri3|tri6) id=\"([0-9]+)\">([^<]*)</.*>"),
        group("<(Elements|Surface).* name=\"(.*)\">");
    MergedMesh mesh;
    std::ifstream file(path);
    std::string line, name;
    for (std::smatch match; std::getline(file, line);) {
        if (std::regex_match(line, match, group)) name = match[2];
        if (!std::regex_match(line, match, row)) continue;
        std::vector<double> n;
        std::istringstream numbers(match[3]);
        for (std::string number; std::getline(numbers, number, ',');) n.push_back(std::strtod(number.c_str(), nullptr));
        const auto node = [&](std::size_t i) { return static_cast<std::int64_t>(n.at(i)) - 1; };
        if (match[1] == "node") {
            mesh.points.emplace_back(n.at(0), n.at(1), n.at(2));
            EXPECT_EQ(std::stoull(match[2]), mesh.points.size());
        } else if (match[1] == "elem") {
            mesh.tets.push_back({node(0), node(1), node(2), node(3)});
            mesh.body.push_back(body_called(name));
            if (n.size() == 10) mesh.on_edges.push_back({node(4), node(5), node(6), node(7), node(8), node(9)});
            EXPECT_EQ(std::stoull(match[2]), mesh.tets.size());
        } else {
            mesh.triangles.push_back({node(0), node(1), node(2)});
            mesh.patch.push_back(name);
            if (n.size() == 6) mesh.on_triangle_edges.push_back({node(3), node(4), node(5)});
        }
    }
    return mesh;
}

}  // namespace kerf::test
