// One HDF5 file with the mesh twice: as VTKHDF 1.0 has it, a piece a part with the numbers of the part, and as one mesh
// by global numbers, at the places where PETSc's DMPlex looks for it and as an XDMF file describes it to DOLFINx and
// ParaView. viz/body and viz/patch, which solvers take for tags of cells and facets, count from 1, as in all formats of
// solvers; VTKHDF's Patch is the array of that name in VTU files, a place among the names from 0. The file is made with
// all its arrays; then parts write their rows, in any order and from any process.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/xml_text.h"
#include "export/format.h"
#include "export/hdf5_file.h"
#include "export/whole_mesh.h"
#include "io/vtk_cell_types.h"
#include "part/bodies.h"

namespace kerf {

namespace {

// Number of rows in arrays that have some for each part, before the part or over all of them.
struct PieceRows {
    std::int64_t points = 0, cells = 0, corners = 0, offsets = 0;

    void add(const PartExtent& part) {
        points += part.vertices;
        cells += part.tets + part.patch_facets;
        corners += 4 * part.tets + 3 * part.patch_facets;
        offsets += part.tets + part.patch_facets + 1;
    }
};

PieceRows rows_before(const MeshOutline& outline, std::size_t rank) {
    PieceRows rows;
    for (std::size_t r = 0; r < rank; ++r) rows.add(outline.parts[r]);
    return rows;
}

Hdf5Type type_for(std::int64_t largest) {
    return largest > std::numeric_limits<std::int32_t>::max() ? Hdf5Type::int64 : Hdf5Type::int32;
}

// Of global numbers.
Hdf5Type id_type(const MeshOutline& outline) { return type_for(outline.vertices); }

// Of the corners and offsets in a piece, which VTK wants to be of one type.
Hdf5Type corner_type(const MeshOutline& outline) {
    std::int64_t most = 0;
    for (const PartExtent& part : outline.parts) most = std::max(most, 4 * part.tets + 3 * part.patch_facets);
    return type_for(most);
}

// A slash would be a group.
std::string array_name(const PartValues& values) {
    std::string name = values.name;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}
// Of the pieces, and by global numbers.
std::string piece_array_of(const PartValues& values) {
    const bool of_points = values.of == PartValues::Of::points;
    return (of_points ? "VTKHDF/PointData/" : "VTKHDF/CellData/") + array_name(values);
}
std::string whole_array_of(const PartValues& values) {
    const bool of_points = values.of == PartValues::Of::points;
    return (of_points ? "fields/vertices/" : "fields/cells/") + array_name(values);
}

std::vector<Hdf5Array> arrays_of(const MeshOutline& outline) {
    const auto parts = static_cast<std::int64_t>(outline.parts.size());
    const PieceRows all = rows_before(outline, outline.parts.size());
    const std::int64_t tets = outline.tets(), facets = outline.first_patch_facet(static_cast<std::int32_t>(parts));
    std::vector<Hdf5Array> arrays = {
        {"VTKHDF/NumberOfPoints", Hdf5Type::int64, parts},
        {"VTKHDF/NumberOfCells", Hdf5Type::int64, parts},
        {"VTKHDF/NumberOfConnectivityIds", Hdf5Type::int64, parts},
        {"VTKHDF/Points", Hdf5Type::real, all.points, 3},
        {"VTKHDF/PointData/GlobalVertexId", Hdf5Type::int64, all.points},
        {"VTKHDF/Connectivity", corner_type(outline), all.corners},
        {"VTKHDF/Offsets", corner_type(outline), all.offsets},
        {"VTKHDF/Types", Hdf5Type::byte, all.cells},
        {"VTKHDF/CellData/Part", Hdf5Type::int32, all.cells},
        {"VTKHDF/CellData/Patch", Hdf5Type::int32, all.cells},
        {"geometry/vertices", Hdf5Type::real, outline.vertices, 3},
        {"viz/topology/cells", id_type(outline), tets, 4},
        {"viz/topology/facets", id_type(outline), facets, 3},
        {"viz/body", Hdf5Type::int32, tets},
        {"viz/part", Hdf5Type::int32, tets},
        {"viz/patch", Hdf5Type::int32, facets},
    };
    for (const PartValues& values : outline.values) {
        const bool of_points = values.of == PartValues::Of::points;
        const std::int64_t columns = values.components == 1 ? 0 : values.components;
        arrays.push_back({piece_array_of(values), Hdf5Type::real, of_points ? all.points : all.cells, columns});
        arrays.push_back({whole_array_of(values), Hdf5Type::real, of_points ? outline.vertices : tets, columns});
    }
    return arrays;
}

// Writes values of an array, one behind the other from a row on, through a buffer.
template <class T>
class Hdf5Rows {
 public:
    Hdf5Rows(const Hdf5Bytes& file, std::string_view name, std::int64_t first_row)
        : file_(file),
          begin_(file.place_of(name, 0)),
          row_size_(file.place_of(name, 1) - begin_),
          place_(begin_ + first_row * row_size_) {
        values_.reserve(most_values);
    }

