// Files of surfaces have the same arrays one after the other, so that each array of the whole is a copy of theirs, but
// for the numbers of vertices, which go on from file to file.
#include "part/joined_surfaces.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>

#include <fmt/format.h>

#include "core/error.h"
#include "core/xml_text.h"
#include "io/checked_file.h"
#include "io/vtk_cell_types.h"
#include "part/vtu_writer.h"

namespace kerf {

namespace {

// An array of each file that is copied as it is.
struct CopiedArray {
    const char* section;  // element of the XML
    const char* type;
    const char* name;
    int components;
    std::int64_t item_bytes;
};
constexpr std::array<CopiedArray, 6> copied_arrays = {{{"PointData", "Int64", "GlobalVertexId", 1, 8},
                                                       {"CellData", "Int32", "Part", 1, 4},
                                                       {"CellData", "Int32", "Patch", 1, 4},
                                                       {"CellData", "Int32", "Facet", 1, 4},
                                                       {"CellData", "Int32", "Neighbour", 1, 4},
                                                       {"Points", "Float64", "Points", 3, 8}}};

constexpr const char* file_head =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";

constexpr std::int64_t bytes_at_once = std::int64_t{1} << 18;  // bytes; whole values of every type

struct Piece {
    std::string path;
    VtuHeader header;
};

Piece open_piece(const std::string& path) {
    CheckedFile file(path, "rb");
    return {path, parse_vtu_header(file.read(vtu_header_limit), path)};
}

// Calls take(bytes) with the values of an array of the file, some at a time.
template <class Take>
void read_array(const Piece& piece, const std::string& name, std::int64_t item_bytes, Take take) {
    const VtuHeader::Array* array = piece.header.find(name);
    if (!array) fail_damaged_vtu(piece.path, fmt::format("it has no array {}", name));
    CheckedFile file(piece.path, "rb");
    file.seek(array->position + static_cast<std::int64_t>(sizeof(std::uint64_t)));
    for (std::int64_t left = array->components * array->tuples * item_bytes; left > 0;) {
        const std::string bytes = file.read(static_cast<std::size_t>(std::min(left, bytes_at_once)));
        if (static_cast<std::int64_t>(bytes.size()) != std::min(left, bytes_at_once))
            fail_damaged_vtu(piece.path, "it ends too early");
        take(bytes);
        left -= static_cast<std::int64_t>(bytes.size());
    }
}

struct JoinedArray {
    const char* section;
    const char* type;
    std::string name;
    int components;
    std::int64_t tuples, item_bytes;
    std::function<void(CheckedFile&)> write_values;

    std::int64_t bytes() const { return components * tuples * item_bytes; }
};

class JoinedSurfaces {
 public:
    explicit JoinedSurfaces(const std::vector<std::string>& paths) {
        for (const std::string& path : paths) {
            pieces_.push_back(open_piece(path));
            points_ += pieces_.back().header.point_count;
            cells_ += pieces_.back().header.cell_count;
        }
    }

    void write(const std::string& path) const {
        const std::vector<JoinedArray> all = arrays();
        CheckedFile file(path, "wb");
        file.write(head(all));
        for (const JoinedArray& array : all) {
            const auto bytes = static_cast<std::uint64_t>(array.bytes());
            file.write(&bytes, sizeof bytes);
            array.write_values(file);
        }
        file.write("\n</AppendedData>\n</VTKFile>\n");
        file.close();
    }

