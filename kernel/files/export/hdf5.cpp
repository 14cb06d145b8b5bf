// One HDF5 file with the mesh twice: as VTKHDF 1.0 has it, a piece a part with the numbers of the part, and as one mesh
// by global numbers, at the places where PETSc's DMPlex looks for it and as an XDMF file describes it to DOLFINx and
// ParaView. viz/body, viz/region (of several) and viz/patch, which solvers take for tags of cells and facets, count
// from 1, as in all formats of solvers; VTKHDF's Patch and Region are the arrays of these names in VTU files, places
// among the names from 0. Of order 2 points are all nodes and cells are quadratic, in VTK's order, which is that of
// XDMF and of DOLFINx for it; DMPlex gets the corners. The file is made with all its arrays; then parts write their
// rows, in any order and from any process.
#include <algorithm>
#include <cmath>

#include "files/export/format.h"
#include "files/export/inside/hdf5_arrays.h"
#include "files/export/inside/hdf5_file.h"
#include "files/export/inside/hdf5_rows.h"
#include "files/export/inside/materials.h"
#include "files/export/whole_mesh.h"
#include "files/io/vtk_cell_types.h"
#include "files/part/bodies.h"
#include "files/part/region_walls.h"

namespace kerf {

namespace {

// The rows of one part in all arrays.
class Hdf5Piece {
 public:
    Hdf5Piece(const Hdf5Bytes& file, const PartSource& parts, PartIndex index, const Part& part)
        : file_(file),
          parts_(parts),
          outline_(parts.outline()),
          index_(index),
          part_(part),
          own_(rows_before(outline_, index)) {}

    void write() const {
        write_piece_points();
        if (corner_type(outline_) == Hdf5Type::int32)
            write_piece_cells<std::int32_t>();
        else
            write_piece_cells<std::int64_t>();
        write_piece_tags();
        write_nodes();
        if (id_type(outline_) == Hdf5Type::int32)
            write_cells<std::int32_t>();
        else
            write_cells<std::int64_t>();
        write_tags();
        if (!outline_.region_names.empty()) write_regions();
        for (const PartValues& values : part_.values) write_values(values);
    }

 private:
    template <class T>
    void write_span(std::string_view name, std::int64_t row, std::span<const T> values) const {
        file_.write(values.data(), values.size_bytes(), file_.place_of(name, row));
    }

    void write_piece_points() const {
        PieceRows size;
        size.add(outline_.parts[index_], outline_.order);
        for (const auto& [name, count] : {std::pair{"VTKHDF/NumberOfPoints", size.points},
                                          {"VTKHDF/NumberOfCells", size.cells},
                                          {"VTKHDF/NumberOfConnectivityIds", size.corners}})
            write_span(name, index_.value(), std::span<const std::int64_t>(&count, 1));
        const std::int64_t first_edge_node = own_.points + part_.vertex_count();
        write_span("VTKHDF/Points", own_.points, std::span<const Vec3>(part_.mesh.vertices));
        write_span("VTKHDF/Points", first_edge_node, std::span<const Vec3>(part_.edge_nodes.points));
        const std::string_view ids = "VTKHDF/PointData/GlobalVertexId";
        write_span(ids, own_.points, std::span<const std::int64_t>(part_.global_id));
        write_span(ids, first_edge_node, std::span<const std::int64_t>(part_.edge_nodes.global_id));
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
            offset += cell.size();
        };
        const bool is_linear = part_.order() == 1;
        for (std::int64_t t = 0; t < part_.tet_count(); ++t)
            is_linear ? put(part_.mesh.tets[t], vtk_tetra) : put(part_.nodes_of_tet(t), vtk_quadratic_tetra);
        for_each_listed_facet(part_, [&](std::size_t f) {
            is_linear ? put(part_.facets[f], vtk_triangle) : put(part_.nodes_of_facet(f), vtk_quadratic_triangle);
        });
        offsets.put(offset);
        corners.flush();
        offsets.flush();
        types.flush();
    }

