// A VTU file is an XML header, then the arrays as raw bytes, each behind its size as a UInt64; the header names the
// offset of each array. So a grid is described here as a table of arrays, each with a function that streams its values:
// the header follows from the sizes alone, and of the quality measures all but one wait as a whole until they are
// written.
//
// The cells are the tetrahedra, then the boundary triangles. A grid without tetrahedra is a part's surface.
#include "part/vtu_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <functional>
#include <limits>
#include <memory>
#include <system_error>

#include "core/error.h"
#include "core/xml_text.h"
#include "io/checked_file.h"
#include "io/text_file.h"
#include "io/vtk_cell_types.h"

namespace kerf {

namespace {

static_assert(std::endian::native == std::endian::little, "The writer stores values as they lie in memory.");

template <class T>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";
template <>
constexpr const char* vtk_type<std::int8_t> = "Int8";
template <>
constexpr const char* vtk_type<std::int16_t> = "Int16";
template <>
constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
constexpr const char* vtk_type<float> = "Float32";
template <>
constexpr const char* vtk_type<double> = "Float64";

struct Array {
    std::string name;
    std::string type;
    int components;
    std::size_t tuples;
    std::uint64_t bytes;
    std::function<void(CheckedFile&)> write_values;
};

// The element of VTK's XML and the arrays in it.
struct Section {
    std::string element;
    std::vector<Array> arrays;
};

struct Grid {
    std::size_t point_count, cell_count, boundary_vertex_count;
    Section field_data{"FieldData", {}};
    std::array<Section, 4> piece{{{"PointData", {}}, {"CellData", {}}, {"Points", {}}, {"Cells", {}}}};

