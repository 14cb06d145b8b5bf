#include "support/surface_files.h"

#include <zlib.h>

#include <sstream>
#include <stdexcept>

namespace kerf::test {

namespace {

std::ostringstream precise_stream() {
    std::ostringstream out;
    out.precision(17);
    return out;
}

// Of the patch of a facet.
std::string reference(const Soup& soup, std::size_t facet) { return std::to_string(10 - soup.patch[facet]); }

std::string ply_header(const Soup& soup, const std::string& format) {
    return "ply\nformat " + format + " 1.0\ncomment made by a test\nelement vertex " +
           std::to_string(soup.vertices.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nelement face " +
           std::to_string(soup.facets.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

// Numbers as text or bytes.
class MshText {
 public:
    explicit MshText(const MshStyle& style) : style_(style) { out_.precision(17); }
    MshText& text(const std::string& text) {
        out_ << text;
        return *this;
    }
    MshText& integer(std::int32_t value) { return number(value); }
    MshText& size(std::size_t value) { return number(static_cast<std::int64_t>(value)); }
    MshText& real(double value) { return number(value); }
    /// A line of text ends; between numbers of a binary file there are none.
    MshText& end_line() { return style_.is_binary ? *this : text("\n"); }
    bool is_binary() const { return style_.is_binary; }
    std::string bytes() const { return out_.str(); }

 private:
    template <class Number>
    MshText& number(Number value) {
        std::string raw;
        append(raw, value, style_.is_big_endian);
        style_.is_binary ? out_ << raw : out_ << value << ' ';
        return *this;
    }

    MshStyle style_;
    std::ostringstream out_;
};

std::string base64_of(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = i; k < i + 3; ++k) group = group << 8 | (k < bytes.size() ? std::uint8_t(bytes[k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string block(size, '\0');
    if (compress(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size()) != Z_OK)
        throw std::runtime_error("zlib compresses no block");
    return block.substr(0, size);
}

// One piece of VTU, array by array.
class VtuText {
 public:
    explicit VtuText(const VtuStyle& style, const std::string& kind = "UnstructuredGrid") : style_(style), kind_(kind) {
        text_.precision(17);
    }
    void begin() {
        text_ << "<?xml version=\"1.0\"?>\n<!-- a > b -->\n<VTKFile type=\"" << kind_
              << "\" version=\"1.0\" byte_order='" << (style_.is_big_endian ? "Big" : "Little") << "Endian'"
              << (style_.has_long_headers ? " header_type=\"UInt64\"" : "")
              << (is_compressed() ? " compressor=\"vtkZLibDataCompressor\"" : "") << ">\n<" << kind_ << ">\n";
    }
    /// Begins the piece with these attributes of numbers.
    void begin_piece(const std::vector<std::pair<std::string, std::size_t>>& numbers) {
        text_ << "<Piece";
        for (const auto& [name, number] : numbers) text_ << " NumberOf" << name << "=\"" << number << "\"";
        text_ << ">\n";
    }
    template <class Write>
    void section(const std::string& name, const Write& write) {
        text_ << "<" << name << ">\n";
        write();
        text_ << "</" << name << ">\n";
    }
    /// In a section of its own unless that has no name.
    template <class Value>
    void array(const std::string& section_name, const std::string& type, const std::string& name,
               const std::vector<Value>& values) {
        if (!section_name.empty()) return section(section_name, [&] { array("", type, name, values); });
        text_ << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
              << (name == "Points" ? 3 : 1) << "\" format=\"";
        using enum VtuStyle::Values;
        if (style_.values == text) {
            text_ << "ascii\">\n";
            for (const Value& value : values) text_ << +value << " ";
        } else if (style_.values == base64 || style_.values == compressed_base64) {
            text_ << "binary\">\n" << encoded(values, true);
        } else {
            text_ << "appended\" offset=\"" << appended_.size() << "\">";
            appended_ += encoded(values, style_.values == appended_base64);
        }
        text_ << "</DataArray>\n";
    }
    std::string finish() {
        text_ << "</Piece>\n</" << kind_ << ">\n";
        if (!appended_.empty())
            text_ << "<AppendedData encoding=\""
                  << (style_.values == VtuStyle::Values::appended_base64 ? "base64" : "raw") << "\">\n_" << appended_
                  << "</AppendedData>\n";
        text_ << "</VTKFile>\n";
        return text_.str();
    }

 private:
    bool is_compressed() const {
        return style_.values == VtuStyle::Values::compressed_base64 ||
               style_.values == VtuStyle::Values::compressed_appended;
    }
    std::string size(std::size_t value) const {
        std::string bytes;
        if (style_.has_long_headers)
            append(bytes, std::uint64_t{value}, style_.is_big_endian);
        else
            append(bytes, static_cast<std::uint32_t>(value), style_.is_big_endian);
        return bytes;
    }
    // Compressed in blocks of 256 bytes. Header and data are one text if there is no compression, else two.
    template <class Value>
    std::string encoded(const std::vector<Value>& values, bool as_base64) const {
        std::string bytes;
        for (const Value& value : values) append(bytes, value, style_.is_big_endian);
        const auto encode = [&](const std::string& raw) { return as_base64 ? base64_of(raw) : raw; };
        if (!is_compressed()) return encode(size(bytes.size()) + bytes);
        constexpr std::size_t block_size = 256;
        std::string sizes, blocks;
        for (std::size_t begin = 0; begin < bytes.size(); begin += block_size) {
            const std::string block = deflated(bytes.substr(begin, block_size));
            sizes += size(block.size());
            blocks += block;
        }
        const std::size_t count = (bytes.size() + block_size - 1) / block_size;
        return encode(size(count) + size(block_size) + size(bytes.size() % block_size) + sizes) + encode(blocks);
    }

    VtuStyle style_;
    std::string kind_;
    std::ostringstream text_;
    std::string appended_;
};

std::int32_t node_tag(std::size_t vertex) { return 1000000 - 7 * static_cast<std::int32_t>(vertex); }

void write_element_2(MshText& out, int number, int type, int patch, const std::vector<std::int32_t>& nodes) {
    if (out.is_binary())
        out.integer(type).integer(1).integer(2).integer(number);
    else
        out.integer(number).integer(type).integer(2);
    out.integer(10 - patch).integer(5 + patch);
    for (const std::int32_t v : nodes) out.integer(node_tag(v));
    out.end_line();
}

void write_tet_2(MshText& out, const Tetrahedron& tet) { write_element_2(out, 3, 4, 0, {tet.begin(), tet.end()}); }

void write_msh2(const Soup& soup, const std::vector<Tetrahedron>& tets, MshText& out) {
    out.text("$Nodes\n" + std::to_string(soup.vertices.size()) + "\n");
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
        out.integer(node_tag(v));
        for (const double x : soup.vertices[v]) out.real(x);
        out.end_line();
    }
    out.text("\n$EndNodes\n$Elements\n" + std::to_string(soup.facets.size() + 2 + tets.size()) + "\n");
    write_element_2(out, 1, 15, 0, {0});
    write_element_2(out, 2, 1, 0, {0, 1});
    for (std::size_t f = 0; f < std::max(soup.facets.size(), std::size_t{3}); ++f) {
        if (f == 1 && !tets.empty()) write_tet_2(out, tets.front());
        if (f == 2)
            for (std::size_t t = 1; t < tets.size(); ++t) write_tet_2(out, tets[t]);
        if (f >= soup.facets.size()) continue;
        const Triangle& t = soup.facets[f];
        write_element_2(out, static_cast<int>(f + 5), 2, soup.patch[f], {t[0], t[1], t[2]});
    }
    out.text("\n$EndElements\n");
}

void write_entities_41(const Soup& soup, MshText& out) {
    out.text("$Entities\n").size(1).size(1).size(soup.patch_names.size()).size(1).end_line();
    out.integer(1).real(0).real(0).real(0).size(0).end_line();
    const auto write_box = [&] {
        for (int i = 0; i < 6; ++i) out.real(0.5);
    };
    out.integer(1);
    write_box();
    out.size(1).integer(-3).size(2).integer(1).integer(-1).end_line();
    for (std::size_t p = 0; p < soup.patch_names.size(); ++p) {
        out.integer(static_cast<int>(5 + p));
        write_box();
        out.size(2).integer(-static_cast<int>(10 - p)).integer(99).size(1).integer(1).end_line();
    }
    out.integer(1);
    write_box();
    out.size(1).integer(10).size(1).integer(5).text("\n$EndEntities\n");
}

// Two blocks: the first vertex on a curve with a parameter, the others inside.
void write_nodes_41(const Soup& soup, MshText& out) {
    const std::size_t count = soup.vertices.size();
    out.text("$Nodes\n").size(2).size(count).size(1).size(1000000).end_line();
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
        const std::size_t last = first == 0 ? 1 : count;
        out.integer(first == 0 ? 1 : 3).integer(1).integer(first == 0).size(last - first).end_line();
        for (std::size_t v = first; v < last; ++v) out.size(node_tag(v)).end_line();
        for (std::size_t v = first; v < last; ++v) {
            for (const double x : soup.vertices[v]) out.real(x);
            if (first == 0) out.real(0.25);
            out.end_line();
        }
    }
    out.text("\n$EndNodes\n");
}

void write_block_41(MshText& out, int dimension, int entity, int type,
                    const std::vector<std::vector<std::int32_t>>& elements) {
    out.integer(dimension).integer(entity).integer(type).size(elements.size()).end_line();
    for (const std::vector<std::int32_t>& nodes : elements) {
        out.size(1);
        for (const std::int32_t v : nodes) out.size(node_tag(v));
        out.end_line();
    }
}

// A block for every run of facets of one patch, so that the order stays.
void write_elements_41(const Soup& soup, const std::vector<Tetrahedron>& tets, MshText& out) {
    std::vector<std::size_t> runs;
    for (std::size_t f = 0; f <= soup.facets.size(); ++f)
        if (f == 0 || f == soup.facets.size() || soup.patch[f] != soup.patch[f - 1]) runs.push_back(f);
    out.text("$Elements\n").size(runs.size() + 2).size(soup.facets.size() + 2 + tets.size()).size(1).size(1).end_line();
    write_block_41(out, 0, 1, 15, {{0}});
    write_block_41(out, 1, 1, 1, {{0, 1}});
    std::vector<std::vector<std::int32_t>> cells;
    for (const Tetrahedron& tet : tets) cells.emplace_back(tet.begin(), tet.end());
    write_block_41(out, 3, 1, 4, cells);
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
        std::vector<std::vector<std::int32_t>> triangles;
        for (std::size_t f = runs[r]; f < runs[r + 1]; ++f)
            triangles.emplace_back(soup.facets[f].begin(), soup.facets[f].end());
        write_block_41(out, 2, 5 + soup.patch[runs[r]], 2, triangles);
    }
    out.text("\n$EndElements\n");
}

void write_msh41(const Soup& soup, const std::vector<Tetrahedron>& tets, MshText& out) {
    write_entities_41(soup, out);
    write_nodes_41(soup, out);
    write_elements_41(soup, tets, out);
}

}  // namespace

std::string to_binary_stl(const Soup& soup, std::string header) {
    header.resize(80, ' ');
    append(header, static_cast<std::uint32_t>(soup.facets.size()));
    for (const Triangle& t : soup.facets) {
        for (int i = 0; i < 3; ++i) append(header, 0.0f);
        for (std::int32_t v : t)
            for (int i = 0; i < 3; ++i) append(header, static_cast<float>(soup.vertices[v][i]));
        append(header, std::uint16_t{0});
    }
    return header;
}

std::string to_ascii_stl(const Soup& soup) {
    auto out = precise_stream();
    for (std::size_t patch = 0; patch < soup.patch_names.size(); ++patch) {
        out << "solid " << soup.patch_names[patch] << "\n";
        for (std::size_t f = 0; f < soup.facets.size(); ++f) {
            if (soup.patch[f] != static_cast<std::int32_t>(patch)) continue;
            out << "facet normal 0 0 0\nouter loop\n";
            for (std::int32_t v : soup.facets[f]) out << "vertex " << soup.vertices[v].transpose() << "\n";
            out << "endloop\nendfacet\n";
        }
        out << "endsolid " << soup.patch_names[patch] << "\n";
    }
    return out.str();
}

std::string to_obj(const Soup& soup) {
    auto out = precise_stream();
    for (const Vec3& p : soup.vertices) out << "v " << p.transpose() << "\n";
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (f == 0 || soup.patch[f] != soup.patch[f - 1]) out << "g " << soup.patch_names[soup.patch[f]] << "\n";
        const Triangle& t = soup.facets[f];
        out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
    }
    return out.str();
}

std::string to_off(const Soup& soup) {
    auto out = precise_stream();
    out << "OFF\n" << soup.vertices.size() << " " << soup.facets.size() << " 0\n";
    for (const Vec3& p : soup.vertices) out << p.transpose() << "\n";
    for (const Triangle& t : soup.facets) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    return out.str();
}

std::string to_medit(const Soup& soup, const std::vector<Tetrahedron>& tets) {
    auto out = precise_stream();
    out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << soup.vertices.size() << "\n";
    for (const Vec3& p : soup.vertices) out << p.transpose() << " 0\n";
    out << "Corners 1\n1\nTriangles\n" << soup.facets.size() << "\n";
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        for (std::int32_t v : soup.facets[f]) out << v + 1 << " ";
        out << reference(soup, f) << "\n";
    }
    out << "Tetrahedra\n" << tets.size() << "\n";
    for (const auto& [a, b, c, d] : tets) out << a + 1 << " " << b + 1 << " " << c + 1 << " " << d + 1 << " 0\n";
    out << "End\n";
    return out.str();
}

std::string to_node_list(const Soup& soup, int first) {
    auto out = precise_stream();
    out << "# nodes\n" << soup.vertices.size() << " 3 1 0\n";
    for (std::size_t v = 0; v < soup.vertices.size(); ++v)
        out << v + first << " " << soup.vertices[v].transpose() << " 0.5\n";
    return out.str();
}

std::string to_facet_list(const Soup& soup, int first, bool is_poly) {
    std::ostringstream out;
    out << soup.facets.size() << " 1\n";
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (is_poly) out << "1 0 " << reference(soup, f) << "\n";
        out << 3;
        for (std::int32_t v : soup.facets[f]) out << " " << v + first;
        out << (is_poly ? "" : " " + reference(soup, f)) << " # facet\n";
    }
    out << "1\n1 0.5 0.5 0.5\n1\n1 0.1 0.1 0.1 7 0.01\n";
    return out.str();
}