    void write_piece_tags() const {
        const PartExtent& extent = outline_.parts[index_];
        Hdf5Rows<std::int32_t> part(file_, "VTKHDF/CellData/Part", own_.cells);
        Hdf5Rows<std::int32_t> patch(file_, "VTKHDF/CellData/Patch", own_.cells);
        for (std::int64_t cell = 0; cell < extent.tets + extent.patch_facets; ++cell) part.put(part_.id.value());
        for (std::int64_t cell = 0; cell < extent.tets; ++cell) patch.put(-1);
        for_each_listed_facet(part_, [&](std::size_t f) { patch.put(part_.patch[f]); });
        part.flush();
        patch.flush();
    }

    // Nodes that the part owns, ascending by global number.
    std::vector<std::size_t> own_by_number() const {
        const std::vector<bool> is_own = own_nodes(part_);
        std::vector<std::size_t> own;
        for (std::size_t n = 0; n < is_own.size(); ++n)
            if (is_own[n]) own.push_back(n);
        std::sort(own.begin(), own.end(),
                  [this](std::size_t a, std::size_t b) { return part_.node_id(a) < part_.node_id(b); });
        return own;
    }

    // Boundary triangles have the values of the tetrahedron behind them.
    void write_values(const PartValues& values) const {
        const std::size_t width = values.components;
        const auto put = [&](Hdf5Rows<double>& rows, std::size_t i) {
            for (std::size_t c = 0; c < width; ++c) rows.put(values.number(width * i + c));
        };
        const bool of_points = values.of == PartValues::Of::points;
        Hdf5Rows<double> piece(file_, piece_array_of(values), of_points ? own_.points : own_.cells);
        Hdf5Rows<double> whole(file_, whole_array_of(values), of_points ? 0 : outline_.first_tet(index_));
        if (of_points) {
            for (std::int64_t n = 0; n < part_.node_count(); ++n) put(piece, n);
            for (const std::size_t n : own_by_number()) {
                whole.go_to(part_.node_id(n));
                put(whole, n);
            }
        } else {
            for (std::size_t t = 0; t < part_.mesh.tets.size(); ++t) {
                put(piece, t);
                put(whole, t);
            }
            for_each_listed_facet(part_, [&](std::size_t f) {
                const std::int32_t tet = part_.tet_at_facet[f];
                for (std::size_t c = 0; c < width; ++c) piece.put(tet < 0 ? NAN : values.number(width * tet + c));
            });
        }
        piece.flush();
        whole.flush();
    }

    void write_nodes() const {
        Hdf5Rows<double> points(file_, "geometry/vertices", 0);
        for (const std::size_t n : own_by_number()) {
            points.go_to(part_.node_id(n));
            for (const double x : part_.node_point(n)) points.put(x);
        }
        points.flush();
    }

    template <class Id>
    void write_cells() const {
        Hdf5Rows<Id> cells(file_, "viz/topology/cells", outline_.first_tet(index_));
        Hdf5Rows<Id> facets(file_, "viz/topology/facets", outline_.first_patch_facet(index_));
        for (const Tetrahedron& tet : part_.mesh.tets)
            for (const std::int64_t id : global_corners(part_, tet)) cells.put(id);
        for_each_listed_facet(part_, [&](std::size_t f) {
            for (const std::int64_t id : nodes_of_facet(part_, f)) facets.put(id);
        });
        cells.flush();
        facets.flush();
        if (part_.order() == 1) return;
        Hdf5Rows<Id> nodes(file_, nodes_array(outline_), outline_.first_tet(index_));
        for (std::int64_t t = 0; t < part_.tet_count(); ++t)
            for (const std::int64_t id : nodes_of_tet(part_, t)) nodes.put(id);
        nodes.flush();
    }