    Section& point_data() { return piece[0]; }
    Section& cell_data() { return piece[1]; }
    Section& points() { return piece[2]; }
    Section& cells() { return piece[3]; }
};

constexpr std::size_t chunk_bytes = std::size_t{1} << 18;  // small enough to stay in the cache until it is written

// value(0), value(1), ..., which are computed while they are written.
template <class T, class Value>
void write_computed(CheckedFile& file, std::size_t count, const Value& value) {
    constexpr std::size_t chunk_size = chunk_bytes / sizeof(T);
    std::vector<T> chunk(std::min(count, chunk_size));
    for (std::size_t begin = 0; begin < count; begin += chunk_size) {
        const std::size_t size = std::min(chunk_size, count - begin);
        for (std::size_t i = 0; i < size; ++i) chunk[i] = static_cast<T>(value(begin + i));
        file.write(chunk.data(), size * sizeof(T));
    }
}

// An array with one value per cell: of_tet(t) for the tetrahedra, then of_facet(f).
template <class T, class OfTet, class OfFacet>
Array cell_array(std::string name, std::size_t tet_count, std::size_t facet_count, OfTet of_tet, OfFacet of_facet) {
    const std::size_t count = tet_count + facet_count;
    return {std::move(name), vtk_type<T>, 1, count, count * sizeof(T), [=](CheckedFile& file) {
                write_computed<T>(file, tet_count, of_tet);
                write_computed<T>(file, facet_count, of_facet);
            }};
}

// The same with integers of so many bytes.
template <class OfTet, class OfFacet>
Array tag_array(int bytes, std::string name, std::size_t tet_count, std::size_t facet_count, OfTet of_tet,
                OfFacet of_facet) {
    if (bytes == 1) return cell_array<std::int8_t>(std::move(name), tet_count, facet_count, of_tet, of_facet);
    if (bytes == 2) return cell_array<std::int16_t>(std::move(name), tet_count, facet_count, of_tet, of_facet);
    return cell_array<std::int32_t>(std::move(name), tet_count, facet_count, of_tet, of_facet);
}

template <class T>
Array array_of(std::string name, std::span<const T> values) {
    return {std::move(name),
            vtk_type<T>,
            1,
            values.size(),
            values.size_bytes(),
            [values](CheckedFile& file) { file.write(values.data(), values.size_bytes()); }};
}

// Where the vertices of each cell end in the connectivity.
template <class T>
Array offset_array(std::size_t tet_count, std::size_t facet_count) {
    return cell_array<T>(
        "offsets", tet_count, facet_count, [](std::size_t t) { return 4 * (t + 1); },
        [tet_count](std::size_t f) { return 4 * tet_count + 3 * (f + 1); });
}

// Strings as bytes, each one with a zero byte behind it. VTK has a type for strings with the same bytes, but meshio
// opens no file with an array of it.
Array string_array(std::string name, const std::vector<std::string>& strings) {
    std::uint64_t bytes = 0;
    for (const std::string& s : strings) bytes += s.size() + 1;
    return {std::move(name), vtk_type<std::uint8_t>, 1, bytes, bytes, [&strings](CheckedFile& file) {
                for (const std::string& s : strings) file.write(s.c_str(), s.size() + 1);
            }};
}

Array point_array(std::span<const Vec3> vertices) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const std::size_t bytes = vertices.size_bytes();
    const auto write_values = [vertices](CheckedFile& file) { file.write(vertices.data(), vertices.size_bytes()); };
    return {"Points", vtk_type<double>, 3, vertices.size(), bytes, write_values};
}

Array connectivity_array(const std::vector<Tetrahedron>& tets, const std::vector<Triangle>& facets) {
    const std::size_t count = 4 * tets.size() + 3 * facets.size();
    return {"connectivity", vtk_type<std::int32_t>, 1, count, count * sizeof(std::int32_t), [&](CheckedFile& file) {
                file.write(tets.data(), tets.size() * sizeof(Tetrahedron));
                file.write(facets.data(), facets.size() * sizeof(Triangle));
            }};
}

void require_sizes(bool sizes_agree) {
    if (!sizes_agree) throw Error(ErrorCode::internal, "The arrays of a part do not have the sizes of its mesh.");
}

// What files of parts and of their surfaces have in common. The part must outlive the grid.
Grid make_grid(const Part& part, bool with_cells, int tag_bytes) {
    static const std::vector<Tetrahedron> no_tets;
    const auto boundary_count = static_cast<std::size_t>(part.mesh.boundary_vertex_count);
    const std::vector<Tetrahedron>& tets = with_cells ? part.mesh.tets : no_tets;
    const std::size_t vertex_count = with_cells ? part.mesh.vertices.size() : boundary_count;
    const std::size_t tet_count = tets.size(), facet_count = part.facets.size();
    require_sizes(boundary_count <= vertex_count && part.global_id.size() == part.mesh.vertices.size() &&
                  part.neighbour.size() == facet_count && part.patch.size() == facet_count &&
                  part.facet.size() == facet_count);
    const auto none = [](std::size_t) { return -1; };
    const auto of_part = [id = part.id](std::size_t) { return id; };
    const auto of_facet = [](const std::vector<std::int32_t>& values) {
        return [&values](std::size_t f) { return values[f]; };
    };

    Grid grid{
        .point_count = vertex_count, .cell_count = tet_count + facet_count, .boundary_vertex_count = boundary_count};
    grid.field_data.arrays = {string_array("PatchNames", part.patch_names)};
    grid.point_data().arrays = {
        array_of("GlobalVertexId", std::span<const std::int64_t>(part.global_id).first(vertex_count))};
    grid.cell_data().arrays = {
        tag_array(tag_bytes, "Part", tet_count, facet_count, of_part, of_part),
        tag_array(tag_bytes, "Patch", tet_count, facet_count, none, of_facet(part.patch)),
        tag_array(tag_bytes, "Neighbour", tet_count, facet_count, none, of_facet(part.neighbour))};
    const Array facets = array_of("Facet", std::span<const std::int32_t>(part.facet));
    if (with_cells)  // four bytes for each tetrahedron would say nothing of it
        grid.field_data.arrays.push_back(facets);
    else
        grid.cell_data().arrays.insert(grid.cell_data().arrays.begin() + 2, facets);
    grid.points().arrays = {point_array(std::span(part.mesh.vertices).first(vertex_count))};
    const bool is_short = 4 * tet_count + 3 * facet_count <= std::numeric_limits<std::int32_t>::max();
    grid.cells().arrays = {connectivity_array(tets, part.facets),
                           is_short && with_cells ? offset_array<std::int32_t>(tet_count, facet_count)
                                                  : offset_array<std::int64_t>(tet_count, facet_count),
                           cell_array<std::uint8_t>(
                               "types", tet_count, facet_count, [](std::size_t) { return vtk_tetra; },
                               [](std::size_t) { return vtk_triangle; })};
    return grid;
}

// Columns of the qualities of all cells of a part, some cells at a time. A boundary triangle has the quality of the
// tetrahedron behind it.
class CellQualities {
 public:
    CellQualities(const Part& part, CellFieldSet fields) : part_(part), fields_(fields) {}