std::string to_tetgen(const Soup& soup, int first, bool is_poly) {
    return to_node_list(soup, first) + to_facet_list(soup, first, is_poly);
}

std::string to_ascii_ply(const Soup& soup) {
    auto out = precise_stream();
    out << ply_header(soup, "ascii");
    for (const Vec3& p : soup.vertices) out << p.transpose() << " 255\n";
    for (const Triangle& t : soup.facets) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    return out.str();
}

std::string to_binary_ply(const Soup& soup, bool big_endian) {
    std::string bytes = ply_header(soup, big_endian ? "binary_big_endian" : "binary_little_endian");
    for (const Vec3& p : soup.vertices) {
        for (int i = 0; i < 3; ++i) append(bytes, p[i], big_endian);
        append(bytes, std::uint8_t{255});
    }
    for (const Triangle& t : soup.facets) {
        append(bytes, std::uint8_t{3});
        for (std::int32_t v : t) append(bytes, v, big_endian);
    }
    return bytes;
}

std::string to_msh(const Soup& soup, const MshStyle& style, const std::vector<Tetrahedron>& tets) {
    MshText out(style);
    out.text(style.is_msh41 ? "$MeshFormat\n4.1 " : "$MeshFormat\n2.2 ").text(style.is_binary ? "1 8\n" : "0 8\n");
    if (style.is_binary) out.integer(1);
    out.text("\n$EndMeshFormat\n$PhysicalNames\n").text(std::to_string(soup.patch_names.size() + 1) + "\n");
    for (std::size_t p = 0; p < soup.patch_names.size(); ++p)
        out.text("2 " + std::to_string(10 - p) + " \"" + soup.patch_names[p] + "\"\n");
    out.text("3 10 \"volume\"\n$EndPhysicalNames\n");
    style.is_msh41 ? write_msh41(soup, tets, out) : write_msh2(soup, tets, out);
    return out.bytes();
}