    void write_tags() const {
        Hdf5Rows<std::int32_t> body(file_, "viz/body", outline_.first_tet(index_));
        Hdf5Rows<std::int32_t> part(file_, "viz/part", outline_.first_tet(index_));
        Hdf5Rows<std::int32_t> patch(file_, "viz/patch", outline_.first_patch_facet(index_));
        for (const std::int32_t of_tet : parts_.bodies().of_tets(index_, part_)) body.put(of_tet + 1);
        for (std::int64_t tet = 0; tet < part_.tet_count(); ++tet) part.put(part_.id.value());
        for_each_listed_facet(part_, [&](std::size_t f) { patch.put(part_.patch[f] + 1); });
        body.flush();
        part.flush();
        patch.flush();
    }

    void write_regions() const {
        Hdf5Rows<std::int32_t> piece(file_, "VTKHDF/CellData/Region", own_.cells);
        Hdf5Rows<std::int32_t> whole(file_, "viz/region", outline_.first_tet(index_));
        for (const std::int32_t of_tet : Materials(parts_).of_tets(index_, part_)) {
            piece.put(of_tet);
            whole.put(of_tet + 1);
        }
        for_each_listed_facet(part_, [&](std::size_t f) { piece.put(region_behind(part_, f).value()); });
        piece.flush();
        whole.flush();
    }

    const Hdf5Bytes& file_;
    const PartSource& parts_;
    const MeshOutline& outline_;
    PartIndex index_;
    const Part& part_;
    PieceRows own_;  // before those of this part
};

void make_hdf5(const MeshOutline& outline, ExportFiles& files, const std::string& stem) {
    Hdf5Content content;
    content.format = "hdf5";
    content.groups = {"VTKHDF", "VTKHDF/PointData", "VTKHDF/CellData", "geometry", "viz", "viz/topology"};
    if (!outline.values.empty())
        content.groups.insert(content.groups.end(), {"fields", "fields/vertices", "fields/cells"});
    content.arrays = arrays_of(outline);
    content.attributes = {{"VTKHDF", "Version", std::vector<std::int32_t>{1, 0}},
                          {"VTKHDF", "Type", "UnstructuredGrid"},
                          {"viz/topology/cells", "cell_dim", std::vector<std::int32_t>{3}}};  // for DMPlex
    content.names = {{"viz/patch_names", outline.patch_names}};
    if (!outline.region_names.empty()) content.names.push_back({"viz/region_names", outline.region_names});
    make_hdf5_file(files.path_of(stem + ".h5"), content);
    files.add(stem + ".h5");
}

void make_xdmf(const MeshOutline& outline, ExportFiles& files, const std::string& stem) {
    ExportFile file = files.create(stem + ".xdmf");
    file.write(xdmf_text(outline, stem.substr(stem.rfind('/') + 1) + ".h5"));
    file.close();
}

void write_hdf5_rows(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files,
                     const std::string& stem) {
    Hdf5Bytes file(files.path_of(stem + ".h5"), arrays_of(parts.outline()));
    Hdf5Piece(file, parts, index, part).write();
    file.close();
    files.add(stem + ".h5");
}

void write_hdf5_whole(const PartSource& parts, ExportFiles& files) {
    make_hdf5(parts.outline(), files, "mesh");
    make_xdmf(parts.outline(), files, "mesh");
}

void write_hdf5_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    write_hdf5_rows(parts, index, part, files, "mesh");
}

void write_hdf5_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    make_hdf5(parts.outline(), files, stem);
    make_xdmf(parts.outline(), files, stem);
    for_each_part(parts, PartContent::all,
                  [&](PartIndex index, const Part& part) { write_hdf5_rows(parts, index, part, files, stem); });
}

}  // namespace

extern const Format hdf5_format = {.name = "hdf5",
                                   .help = "HDF5 as VTKHDF and XDMF: ParaView, DOLFINx, PETSc",
                                   .ending = ".h5",
                                   .kind = {"HDF5 file or XDMF",
                                            [](std::string_view text) {
                                                return is_hdf5_of("hdf5", text) ||
                                                       text.find("<Xdmf Version=\"3.0\">") < 50;
                                            }},
                                   .has_values = true,
                                   .write_whole = write_hdf5_whole,
                                   .write_part = write_hdf5_part,
                                   .write_merged = write_hdf5_merged};

}  // namespace kerf