    // take(column, first cell, values) for the columns of the fields, in their order.
    template <class Take>
    void for_all_cells(const Take& take) const {
        const std::vector<Tetrahedron>& tets = part_.mesh.tets;
        for (std::size_t begin = 0; begin < tets.size(); begin += at_once)
            measure(begin, std::span(tets).subspan(begin, std::min(at_once, tets.size() - begin)), take);
        std::array<Tetrahedron, at_once> behind;
        for (std::size_t begin = 0; begin < part_.tet_at_facet.size(); begin += at_once) {
            const std::size_t count = std::min(at_once, part_.tet_at_facet.size() - begin);
            for (std::size_t i = 0; i < count; ++i) {
                const std::int32_t t = part_.tet_at_facet[begin + i];
                behind[i] = t < 0 ? nothing : tets[static_cast<std::size_t>(t)];
            }
            measure(tets.size() + begin, std::span(behind).first(count), take);
        }
    }

 private:
    static constexpr std::size_t at_once = 1024;
    static constexpr Tetrahedron nothing = {0, 0, 0, 0};
    static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

    template <class Take>
    void measure(std::size_t first, std::span<const Tetrahedron> cells, const Take& take) const {
        std::array<TetQuality, at_once> quality;
        std::array<float, at_once> values;
        const std::vector<Vec3>& points = part_.mesh.vertices;
        if (fields_ == CellFieldSet(1)) {  // the smallest dihedral angle, as most often
            std::array<double, at_once> degrees;
            measure_min_dihedrals(points, cells, std::span(degrees).first(cells.size()));
            for (std::size_t i = 0; i < cells.size(); ++i)
                values[i] = cells[i] == nothing ? unknown : static_cast<float>(degrees[i]);
            return take(0, first, std::span<const float>(values).first(cells.size()));
        }
        measure_cells(points, cells, std::span(quality).first(cells.size()));
        for (std::size_t field = 0, column = 0; field < cell_fields.size(); ++field) {
            if (!fields_[field]) continue;
            for (std::size_t i = 0; i < cells.size(); ++i)
                values[i] = cells[i] == nothing ? unknown : static_cast<float>(quality[i].*cell_fields[field].measure);
            take(column++, first, std::span<const float>(values).first(cells.size()));
        }
    }