std::string to_element_list(const std::vector<Tetrahedron>& tets, int first) {
    std::ostringstream out;
    out << tets.size() << " 4 1 # elements\n";
    for (std::size_t t = 0; t < tets.size(); ++t) {
        out << static_cast<int>(t) + first;
        for (const std::int32_t v : tets[t]) out << " " << v + first;
        out << " 7\n";
    }
    return out.str();
}

std::string to_vtu(const Soup& soup, const std::vector<Tetrahedron>& tets, const VtuStyle& style,
                   const std::vector<std::int32_t>& neighbours) {
    std::vector<double> points;
    for (const Vec3& p : soup.vertices) points.insert(points.end(), p.begin(), p.end());
    std::vector<std::int64_t> corners, ends;
    std::vector<std::uint8_t> types;
    const auto add = [&](std::uint8_t type, const auto& cell) {
        corners.insert(corners.end(), cell.begin(), cell.end());
        ends.push_back(static_cast<std::int64_t>(corners.size()));
        types.push_back(type);
    };
    for (const Tetrahedron& tet : tets) add(10, tet);
    add(3, UndirectedEdge{0, 1});
    for (const Triangle& facet : soup.facets) add(5, facet);
    VtuText out(style);
    out.begin();
    out.begin_piece({{"Points", soup.vertices.size()}, {"Cells", types.size()}});
    out.array("Points", "Float64", "Points", points);
    out.section("Cells", [&] {
        out.array("", "Int64", "connectivity", corners);
        out.array("", "Int64", "offsets", ends);
        out.array("", "UInt8", "types", types);
    });
    std::vector<std::int32_t> of_cells(types.size() - soup.facets.size(), -1);
    of_cells.insert(of_cells.end(), neighbours.begin(), neighbours.end());
    if (!neighbours.empty()) out.array("CellData", "Int32", "Neighbour", of_cells);
    return out.finish();
}