 private:
    // In the order of the file.
    std::vector<JoinedArray> arrays() const {
        std::vector<JoinedArray> all;
        const VtuHeader::Array* names = pieces_.front().header.find("PatchNames");
        all.push_back({"FieldData", "UInt8", "PatchNames", 1, names ? names->tuples : 0, 1, [this](CheckedFile& file) {
                           read_array(pieces_.front(), "PatchNames", 1, [&](const std::string& b) { file.write(b); });
                       }});
        for (const CopiedArray& copied : copied_arrays)
            all.push_back({copied.section, copied.type, copied.name, copied.components,
                           std::string_view(copied.section) == "CellData" ? cells_ : points_, copied.item_bytes,
                           [this, &copied](CheckedFile& file) {
                               for (const Piece& piece : pieces_)
                                   read_array(piece, copied.name, copied.item_bytes,
                                              [&](const std::string& bytes) { file.write(bytes); });
                           }});
        all.push_back({"Cells", "Int64", "connectivity", 1, 3 * cells_, 8,
                       [this](CheckedFile& file) { write_connectivity(file); }});
        all.push_back({"Cells", "Int64", "offsets", 1, cells_, 8, [this](CheckedFile& file) {
                           write_computed<std::int64_t>(file, [](std::int64_t cell) { return 3 * (cell + 1); });
                       }});
        all.push_back({"Cells", "UInt8", "types", 1, cells_, 1, [this](CheckedFile& file) {
                           write_computed<std::uint8_t>(file, [](std::int64_t) { return vtk_triangle; });
                       }});
        return all;
    }

    std::string head(std::span<const JoinedArray> all) const {
        std::string xml = fmt::format(file_head, "UnstructuredGrid") + "<UnstructuredGrid>\n";
        std::int64_t offset = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const JoinedArray& array = all[i];
            const std::string_view section = array.section;
            if (i == 0 || section != all[i - 1].section) xml += fmt::format("<{}>\n", section);
            xml += fmt::format(
                "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" "
                "format=\"appended\" offset=\"{}\"/>\n",
                array.type, array.name, array.components, array.tuples, offset);
            if (section == "FieldData")
                xml += fmt::format(
                    "<DataArray type=\"Int64\" Name=\"BoundaryVertexCount\" NumberOfTuples=\"1\" "
                    "format=\"ascii\">{}</DataArray>\n",
                    points_);
            if (i + 1 == all.size() || section != all[i + 1].section) xml += fmt::format("</{}>\n", section);
            if (i == 0) xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points_, cells_);
            offset += static_cast<std::int64_t>(sizeof(std::uint64_t)) + array.bytes();
        }
        return xml + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    }

    void write_connectivity(CheckedFile& file) const {
        std::int64_t before = 0;  // vertices of the pieces before
        std::vector<std::int64_t> numbers;
        for (const Piece& piece : pieces_) {
            read_array(piece, "connectivity", sizeof(std::int32_t), [&](const std::string& bytes) {
                numbers.clear();
                for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::int32_t)) {
                    std::int32_t vertex = 0;
                    bytes.copy(reinterpret_cast<char*>(&vertex), sizeof vertex, at);
                    numbers.push_back(before + vertex);
                }
                file.write(numbers.data(), numbers.size() * sizeof(std::int64_t));
            });
            before += piece.header.point_count;
        }
    }

    // value(0), value(1), ... of the cells.
    template <class T, class Value>
    void write_computed(CheckedFile& file, const Value& value) const {
        std::vector<T> values;
        for (std::int64_t cell = 0; cell < cells_;) {
            values.clear();
            for (; cell < cells_ && static_cast<std::int64_t>(values.size()) < bytes_at_once; ++cell)
                values.push_back(static_cast<T>(value(cell)));
            file.write(values.data(), values.size() * sizeof(T));
        }
    }

    std::vector<Piece> pieces_;
    std::int64_t points_ = 0, cells_ = 0;
};

}  // namespace

std::string surfaces_pvtu_text(const std::vector<std::string>& pieces) {
    std::string xml = fmt::format(file_head, "PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n";
    for (std::size_t i = 0; i < copied_arrays.size(); ++i) {
        const CopiedArray& array = copied_arrays[i];
        const std::string_view section = array.section;
        if (i == 0 || section != copied_arrays[i - 1].section) xml += fmt::format("<P{}>\n", section);
        xml += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", array.type, array.name,
                           array.components);
        if (i + 1 == copied_arrays.size() || section != copied_arrays[i + 1].section)
            xml += fmt::format("</P{}>\n", section);
    }
    for (const std::string& piece : pieces) xml += fmt::format("<Piece Source=\"{}\"/>\n", xml_text(piece));
    return xml + "</PUnstructuredGrid>\n</VTKFile>\n";
}

void write_joined_surfaces(const std::string& path, const std::vector<std::string>& pieces) {
    JoinedSurfaces(pieces).write(path);
}

}  // namespace kerf