    const Part& part_;
    CellFieldSet fields_;
};

// All measures of a cell are computed together, when the first array is written; the others wait until it is their
// turn. The part must outlive the grid, whose arrays are written once, in order.
void add_quality(Grid& grid, const Part& part, CellFieldSet fields) {
    const std::size_t cells = part.mesh.tets.size() + part.tet_at_facet.size();
    const auto waiting = std::make_shared<std::vector<std::vector<float>>>(fields.count());
    const auto write_first = [&part, waiting, cells, fields](CheckedFile& file) {
        for (std::size_t column = 1; column < waiting->size(); ++column) (*waiting)[column].resize(cells);
        CellQualities(part, fields)
            .for_all_cells([&](std::size_t column, std::size_t first, std::span<const float> values) {
                if (column == 0)
                    file.write(values.data(), values.size_bytes());
                else
                    std::copy(values.begin(), values.end(),
                              (*waiting)[column].begin() + static_cast<std::ptrdiff_t>(first));
            });
    };
    std::size_t column = 0;
    for (std::size_t field = 0; field < cell_fields.size(); ++field) {
        if (!fields[field]) continue;
        const auto write_waiting = [waiting, column](CheckedFile& file) {
            const std::vector<float> values = std::move((*waiting)[column]);
            file.write(values.data(), values.size() * sizeof(float));
        };
        Array array{cell_fields[field].array, vtk_type<float>, 1, cells, cells * sizeof(float), write_waiting};
        if (column == 0) array.write_values = write_first;
        grid.cell_data().arrays.push_back(std::move(array));
        ++column;
    }
}

// Values of tetrahedra, then of those behind the boundary triangles.
template <class T>
Array values_of_cells(const PartValues& values, const std::vector<T>& numbers, const Part& part) {
    const auto width = static_cast<std::size_t>(values.components);
    const std::size_t cells = part.mesh.tets.size() + part.tet_at_facet.size();
    require_sizes(numbers.size() == width * part.mesh.tets.size());
    const auto of_facet = [&numbers, &part, width](std::size_t i) {
        const std::int32_t t = part.tet_at_facet[i / width];
        return t < 0 ? std::numeric_limits<T>::quiet_NaN() : numbers[width * static_cast<std::size_t>(t) + i % width];
    };
    return {values.name,
            vtk_type<T>,
            values.components,
            cells,
            cells * width * sizeof(T),
            [&numbers, of_facet, count = width * part.tet_at_facet.size()](CheckedFile& file) {
                file.write(numbers.data(), numbers.size() * sizeof(T));
                write_computed<T>(file, count, of_facet);
            }};
}

template <class T>
Array values_of_points(const PartValues& values, const std::vector<T>& numbers, const Part& part) {
    require_sizes(numbers.size() == static_cast<std::size_t>(values.components) * part.mesh.vertices.size());
    Array array = array_of(values.name, std::span<const T>(numbers));
    array.components = values.components;
    array.tuples = part.mesh.vertices.size();
    return array;
}

void add_values(Grid& grid, const Part& part, std::span<const PartValues> all) {
    for (const PartValues& values : all) {
        const bool of_points = values.of == PartValues::Of::points;
        Section& section = of_points ? grid.point_data() : grid.cell_data();
        std::visit(
            [&](const auto& numbers) {
                section.arrays.push_back(of_points ? values_of_points(values, numbers, part)
                                                   : values_of_cells(values, numbers, part));
            },
            values.numbers);
    }
}

constexpr const char* file_begin =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";

// The raw bytes follow this line without a gap; offsets count from here.
constexpr std::string_view data_begin = "<AppendedData encoding=\"raw\">\n_";
constexpr std::string_view file_end = "\n</AppendedData>\n</VTKFile>\n";

// Names, types and sizes of the arrays of a section; `offset` advances over their bytes.
std::string array_elements(const Section& section, std::uint64_t& offset) {
    std::string xml;
    for (const Array& array : section.arrays) {
        xml += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" NumberOfTuples=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            array.type, array.name, array.components, array.tuples, offset);
        offset += sizeof(std::uint64_t) + array.bytes;
    }
    return xml;
}

std::string xml_header(const Grid& grid) {
    std::uint64_t offset = 0;
    std::string xml = fmt::format(file_begin, "UnstructuredGrid");
    xml += fmt::format(
        "<UnstructuredGrid>\n<FieldData>\n{}<DataArray type=\"Int32\" Name=\"BoundaryVertexCount\" "
        "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n",
        array_elements(grid.field_data, offset), grid.boundary_vertex_count);
    xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.point_count, grid.cell_count);
    for (const Section& section : grid.piece)
        xml += fmt::format("<{0}>\n{1}</{0}>\n", section.element, array_elements(section, offset));
    return xml + "</Piece>\n</UnstructuredGrid>\n";
}

void write_values(CheckedFile& file, const Section& section) {
    for (const Array& array : section.arrays) {
        file.write(&array.bytes, sizeof array.bytes);
        array.write_values(file);
    }
}

void write_grid(CheckedFile& file, const Grid& grid) {
    file.write(xml_header(grid));
    file.write(data_begin);
    write_values(file, grid.field_data);
    for (const Section& section : grid.piece) write_values(file, section);
    file.write(file_end);
}

// Calls take(grid) with that of the part, or of its surface.
template <class Take>
FileHash with_part_grid(const Part& part, const VtuLayout& layout, std::span<const PartValues> values, Take take) {
    require_sizes(part.tet_at_facet.size() == part.facets.size());
    Grid grid = make_grid(part, true, layout.tag_bytes);
    add_quality(grid, part, layout.fields);
    add_values(grid, part, values);
    return take(grid);
}