namespace {

std::vector<double> coordinates_of(const Soup& soup) {
    std::vector<double> coordinates;
    for (const Vec3& p : soup.vertices) coordinates.insert(coordinates.end(), p.begin(), p.end());
    return coordinates;
}

// The names of the patches, each with a zero byte behind it.
std::vector<std::uint8_t> bytes_of_names(const Soup& soup) {
    std::vector<std::uint8_t> bytes;
    for (const std::string& name : soup.patch_names)
        bytes.insert(bytes.end(), name.c_str(), name.c_str() + name.size() + 1);
    return bytes;
}

}  // namespace

std::string to_vtp(const Soup& soup, const VtuStyle& style) {
    std::vector<std::int64_t> corners, ends;
    for (const Triangle& facet : soup.facets) {
        corners.insert(corners.end(), facet.begin(), facet.end());
        ends.push_back(static_cast<std::int64_t>(corners.size()));
    }
    std::vector<std::int32_t> patch = {-1};  // of the line
    patch.insert(patch.end(), soup.patch.begin(), soup.patch.end());
    VtuText out(style, "PolyData");
    out.begin();
    out.array("FieldData", "UInt8", "PatchNames", bytes_of_names(soup));
    out.begin_piece({{"Points", soup.vertices.size()}, {"Lines", 1}, {"Polys", soup.facets.size()}});
    out.array("Points", "Float64", "Points", coordinates_of(soup));
    out.section("Lines", [&] {
        out.array("", "Int64", "connectivity", std::vector<std::int64_t>{0, 1});
        out.array("", "Int64", "offsets", std::vector<std::int64_t>{2});
    });
    out.section("Polys", [&] {
        out.array("", "Int64", "connectivity", corners);
        out.array("", "Int64", "offsets", ends);
    });
    out.array("CellData", "Int32", "Patch", patch);
    return out.finish();
}