    /// The next value is the first of this row.
    void go_to(std::int64_t row) {
        const std::int64_t wanted = begin_ + row * row_size_;
        if (wanted == place_ + static_cast<std::int64_t>(values_.size() * sizeof(T))) return;
        flush();
        place_ = wanted;
    }
    void put(T value) {
        if (values_.size() == most_values) flush();
        values_.push_back(value);
    }
    void flush() {
        file_.write(values_.data(), values_.size() * sizeof(T), place_);
        place_ += static_cast<std::int64_t>(values_.size() * sizeof(T));
        values_.clear();
    }

 private:
    static constexpr std::size_t most_values = (std::size_t{1} << 20) / sizeof(T);

    const Hdf5Bytes& file_;
    std::int64_t begin_, row_size_;
    std::int64_t place_;  // of the first value in the buffer
    std::vector<T> values_;
};

// Calls take(f) for the triangles on the user's surface.
template <class Take>
void for_each_patch_facet(const Part& part, Take take) {
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (!part.is_interface(f)) take(f);
}

// The rows of one part in all arrays.
class Hdf5Piece {
 public:
    Hdf5Piece(const Hdf5Bytes& file, const PartSource& parts, std::int32_t rank, const Part& part)
        : file_(file),
          parts_(parts),
          outline_(parts.outline()),
          rank_(rank),
          part_(part),
          own_(rows_before(outline_, static_cast<std::size_t>(rank))) {}

    void write() const {
        write_piece_points();
        if (corner_type(outline_) == Hdf5Type::int32)
            write_piece_cells<std::int32_t>();
        else
            write_piece_cells<std::int64_t>();
        write_piece_tags();
        write_vertices();
        if (id_type(outline_) == Hdf5Type::int32)
            write_cells<std::int32_t>();
        else
            write_cells<std::int64_t>();
        write_tags();
        for (const PartValues& values : part_.values) write_values(values);
    }

 private:
    template <class T>
    void write_span(std::string_view name, std::int64_t row, std::span<const T> values) const {
        file_.write(values.data(), values.size_bytes(), file_.place_of(name, row));
    }

    void write_piece_points() const {
        PieceRows size;
        size.add(outline_.parts[static_cast<std::size_t>(rank_)]);
        for (const auto& [name, count] : {std::pair{"VTKHDF/NumberOfPoints", size.points},
                                          {"VTKHDF/NumberOfCells", size.cells},
                                          {"VTKHDF/NumberOfConnectivityIds", size.corners}})
            write_span(name, rank_, std::span<const std::int64_t>(&count, 1));
        write_span("VTKHDF/Points", own_.points, std::span<const Vec3>(part_.mesh.vertices));
        write_span("VTKHDF/PointData/GlobalVertexId", own_.points, std::span<const std::int64_t>(part_.global_id));
    }

    template <class Index>
    void write_piece_cells() const {
        Hdf5Rows<Index> corners(file_, "VTKHDF/Connectivity", own_.corners);
        Hdf5Rows<Index> offsets(file_, "VTKHDF/Offsets", own_.offsets);
        Hdf5Rows<std::uint8_t> types(file_, "VTKHDF/Types", own_.cells);
        Index offset = 0;
        const auto put = [&](const auto& cell, std::uint8_t type) {
            for (const std::int32_t v : cell) corners.put(v);
            types.put(type);
            offsets.put(offset);
            offset += static_cast<Index>(cell.size());
        };
        for (const Tetrahedron& tet : part_.mesh.tets) put(tet, vtk_tetra);
        for_each_patch_facet(part_, [&](std::size_t f) { put(part_.facets[f], vtk_triangle); });
        offsets.put(offset);
        corners.flush();
        offsets.flush();
        types.flush();
    }

    void write_piece_tags() const {
        const PartExtent& extent = outline_.parts[static_cast<std::size_t>(rank_)];
        Hdf5Rows<std::int32_t> part(file_, "VTKHDF/CellData/Part", own_.cells);
        Hdf5Rows<std::int32_t> patch(file_, "VTKHDF/CellData/Patch", own_.cells);
        for (std::int64_t cell = 0; cell < extent.tets + extent.patch_facets; ++cell) part.put(part_.id);
        for (std::int64_t cell = 0; cell < extent.tets; ++cell) patch.put(-1);
        for_each_patch_facet(part_, [&](std::size_t f) { patch.put(part_.patch[f]); });
        part.flush();
        patch.flush();
    }