FileHash write_grid_file(const std::string& path, const Grid& grid) {
    Hasher hasher;
    CheckedFile file(path, "wb");
    file.hash_into(hasher);
    write_grid(file, grid);
    file.close();
    return hasher.digest();
}

FileHash hash_grid(const Grid& grid) { return write_grid_file("/dev/null", grid); }

// The names and types of a section's arrays, as each piece of a PVTU has them.
std::string parallel_section(const Section& section) {
    std::string xml = fmt::format("<P{}>\n", section.element);
    for (const Array& array : section.arrays)
        xml += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", array.type, array.name,
                           array.components);
    return xml + fmt::format("</P{}>\n", section.element);
}

// Reads our own XML: elements on one line, attributes in double quotes.
class HeaderParser {
 public:
    HeaderParser(std::string_view xml, const std::string& path) : xml_(xml), path_(path) {}

    // `data_position`: of the first array in the file.
    VtuHeader parse(std::int64_t data_position) const {
        VtuHeader header;
        const std::string_view piece = element_at(find("<Piece "));
        header.point_count = number(piece, "NumberOfPoints");
        header.cell_count = number(piece, "NumberOfCells");
        header.boundary_vertex_count = to_number(text_between(find("\"BoundaryVertexCount\""), ">", "<"));
        if (header.boundary_vertex_count > header.point_count)
            fail_damaged_vtu(path_, "it has fewer vertices than its boundary");
        constexpr std::string_view marker = "format=\"appended\"";
        for (std::size_t at = xml_.find(marker); at != xml_.npos; at = xml_.find(marker, at + 1)) {
            const std::string_view element = element_at(xml_.rfind('<', at));
            header.arrays.push_back({std::string(attribute(element, "Name")), std::string(attribute(element, "type")),
                                     number(element, "NumberOfComponents"), number(element, "NumberOfTuples"),
                                     data_position + number(element, "offset")});
        }
        return header;
    }

 private:
    std::size_t find(std::string_view text) const {
        const std::size_t at = xml_.find(text);
        if (at == xml_.npos) fail_damaged_vtu(path_, fmt::format("its XML header has no {}", text));
        return at;
    }
    std::string_view element_at(std::size_t begin) const { return xml_.substr(begin, xml_.find('>', begin) - begin); }
    std::string_view text_between(std::size_t from, std::string_view open, std::string_view close) const {
        const std::size_t begin = xml_.find(open, from) + open.size();
        return xml_.substr(begin, xml_.find(close, begin) - begin);
    }
    std::string_view attribute(std::string_view element, std::string_view name) const {
        const std::string opening = fmt::format(" {}=\"", name);
        const std::size_t begin = element.find(opening);
        if (begin == element.npos) fail_damaged_vtu(path_, fmt::format("an XML element lacks {}", name));
        const std::string_view rest = element.substr(begin + opening.size());
        return rest.substr(0, rest.find('"'));
    }
    std::int64_t number(std::string_view element, std::string_view name) const {
        return to_number(attribute(element, name));
    }
    std::int64_t to_number(std::string_view text) const {
        constexpr std::int64_t most = std::int64_t{1} << 56;  // so that no sum or product of counts overflows
        std::int64_t value = -1;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most)
            fail_damaged_vtu(path_, fmt::format("'{}' in its XML header is no count", text));
        return value;
    }

    std::string_view xml_;
    const std::string& path_;
};

}  // namespace

CellFieldSet parse_cell_fields(std::string_view list) {
    if (list.empty()) return VtuLayout().fields;
    if (list == "all") return ~CellFieldSet();
    if (list == "none") return {};
    CellFieldSet fields;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string_view name = list.substr(begin, end - begin);
        const auto found = std::find_if(cell_fields.begin(), cell_fields.end(),
                                        [&](const CellField& field) { return field.name == name; });
        if (found == cell_fields.end()) {
            std::string known;
            for (const CellField& field : cell_fields) known += fmt::format("{}, ", field.name);
            throw Error(ErrorCode::usage,
                        fmt::format("'{}' is no field of cells. There are {}all and none.", name, known));
        }
        fields.set(static_cast<std::size_t>(found - cell_fields.begin()));
        begin = end + 1;
    }
    return fields;
}