namespace {

using VtkCells = std::vector<std::vector<std::int32_t>>;

// Writes numbers as text or as big-endian bytes.
class VtkText {
 public:
    explicit VtkText(const VtkStyle& style) : style_(style) {
        text_.precision(17);
        text_ << "# vtk DataFile Version " << (style.is_version_5 ? "5.1" : "3.0") << "\na title\n"
              << (style.is_binary ? "BINARY" : "ASCII") << "\nDATASET "
              << (style.is_grid ? "UNSTRUCTURED_GRID" : "POLYDATA") << "\n";
    }
    void line(const std::string& text) { text_ << text << "\n"; }
    template <class Value>
    void values(const std::vector<Value>& values) {
        std::string bytes;
        for (const Value& value : values)
            if (style_.is_binary)
                append(bytes, value, true);
            else
                text_ << +value << " ";
        text_ << bytes << "\n";
    }
    void cells(const std::string& keyword, const VtkCells& cells) {
        std::vector<std::int32_t> counted;
        std::vector<std::int64_t> ends = {0}, corners;
        for (const auto& cell : cells) {
            counted.push_back(static_cast<std::int32_t>(cell.size()));
            counted.insert(counted.end(), cell.begin(), cell.end());
            corners.insert(corners.end(), cell.begin(), cell.end());
            ends.push_back(static_cast<std::int64_t>(corners.size()));
        }
        if (!style_.is_version_5) {
            line(keyword + " " + std::to_string(cells.size()) + " " + std::to_string(counted.size()));
            return values(counted);
        }
        line(keyword + " " + std::to_string(ends.size()) + " " + std::to_string(corners.size()));
        line("OFFSETS vtktypeint64");
        values(ends);
        line("CONNECTIVITY vtktypeint64");
        values(corners);
    }
    std::string finish() const { return text_.str(); }

