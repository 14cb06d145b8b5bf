#include "quality/measured_mesh.h"

#include <filesystem>
#include <span>

#include <Eigen/Geometry>

#include "core/error.h"
#include "geometry/box.h"
#include "mesh/adjacency.h"

namespace kerf {

namespace {

std::vector<char> vertices_of(const std::vector<Triangle>& facets, const std::vector<char>& is_interface,
                              std::size_t vertex_count) {
    std::vector<char> on_interface(vertex_count, 0);
    for (std::size_t f = 0; f < facets.size(); ++f)
        if (is_interface[f])
            for (const std::int32_t v : facets[f]) on_interface[v] = 1;
    return on_interface;
}

void add_boundary(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                  const std::vector<char>& is_interface, TriangleDistributions& boundary) {
    for (std::size_t f = 0; f < facets.size(); ++f)
        if (!is_interface[f])
            boundary.add(triangle_angles(vertices[facets[f][0]], vertices[facets[f][1]], vertices[facets[f][2]]));
}

std::vector<Triangle> hull_of(TetMesh& mesh) {
    connect_tets(mesh);
    std::vector<Triangle> hull;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        for (std::size_t i = 0; i < tet_faces.size(); ++i)
            if (mesh.neighbours[t][i] < 0) {
                const auto& [a, b, c] = tet_faces[i];
                hull.push_back({mesh.tets[t][a], mesh.tets[t][b], mesh.tets[t][c]});
            }
    mesh.neighbours = {};
    return hull;
}

}  // namespace

MeasurableMesh::MeasurableMesh(const std::string& path) : path_(path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        open_run();
    else
        open_file();
}

void MeasurableMesh::open_file() {
    file_ = read_tet_file(path_);
    if (file_.facets.empty()) {
        file_.facets = hull_of(file_.mesh);
        file_.is_interface.assign(file_.facets.size(), 0);
    }
    diagonal_ = box_around(file_.mesh.vertices).diagonal().norm();
}

void MeasurableMesh::open_run() {
    run_ = std::make_unique<RunParts>(path_);
    Box box;
    for (const PartIndex part : run_->outline().parts.ids())
        box.extend(box_around(run_->load_only(part, PartContent::surface).mesh.vertices));
    diagonal_ = box.diagonal().norm();
}

void MeasurableMesh::add(const Part& part, double length_scale, MeshQuality& quality) const {
    std::vector<char> is_interface(part.facets.size());
    for (std::size_t f = 0; f < is_interface.size(); ++f) is_interface[f] = part.is_interface(f);
    const std::vector<char> on_interface = vertices_of(part.facets, is_interface, part.mesh.vertices.size());
    quality.cells.add(measure_quality(part.mesh, on_interface, length_scale));
    add_boundary(part.mesh.vertices, part.facets, is_interface, quality.boundary);
}

MeshQuality MeasurableMesh::measure(double length_scale) const {
    MeshQuality quality;
    quality.name = path_;
    quality.cells = PartQuality(length_scale);
    if (run_) {
        const MeshOutline& outline = run_->outline();
        quality.parts = std::ssize(outline.parts);
        quality.vertices = outline.vertices;
        for (const PartIndex part : run_->outline().parts.ids()) add(run_->load(part), length_scale, quality);
        return quality;
    }
    const std::vector<Vec3>& vertices = file_.mesh.vertices;
    quality.vertices = std::ssize(vertices);
    quality.turned_tets = file_.turned_tets;
    quality.notes = file_.notes;
    quality.cells =
        measure_quality(file_.mesh, vertices_of(file_.facets, file_.is_interface, vertices.size()), length_scale);
    add_boundary(vertices, file_.facets, file_.is_interface, quality.boundary);
    return quality;
}

}  // namespace kerf
