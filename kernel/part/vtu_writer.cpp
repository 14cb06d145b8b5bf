// A VTU file is an XML header, then the arrays as raw bytes, each behind its size as a UInt64; the header names the
// offset of each array. So a grid is described here as a table of arrays, each with a function that streams its values:
// the header follows from the sizes alone, and only the quality measures are ever stored as a whole.
//
// The cells are the tetrahedra, then the boundary triangles. A grid without tetrahedra is a part's surface.
#include "part/vtu_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "io/checked_file.h"
#include "io/text_file.h"
#include "io/vtk_cell_types.h"
#include "mesh/quality.h"

namespace kerf {

namespace {

static_assert(std::endian::native == std::endian::little, "The writer stores values as they lie in memory.");

template <class T>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";
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

// An array of `count` values value(0), value(1), ..., which are computed while they are written.
template <class T, class Value>
Array computed_array(std::string name, std::size_t count, Value value) {
    return {std::move(name), vtk_type<T>, 1, count, count * sizeof(T), [count, value](CheckedFile& file) {
                constexpr std::size_t chunk_size = (std::size_t{1} << 20) / sizeof(T);
                std::vector<T> chunk(std::min(count, chunk_size));
                for (std::size_t begin = 0; begin < count; begin += chunk_size) {
                    const std::size_t size = std::min(chunk_size, count - begin);
                    for (std::size_t i = 0; i < size; ++i) chunk[i] = static_cast<T>(value(begin + i));
                    file.write(chunk.data(), size * sizeof(T));
                }
            }};
}

std::int32_t input_facet(Key key) { return key_node(key) == 0 ? key_index(key) : -1; }

// An array with one value per cell: of_tet(t) for the tetrahedra, then of_facet(f).
template <class T, class OfTet, class OfFacet>
Array cell_array(std::string name, std::size_t tet_count, std::size_t facet_count, OfTet of_tet, OfFacet of_facet) {
    return computed_array<T>(std::move(name), tet_count + facet_count,
                             [=](std::size_t i) { return i < tet_count ? of_tet(i) : of_facet(i - tet_count); });
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

Array point_array(const std::vector<Vec3>& vertices) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const std::size_t bytes = vertices.size() * sizeof(Vec3);
    const auto write_values = [&vertices, bytes](CheckedFile& file) { file.write(vertices.data(), bytes); };
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

// What files of parts and of their surfaces have in common. The arguments must outlive the grid.
Grid make_grid(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets, const SurfaceArrays& surface,
               const PartArrays& arrays) {
    const std::size_t vertex_count = vertices.size(), boundary_count = surface.vertices.size();
    const std::size_t tet_count = tets.size(), facet_count = surface.facets.size();
    require_sizes(boundary_count <= vertex_count && arrays.boundary_id.size() == boundary_count &&
                  arrays.neighbour.size() == facet_count && surface.patch.size() == facet_count &&
                  surface.facet_key.size() == facet_count);
    const auto none = [](std::size_t) { return -1; };
    const auto part = [part = arrays.part](std::size_t) { return part; };

    Grid grid{
        .point_count = vertex_count, .cell_count = tet_count + facet_count, .boundary_vertex_count = boundary_count};
    grid.field_data.arrays = {string_array("PatchNames", arrays.patch_names)};
    grid.point_data().arrays = {
        computed_array<std::int64_t>("GlobalVertexId", vertex_count, [boundary_count, &arrays](std::size_t v) {
            return v < boundary_count ? arrays.boundary_id[v] : static_cast<std::int64_t>(v - boundary_count);
        })};
    grid.cell_data().arrays = {
        cell_array<std::int32_t>("Part", tet_count, facet_count, part, part),
        cell_array<std::int32_t>("Patch", tet_count, facet_count, none,
                                 [&](std::size_t f) { return surface.patch[f]; }),
        cell_array<std::int32_t>("Facet", tet_count, facet_count, none,
                                 [&](std::size_t f) { return input_facet(surface.facet_key[f]); }),
        cell_array<std::int32_t>("Neighbour", tet_count, facet_count, none,
                                 [&](std::size_t f) { return arrays.neighbour[f]; })};
    grid.points().arrays = {point_array(vertices)};
    grid.cells().arrays = {connectivity_array(tets, surface.facets),
                           cell_array<std::int64_t>(
                               "offsets", tet_count, facet_count, [](std::size_t t) { return 4 * (t + 1); },
                               [tet_count](std::size_t f) { return 4 * tet_count + 3 * (f + 1); }),
                           cell_array<std::uint8_t>(
                               "types", tet_count, facet_count, [](std::size_t) { return vtk_tetra; },
                               [](std::size_t) { return vtk_triangle; })};
    return grid;
}

struct QualityArray {
    const char* name;
    double TetQuality::*measure;
};
constexpr std::array<QualityArray, 5> quality_arrays = {{{"MinDihedralAngle", &TetQuality::min_dihedral_deg},
                                                         {"MaxDihedralAngle", &TetQuality::max_dihedral_deg},
                                                         {"RadiusEdgeRatio", &TetQuality::radius_edge},
                                                         {"AspectRatio", &TetQuality::aspect},
                                                         {"Shape", &TetQuality::shape}}};

void add_quality(Grid& grid, std::span<const TetQuality> quality, std::span<const std::int32_t> tet_at_facet) {
    for (const auto& [name, measure] : quality_arrays) {
        const auto of_tet = [quality, measure = measure](std::size_t t) {
            return static_cast<float>(quality[t].*measure);
        };
        const auto of_facet = [=](std::size_t f) {
            return tet_at_facet[f] < 0 ? std::numeric_limits<float>::quiet_NaN() : of_tet(tet_at_facet[f]);
        };
        grid.cell_data().arrays.push_back(
            cell_array<float>(name, quality.size(), tet_at_facet.size(), of_tet, of_facet));
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

Grid make_part_grid(const TetMesh& mesh, const SurfaceArrays& surface, std::span<const TetQuality> quality,
                    std::span<const std::int32_t> tet_at_facet, const PartArrays& arrays) {
    require_sizes(quality.size() == mesh.tets.size() && tet_at_facet.size() == surface.facets.size() &&
                  static_cast<std::size_t>(mesh.boundary_vertex_count) == surface.vertices.size());
    Grid grid = make_grid(mesh.vertices, mesh.tets, surface, arrays);
    add_quality(grid, quality, tet_at_facet);
    return grid;
}

FileHash hash_grid(const Grid& grid) {
    Hasher hasher;
    CheckedFile nowhere("/dev/null", "wb");
    nowhere.hash_into(hasher);
    write_grid(nowhere, grid);
    return hasher.digest();
}

FileHash write_grid_file(const std::string& path, const Grid& grid) {
    Hasher hasher;
    CheckedFile file(path, "wb");
    file.hash_into(hasher);
    write_grid(file, grid);
    file.sync();
    file.close();
    return hasher.digest();
}

// The names and types of a section's arrays, as each piece of a PVTU has them.
std::string parallel_section(const Section& section) {
    std::string xml = fmt::format("<P{}>\n", section.element);
    for (const Array& array : section.arrays)
        xml += fmt::format("<PDataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", array.type, array.name,
                           array.components);
    return xml + fmt::format("</P{}>\n", section.element);
}

std::string xml_escaped(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&')
            escaped += "&amp;";
        else if (c == '<')
            escaped += "&lt;";
        else if (c == '"')
            escaped += "&quot;";
        else
            escaped += c;
    }
    return escaped;
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

// Where a part file has the numbers of its interior vertices.
struct InteriorIds {
    std::int64_t position, count;
};

InteriorIds find_interior_ids(CheckedFile& file, const std::string& path) {
    const VtuHeader header = parse_vtu_header(file.read(vtu_header_limit), path);
    const VtuHeader::Array* id = header.find("GlobalVertexId");
    if (!id || id->type != vtk_type<std::int64_t> || id->tuples != header.point_count)
        fail_damaged_vtu(path, "it has no GlobalVertexId for every vertex");
    constexpr std::int64_t item_size = sizeof(std::int64_t);
    return {id->position + item_size + header.boundary_vertex_count * item_size,  // behind the size of the array
            header.point_count - header.boundary_vertex_count};
}

}  // namespace

FileHash write_part(const std::string& path, const TetMesh& mesh, const SurfaceArrays& surface,
                    std::span<const TetQuality> quality, std::span<const std::int32_t> tet_at_facet,
                    const PartArrays& arrays) {
    return write_grid_file(path, make_part_grid(mesh, surface, quality, tet_at_facet, arrays));
}

FileHash hash_of_part(const TetMesh& mesh, const SurfaceArrays& surface, std::span<const TetQuality> quality,
                      std::span<const std::int32_t> tet_at_facet, const PartArrays& arrays) {
    return hash_grid(make_part_grid(mesh, surface, quality, tet_at_facet, arrays));
}

FileHash write_part_surface(const std::string& path, const SurfaceArrays& surface, const PartArrays& arrays) {
    const std::vector<Tetrahedron> no_tets;
    return write_grid_file(path, make_grid(surface.vertices, no_tets, surface, arrays));
}

FileHash hash_of_part_surface(const SurfaceArrays& surface, const PartArrays& arrays) {
    const std::vector<Tetrahedron> no_tets;
    return hash_grid(make_grid(surface.vertices, no_tets, surface, arrays));
}

std::string pvtu_text(const std::vector<std::string>& pieces) {
    // Only the names and types of the arrays are asked for, so that they are those of the pieces.
    const TetMesh no_mesh;
    const SurfaceArrays no_surface;
    const PartArrays no_arrays;
    Grid grid = make_grid(no_mesh.vertices, no_mesh.tets, no_surface, no_arrays);
    add_quality(grid, {}, {});

    std::string xml = fmt::format(file_begin, "PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n";
    for (const Section* section : {&grid.point_data(), &grid.cell_data(), &grid.points()})
        xml += parallel_section(*section);
    for (const std::string& piece : pieces) xml += fmt::format("<Piece Source=\"{}\"/>\n", xml_escaped(piece));
    return xml + "</PUnstructuredGrid>\n</VTKFile>\n";
}

void write_pvtu(const std::string& path, const std::vector<std::string>& pieces) {
    write_text_file(path, pvtu_text(pieces));
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

VtuHeader parse_vtu_header(std::string_view begin_of_file, const std::string& path) {
    const std::size_t end = begin_of_file.find(data_begin);
    if (!begin_of_file.starts_with(fmt::format(file_begin, "UnstructuredGrid")) || end == begin_of_file.npos)
        fail_damaged_vtu(path, "it does not begin with a complete XML header");
    return HeaderParser(begin_of_file.substr(0, end), path).parse(static_cast<std::int64_t>(end + data_begin.size()));
}

PartFileHashes hash_part_file(const std::string& path) {
    CheckedFile file(path, "rb");
    const InteriorIds ids = find_interior_ids(file, path);
    const std::int64_t ids_end = ids.position + ids.count * static_cast<std::int64_t>(sizeof(std::int64_t));
    PartFileHashes hashes;
    Hasher written, present;
    std::optional<std::int64_t> next_id;
    const auto check_ids = [&](const std::string& chunk) {
        for (std::size_t at = 0; at + sizeof(std::int64_t) <= chunk.size(); at += sizeof(std::int64_t)) {
            std::int64_t id = 0;
            std::memcpy(&id, chunk.data() + at, sizeof id);
            if (id != next_id.value_or(id)) fail_damaged_vtu(path, "its interior vertices are not numbered in a row");
            next_id = id + 1;
        }
    };
    // Reads up to `end`, or to the end of the file.
    const auto read_until = [&](std::int64_t end, bool as_written) {
        constexpr std::int64_t chunk_size = std::int64_t{1} << 20;
        while (hashes.bytes < end) {
            const std::string chunk = file.read(static_cast<std::size_t>(std::min(chunk_size, end - hashes.bytes)));
            if (chunk.empty()) return;
            present.add_bytes(chunk.data(), chunk.size());
            if (as_written)
                written.add_bytes(chunk.data(), chunk.size());
            else
                check_ids(chunk);
            hashes.bytes += static_cast<std::int64_t>(chunk.size());
        }
    };
    file.seek(0);
    read_until(ids.position, true);
    read_until(ids_end, false);
    for (std::int64_t i = 0; i < ids.count; ++i) written.add_bytes(&i, sizeof i);
    read_until(std::numeric_limits<std::int64_t>::max(), true);
    hashes.written = written.digest();
    hashes.present = present.digest();
    return hashes;
}

void number_interior_vertices(const std::string& path, std::int64_t first) {
    CheckedFile file(path, "r+b");
    const InteriorIds place = find_interior_ids(file, path);
    const Array ids =
        computed_array<std::int64_t>("GlobalVertexId", static_cast<std::size_t>(place.count),
                                     [first](std::size_t i) { return first + static_cast<std::int64_t>(i); });
    file.seek(place.position);
    ids.write_values(file);
    file.sync();
    file.close();
}

}  // namespace kerf