 private:
    VtkStyle style_;
    std::ostringstream text_;
};

void write_grid_cells(const Soup& soup, const std::vector<Tetrahedron>& tets, VtkText& out) {
    VtkCells cells = {{0, 1}};
    std::vector<std::int32_t> types = {3};
    for (const Tetrahedron& tet : tets) cells.emplace_back(tet.begin(), tet.end());
    types.insert(types.end(), tets.size(), 10);
    for (const Triangle& facet : soup.facets) cells.emplace_back(facet.begin(), facet.end());
    types.insert(types.end(), soup.facets.size(), 5);
    out.cells("CELLS", cells);
    out.line("CELL_TYPES " + std::to_string(types.size()));
    out.values(types);
}

}  // namespace

std::string to_vtk(const Soup& soup, const VtkStyle& style, const std::vector<Tetrahedron>& tets) {
    VtkText out(style);
    out.line("POINTS " + std::to_string(soup.vertices.size()) + " double");
    out.values(coordinates_of(soup));
    if (style.is_grid) {
        write_grid_cells(soup, tets, out);
    } else {
        VtkCells triangles;
        for (const Triangle& facet : soup.facets) triangles.emplace_back(facet.begin(), facet.end());
        out.cells("LINES", {{0, 1}});
        out.cells("POLYGONS", triangles);
    }
    std::vector<std::int32_t> patch(1 + (style.is_grid ? tets.size() : 0), -1);
    patch.insert(patch.end(), soup.patch.begin(), soup.patch.end());
    const std::vector<std::uint8_t> names = bytes_of_names(soup);
    out.line("FIELD FieldData 1");
    out.line("PatchNames 1 " + std::to_string(names.size()) + " unsigned_char");
    out.values(names);
    out.line("CELL_DATA " + std::to_string(patch.size()));
    out.line("SCALARS Patch int 1");
    out.line("LOOKUP_TABLE default");
    out.values(patch);
    return out.finish();
}

