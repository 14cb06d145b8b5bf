// A grid of VTK's cells is collected defect by defect and written as one text: triangles for facets, one polyline for a
// loop or an edge, and one vertex for the place of the defect. A vertex of the soup becomes a point of the grid when
// the first cell names it, so that the file is as small as the defects are; the places of defects are points of their
// own. A loop of open edges has as many facets as vertices, by which it is told from a chain, and is closed. All arrays
// of cells grow together in end_cell().
#include "files/io/offenders_writer.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "files/io/output_file.h"
#include "files/io/vtk_cell_types.h"

namespace kerf {

namespace {

class OffendersGrid {
 public:
    explicit OffendersGrid(const Soup& soup) : soup_(soup), point_of_vertex_(soup.vertices.size(), -1) {}

    void add(const Defect& defect, std::size_t number) {
        for (const std::int32_t f : defect.facets)
            add_cell(vtk_triangle, soup_.facets[f], defect, number, soup_.file_facets({f})[0]);
        const bool is_line = defect.kind == DefectKind::open_edge || defect.kind == DefectKind::short_edge ||
                             defect.kind == DefectKind::non_manifold_edge;
        if (is_line) {
            std::vector<std::int32_t> line = defect.vertices;
            const bool closed = line.size() > 2 && line.size() == defect.facets.size();
            if (closed) line.push_back(line.front());
            add_cell(vtk_poly_line, line, defect, number, -1);
        }
        points_.push_back(defect.where);
        end_cell(vtk_vertex, {std::ssize(points_) - 1}, defect, number, -1);
    }

    std::string xml() const {
        std::string kinds;
        for (std::size_t k = 0; k < defect_kind_count; ++k)
            for (const char* c = name(static_cast<DefectKind>(k)); c; c = *c ? c + 1 : nullptr)
                kinds += fmt::format("{} ", static_cast<int>(*c));
        std::string points;
        for (const Vec3& p : points_) points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
        std::string text =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n<UnstructuredGrid>\n";
        text += fmt::format(
            "<FieldData>\n<Array type=\"String\" Name=\"KindNames\" NumberOfTuples=\"{}\" format=\"ascii\">{}</Array>\n"
            "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<CellData>\n",
            defect_kind_count, kinds, points_.size(), types_.size());
        text += array("Int32", "Kind", 1, fmt::to_string(fmt::join(kinds_, " ")));
        text += array("Int32", "Severity", 1, fmt::to_string(fmt::join(severities_, " ")));
        text += array("Int64", "Defect", 1, fmt::to_string(fmt::join(defects_, " ")));
        text += array("Int32", "Facet", 1, fmt::to_string(fmt::join(facets_, " ")));
        text += "</CellData>\n<Points>\n" + array("Float64", "Points", 3, points) + "</Points>\n<Cells>\n";
        text += array("Int64", "connectivity", 1, fmt::to_string(fmt::join(connectivity_, " ")));
        text += array("Int64", "offsets", 1, fmt::to_string(fmt::join(offsets_, " ")));
        text += array("UInt8", "types", 1, fmt::to_string(fmt::join(types_, " ")));
        return text + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }

 private:
    static std::string array(const char* type, const char* name, int components, const std::string& values) {
        return fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">{}</DataArray>\n", type,
            name, components, values);
    }
    void add_cell(int type, std::span<const std::int32_t> vertices, const Defect& defect, std::size_t number,
                  std::int32_t facet) {
        if (!std::all_of(vertices.begin(), vertices.end(),
                         [&](std::int32_t v) { return soup_.vertices[v].allFinite(); }))
            return;
        std::vector<std::int64_t> points;
        for (const std::int32_t v : vertices) {
            if (point_of_vertex_[v] < 0) {
                point_of_vertex_[v] = std::ssize(points_);
                points_.push_back(soup_.vertices[v]);
            }
            points.push_back(point_of_vertex_[v]);
        }
        end_cell(type, points, defect, number, facet);
    }
    void end_cell(int type, const std::vector<std::int64_t>& points, const Defect& defect, std::size_t number,
                  std::int32_t facet) {
        connectivity_.insert(connectivity_.end(), points.begin(), points.end());
        offsets_.push_back(std::ssize(connectivity_));
        types_.push_back(type);
        kinds_.push_back(static_cast<int>(defect.kind));
        severities_.push_back(static_cast<int>(defect.severity));
        defects_.push_back(number);
        facets_.push_back(facet);
    }

    const Soup& soup_;
    std::vector<std::int64_t> point_of_vertex_;
    std::vector<Vec3> points_;
    std::vector<std::int64_t> connectivity_, offsets_;
    std::vector<int> types_, kinds_, severities_;
    std::vector<std::size_t> defects_;
    std::vector<std::int32_t> facets_;
};

}  // namespace

void write_offenders(const std::string& path, const Soup& soup, const Diagnosis& diagnosis) {
    OffendersGrid grid(soup);
    for (std::size_t i = 0; i < diagnosis.defects.size(); ++i) grid.add(diagnosis.defects[i], i);
    write_output_file(path, grid.xml());
}

}  // namespace kerf