    // Vertices that the part owns, ascending by global number.
    std::vector<std::size_t> own_vertices() const {
        const std::vector<NodeId> owner = owners_of_vertices(part_);
        std::vector<std::size_t> own;
        for (std::size_t v = 0; v < owner.size(); ++v)
            if (owner[v] == part_.id) own.push_back(v);
        std::sort(own.begin(), own.end(),
                  [this](std::size_t a, std::size_t b) { return part_.global_id[a] < part_.global_id[b]; });
        return own;
    }

    // Boundary triangles have the values of the tetrahedron behind them.
    void write_values(const PartValues& values) const {
        const auto width = static_cast<std::size_t>(values.components);
        const auto put = [&](Hdf5Rows<double>& rows, std::size_t i) {
            for (std::size_t c = 0; c < width; ++c) rows.put(values.number(width * i + c));
        };
        const bool of_points = values.of == PartValues::Of::points;
        Hdf5Rows<double> piece(file_, piece_array_of(values), of_points ? own_.points : own_.cells);
        Hdf5Rows<double> whole(file_, whole_array_of(values), of_points ? 0 : outline_.first_tet(rank_));
        if (of_points) {
            for (std::size_t v = 0; v < part_.global_id.size(); ++v) put(piece, v);
            for (const std::size_t v : own_vertices()) {
                whole.go_to(part_.global_id[v]);
                put(whole, v);
            }
        } else {
            for (std::size_t t = 0; t < part_.mesh.tets.size(); ++t) {
                put(piece, t);
                put(whole, t);
            }
            for_each_patch_facet(part_, [&](std::size_t f) {
                const std::int32_t tet = part_.tet_at_facet[f];
                for (std::size_t c = 0; c < width; ++c)
                    piece.put(tet < 0 ? NAN : values.number(width * static_cast<std::size_t>(tet) + c));
            });
        }
        piece.flush();
        whole.flush();
    }

    void write_vertices() const {
        Hdf5Rows<double> points(file_, "geometry/vertices", 0);
        for (const std::size_t v : own_vertices()) {
            points.go_to(part_.global_id[v]);
            for (const double x : part_.mesh.vertices[v]) points.put(x);
        }
        points.flush();
    }

    template <class Id>
    void write_cells() const {
        Hdf5Rows<Id> cells(file_, "viz/topology/cells", outline_.first_tet(rank_));
        Hdf5Rows<Id> facets(file_, "viz/topology/facets", outline_.first_patch_facet(rank_));
        for (const Tetrahedron& tet : part_.mesh.tets)
            for (const std::int64_t id : global_corners(part_, tet)) cells.put(static_cast<Id>(id));
        for_each_patch_facet(part_, [&](std::size_t f) {
            for (const std::int64_t id : global_corners(part_, part_.facets[f])) facets.put(static_cast<Id>(id));
        });
        cells.flush();
        facets.flush();
    }

    void write_tags() const {
        Hdf5Rows<std::int32_t> body(file_, "viz/body", outline_.first_tet(rank_));
        Hdf5Rows<std::int32_t> part(file_, "viz/part", outline_.first_tet(rank_));
        Hdf5Rows<std::int32_t> patch(file_, "viz/patch", outline_.first_patch_facet(rank_));
        for (const std::int32_t of_tet : parts_.bodies().of_tets(rank_, part_)) body.put(of_tet + 1);
        for (std::int64_t tet = 0; tet < part_.tet_count(); ++tet) part.put(part_.id);
        for_each_patch_facet(part_, [&](std::size_t f) { patch.put(part_.patch[f] + 1); });
        body.flush();
        part.flush();
        patch.flush();
    }

    const Hdf5Bytes& file_;
    const PartSource& parts_;
    const MeshOutline& outline_;
    std::int32_t rank_;
    const Part& part_;
    PieceRows own_;  // before those of this part
};

// What the arrays by global numbers mean, for readers of XDMF. They lie in the file `h5` beside it.
class XdmfText {
 public:
    XdmfText(const MeshOutline& outline, std::string h5) : outline_(outline), h5_(std::move(h5)) {}