std::vector<SurfaceFile> to_all_mesh_formats(const Soup& boundary, const std::vector<Tetrahedron>& tets) {
    std::vector<SurfaceFile> files = {{"medit.mesh", to_medit(boundary, tets)}};
    for (const bool is_msh41 : {false, true})
        for (const MshStyle& style :
             {MshStyle{is_msh41, false, false}, {is_msh41, true, false}, {is_msh41, true, true}})
            files.push_back({std::string(is_msh41 ? "msh41" : "msh22") + (style.is_binary ? "_binary" : "_text") +
                                 (style.is_big_endian ? "_big.msh" : ".msh"),
                             to_msh(boundary, style, tets)});
    using enum VtuStyle::Values;
    for (const auto values : {text, base64, compressed_base64, appended, compressed_appended, appended_base64})
        for (const bool is_big_endian : {false, true})
            files.push_back({"vtu_" + std::to_string(static_cast<int>(values)) + (is_big_endian ? "_big.vtu" : ".vtu"),
                             to_vtu(boundary, tets, {values, is_big_endian, !is_big_endian})});
    for (const VtkStyle& style :
         {VtkStyle{false, false, true}, {true, false, true}, {false, true, true}, {true, true, true}})
        files.push_back({std::string(style.is_binary ? "binary" : "text") + (style.is_version_5 ? "_5.vtk" : "_3.vtk"),
                         to_vtk(boundary, style, tets)});
    return files;
}

std::vector<SurfaceFile> to_all_formats(const Soup& soup) {
    std::vector<SurfaceFile> files = {{"binary.stl", to_binary_stl(soup)},
                                      {"ascii.stl", to_ascii_stl(soup)},
                                      {"groups.obj", to_obj(soup)},
                                      {"plain.off", to_off(soup)},
                                      {"ascii.ply", to_ascii_ply(soup)},
                                      {"little.ply", to_binary_ply(soup, false)},
                                      {"big.ply", to_binary_ply(soup, true)},
                                      {"medit.mesh", to_medit(soup)},
                                      {"tetgen.smesh", to_tetgen(soup, 0, false)},
                                      {"tetgen.poly", to_tetgen(soup, 1, true)}};
    for (const bool is_msh41 : {false, true}) {
        const std::string version = is_msh41 ? "msh41" : "msh22";
        files.push_back({version + "_ascii.msh", to_msh(soup, {is_msh41, false, false})});
        files.push_back({version + "_little.msh", to_msh(soup, {is_msh41, true, false})});
        files.push_back({version + "_big.msh", to_msh(soup, {is_msh41, true, true})});
    }
    for (const bool is_binary : {false, true})
        for (const bool is_version_5 : {false, true})
            files.push_back({std::string(is_binary ? "binary" : "text") + (is_version_5 ? "_5.vtk" : "_3.vtk"),
                             to_vtk(soup, {is_binary, is_version_5})});
    using enum VtuStyle::Values;
    files.push_back({"text.vtp", to_vtp(soup, {text})});
    files.push_back({"appended.vtp", to_vtp(soup, {compressed_appended, true, true})});
    return files;
}

}  // namespace kerf::test