VtuLayout layout_for(const MeshOutline& outline, CellFieldSet fields) {
    auto largest = static_cast<std::int64_t>(outline.patch_names.size());
    for (const PartExtent& part : outline.parts) largest = std::max<std::int64_t>(largest, part.id);
    const auto fits = [&](std::int64_t limit) { return outline.is_whole && largest <= limit; };
    const int tag_bytes = fits(std::numeric_limits<std::int8_t>::max())    ? 1
                          : fits(std::numeric_limits<std::int16_t>::max()) ? 2
                                                                           : 4;
    return {fields, tag_bytes};
}

FileHash write_part(const std::string& path, const Part& part, const VtuLayout& layout,
                    std::span<const PartValues> values) {
    return with_part_grid(part, layout, values, [&](const Grid& grid) { return write_grid_file(path, grid); });
}

FileHash hash_of_part(const Part& part, const VtuLayout& layout) { return with_part_grid(part, layout, {}, hash_grid); }

FileHash write_part_surface(const std::string& path, const Part& part) {
    return write_grid_file(path, make_grid(part, false, sizeof(std::int32_t)));
}

FileHash hash_of_part_surface(const Part& part) { return hash_grid(make_grid(part, false, sizeof(std::int32_t))); }

std::string pvtu_text(const std::vector<std::string>& pieces, const VtuLayout& layout,
                      std::span<const PartValues> values) {
    // Only the names and types of the arrays are asked for, so that they are those of the pieces.
    const Part no_part;
    Grid grid = make_grid(no_part, true, layout.tag_bytes);
    add_quality(grid, no_part, layout.fields);
    std::vector<PartValues> nothing(values.begin(), values.end());
    for (PartValues& of_part : nothing) std::visit([](auto& numbers) { numbers.clear(); }, of_part.numbers);
    add_values(grid, no_part, nothing);

    std::string xml = fmt::format(file_begin, "PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n";
    for (const Section* section : {&grid.point_data(), &grid.cell_data(), &grid.points()})
        xml += parallel_section(*section);
    for (const std::string& piece : pieces) xml += fmt::format("<Piece Source=\"{}\"/>\n", xml_text(piece));
    return xml + "</PUnstructuredGrid>\n</VTKFile>\n";
}

void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const VtuLayout& layout,
                std::span<const PartValues> values) {
    write_text_file(path, pvtu_text(pieces, layout, values));
}

void fail_damaged_vtu(const std::string& path, const std::string& what) {
    throw Error(ErrorCode::io, fmt::format("{} is damaged or was not written by Kerf: {}. Run the mesher again to "
                                           "replace it.",
                                           path, what));
}

const VtuHeader::Array* VtuHeader::find(std::string_view name) const {
    const auto it = std::find_if(arrays.begin(), arrays.end(), [&](const Array& array) { return array.name == name; });
    return it == arrays.end() ? nullptr : &*it;
}

const VtuHeader::Array* VtuHeader::find_of_cells(std::string_view name) const {
    const auto it = std::find_if(arrays.rbegin(), arrays.rend(),
                                 [&](const Array& array) { return array.name == name && array.tuples == cell_count; });
    return it == arrays.rend() ? nullptr : &*it;
}

VtuHeader parse_vtu_header(std::string_view begin_of_file, const std::string& path) {
    const std::size_t end = begin_of_file.find(data_begin);
    if (!begin_of_file.starts_with(fmt::format(file_begin, "UnstructuredGrid")) || end == begin_of_file.npos)
        fail_damaged_vtu(path, "it does not begin with a complete XML header");
    return HeaderParser(begin_of_file.substr(0, end), path).parse(static_cast<std::int64_t>(end + data_begin.size()));
}

VtuLayout layout_of(const VtuHeader& header) {
    VtuLayout layout{{}, 4};
    for (std::size_t field = 0; field < cell_fields.size(); ++field)
        layout.fields[field] = header.find(cell_fields[field].array) != nullptr;
    if (const VtuHeader::Array* tag = header.find("Part"))
        layout.tag_bytes = tag->type == vtk_type<std::int8_t> ? 1 : tag->type == vtk_type<std::int16_t> ? 2 : 4;
    return layout;
}

}  // namespace kerf