    std::string text() const {
        std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
        for (std::size_t patch = 0; patch < outline_.patch_names.size(); ++patch)
            text += fmt::format("    <Information Name=\"patch {}\" Value=\"{}\"/>\n", patch + 1,
                                xml_text(outline_.patch_names[patch]));
        std::string values;
        for (const PartValues& each : outline_.values)
            values += attribute(array_name(each), each.components, each.of == PartValues::Of::points ? "Node" : "Cell",
                                whole_array_of(each));
        // DOLFINx takes the first attribute for the tags.
        const std::string tags = attribute("body", 1, "Cell", "viz/body") + attribute("part", 1, "Cell", "viz/part");
        text += grid("mesh", "Tetrahedron", 4, "viz/topology/cells", tags + values);
        text += grid("facets", "Triangle", 3, "viz/topology/facets", attribute("patch", 1, "Cell", "viz/patch"));
        return text + "  </Domain>\n</Xdmf>\n";
    }

 private:
    std::string item(const std::string& name) const {
        const std::vector<Hdf5Array> arrays = arrays_of(outline_);
        const auto array =
            std::find_if(arrays.begin(), arrays.end(), [&](const Hdf5Array& each) { return each.name == name; });
        const std::string columns = array->columns ? fmt::format(" {}", array->columns) : "";
        return fmt::format(
            "<DataItem Dimensions=\"{}{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:/{}</DataItem>",
            array->rows, columns, array->type == Hdf5Type::real ? "Float" : "Int", size_of(array->type), xml_text(h5_),
            name);
    }

    std::string attribute(const std::string& name, int components, const char* center, const std::string& array) const {
        const char* type = components == 1 ? "Scalar" : components == 3 ? "Vector" : "Matrix";
        return fmt::format("      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                           xml_text(name), type, center, item(array));
    }

    std::string grid(const char* name, const char* cell, int corners, const char* cells,
                     const std::string& attributes) const {
        return fmt::format(
            "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
            "      <Topology TopologyType=\"{}\" NodesPerElement=\"{}\">{}</Topology>\n"
            "      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
            "{}    </Grid>\n",
            name, cell, corners, item(cells), item("geometry/vertices"), attributes);
    }

    const MeshOutline& outline_;
    std::string h5_;
};

void make_hdf5(const MeshOutline& outline, ExportFiles& files, const std::string& stem) {
    Hdf5Content content;
    content.groups = {"VTKHDF", "VTKHDF/PointData", "VTKHDF/CellData", "geometry", "viz", "viz/topology"};
    if (!outline.values.empty())
        for (const char* group : {"fields", "fields/vertices", "fields/cells"}) content.groups.push_back(group);
    content.arrays = arrays_of(outline);
    content.attributes = {{"VTKHDF", "Version", std::vector<std::int32_t>{1, 0}},
                          {"VTKHDF", "Type", "UnstructuredGrid"},
                          {"viz/topology/cells", "cell_dim", std::vector<std::int32_t>{3}}};  // for DMPlex
    content.names = {"viz/patch_names", outline.patch_names};
    make_hdf5_file(files.path_of(stem + ".h5"), content);
    files.add(stem + ".h5");
}

void make_xdmf(const MeshOutline& outline, ExportFiles& files, const std::string& stem) {
    ExportFile file = files.create(stem + ".xdmf");
    file.text(XdmfText(outline, stem.substr(stem.rfind('/') + 1) + ".h5").text());
    file.close();
}

void write_hdf5_rows(const PartSource& parts, std::int32_t rank, const Part& part, ExportFiles& files,
                     const std::string& stem) {
    Hdf5Bytes file(files.path_of(stem + ".h5"), arrays_of(parts.outline()));
    Hdf5Piece(file, parts, rank, part).write();
    file.close();
    files.add(stem + ".h5");
}

void write_hdf5_whole(const PartSource& parts, ExportFiles& files) {
    make_hdf5(parts.outline(), files, "mesh");
    make_xdmf(parts.outline(), files, "mesh");
}

void write_hdf5_part(const PartSource& parts, std::int32_t rank, const Part& part, ExportFiles& files) {
    write_hdf5_rows(parts, rank, part, files, "mesh");
}

void write_hdf5_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    make_hdf5(parts.outline(), files, stem);
    make_xdmf(parts.outline(), files, stem);
    for_each_whole_part(parts,
                        [&](std::int32_t rank, const Part& part) { write_hdf5_rows(parts, rank, part, files, stem); });
}

}  // namespace

extern const Format hdf5_format = {.name = "hdf5",
                                   .help = "HDF5 as VTKHDF and XDMF: ParaView, DOLFINx, PETSc",
                                   .ending = ".h5",
                                   .write_whole = write_hdf5_whole,
                                   .write_part = write_hdf5_part,
                                   .write_merged = write_hdf5_merged};

}  // namespace kerf
