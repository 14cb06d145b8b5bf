#include "quality/measured_mesh.h"

#include <filesystem>
#include <span>

#include <Eigen/Geometry>

#include "core/error.h"
#include "geometry/box.h"
#include "mesh/adjacency.h"

namespace kerf {

namespace {

void add_quality(const TetMesh& mesh, const BoundaryTriangles& boundary, double length_scale, MeshQuality& quality) {
    quality.cells.add(measure_quality(mesh, boundary, length_scale));
    for (std::size_t f = 0; f < boundary.facets.size(); ++f) {
        const auto& [a, b, c] = boundary.facets[f];
        if (!boundary.is_interface[f])
            quality.boundary.add(triangle_angles(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
    }
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
    add_quality(part.mesh, {part.facets, is_interface}, length_scale, quality);
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
    quality.vertices = std::ssize(file_.mesh.vertices);
    quality.turned_tets = file_.turned_tets;
    quality.notes = file_.notes;
    add_quality(file_.mesh, {file_.facets, file_.is_interface}, length_scale, quality);
    return quality;
}

}  // namespace kerf
