// Distributions are counts in fixed fine bins (fill/mesh/quality.h), so a mesh is measured part by part and the counts
// are added; only their range depends on the length scale, which is the diagonal of the whole mesh, or the larger one
// of two that are compared. A run is read a part at a time: the first pass over its surfaces finds the diagonal, the
// second one measures. A part lies in one region, so its cells are counted for that as a whole. Cells of a file are
// sorted by region first, because a distribution takes 92 kB and a file may have many regions: each is counted, reduced
// to percentiles, and forgotten.
#include "files/quality/inside/measured_mesh.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <span>

#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/box.h"
#include "files/part/curved_part.h"
#include "files/part/solution_parts.h"
#include "fill/mesh/adjacency.h"

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
    for (const CellId t : mesh.tets.ids())
        for (std::size_t i = 0; i < tet_faces.size(); ++i)
            if (!mesh.neighbours[t][i].is_valid()) {
                const auto& [a, b, c] = tet_faces[i];
                hull.push_back({mesh.tets[t][a], mesh.tets[t][b], mesh.tets[t][c]});
            }
    mesh.neighbours = {};
    return hull;
}

void add_curved(const Part& part, CurvedCells& curved) {
    for (std::int64_t t = 0; t < part.tet_count(); ++t) {
        const TetNodes nodes = places_of_nodes(part, t);
        if (nodes == straight_nodes({nodes[0], nodes[1], nodes[2], nodes[3]})) continue;
        ++curved.count;
        const CurvedTetJacobian jacobian(nodes);
        if (jacobian.coarse_low() < curved.worst_scaled_jacobian * jacobian.straight())
            curved.worst_scaled_jacobian = std::min(curved.worst_scaled_jacobian, scaled_jacobian(jacobian));
    }
}

// The sums over the cells of a region.
struct RegionSum {
    double volume = 0;
    QualityDistributions cells;
};

void add_cells(const std::vector<Vec3>& points, std::span<const Tetrahedron> cells, RegionSum& sum) {
    constexpr std::size_t at_once = 256;
    std::array<TetQuality, at_once> measured;
    while (!cells.empty()) {
        const std::span<const Tetrahedron> next = cells.first(std::min(at_once, cells.size()));
        measure_cells(points, next, std::span(measured).first(next.size()));
        for (const TetQuality& quality : std::span(measured).first(next.size())) {
            sum.volume += quality.volume;
            sum.cells.add(quality);
        }
        cells = cells.subspan(next.size());
    }
}

RegionQuality region_quality(const std::string& name, const RegionSum& sum) {
    RegionQuality region{name, sum.cells.measures.front().count(), sum.volume};
    for (std::size_t i = 0; i < region.measures.size(); ++i) region.measures[i] = percentiles_of(sum.cells.measures[i]);
    return region;
}

}  // namespace

Percentiles percentiles_of(const Distribution& distribution) {
    Percentiles percentiles;
    std::transform(quality_fractions.begin(), quality_fractions.end(), percentiles.begin(),
                   [&](double fraction) { return distribution.percentile(fraction); });
    return percentiles;
}

MeasurableMesh::MeasurableMesh(const std::string& path) : path_(path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        open_run();
    else
        open_file();
}

MeasurableMesh::MeasurableMesh(std::unique_ptr<const PartSource> parts, std::string name, double diagonal)
    : path_(std::move(name)), run_(std::move(parts)), diagonal_(diagonal) {}

void MeasurableMesh::open_file() {
    file_ = read_tet_file(path_);
    if (file_.facets.empty()) {
        file_.facets = hull_of(file_.mesh);
        file_.is_interface.assign(file_.facets.size(), 0);
    }
    diagonal_ = box_around(file_.mesh.vertices).diagonal().norm();
}

void MeasurableMesh::open_run() {
    run_ = std::make_unique<RunParts>(mesh_in(path_));
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

void MeasurableMesh::measure_run(double length_scale, MeshQuality& quality) const {
    const MeshOutline& outline = run_->outline();
    quality.parts = std::ssize(outline.parts);
    quality.vertices = outline.vertices;
    Array<RegionIndex, RegionSum> sums(outline.region_names.size(), {0, QualityDistributions(length_scale)});
    for (const PartIndex index : outline.parts.ids()) {
        const Part part = run_->load(index);
        add(part, length_scale, quality);
        if (outline.order == 2) add_curved(part, quality.curved ? *quality.curved : quality.curved.emplace());
        if (!sums.empty()) add_cells(part.mesh.vertices, part.mesh.tets, sums[part.region_of(0)]);
    }
    for (const RegionIndex r : sums.ids())
        quality.regions.push_back(region_quality(outline.region_names[r.value()], sums[r]));
}

// Measures one region after the other, since a file may have as many regions as cells.
std::vector<RegionQuality> MeasurableMesh::regions_of_file(double length_scale) const {
    std::vector<std::size_t> end(file_.region_names.size() + 1, 0);  // of the cells of each region, when sorted
    for (const RegionIndex region : file_.region_of_tet) ++end[region.value() + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Tetrahedron> sorted(file_.region_of_tet.size());
    for (std::size_t t = 0; t < sorted.size(); ++t) sorted[end[file_.region_of_tet[t].value()]++] = file_.mesh.tets[t];
    std::vector<RegionQuality> regions;
    for (std::size_t r = 0; r < file_.region_names.size(); ++r) {
        RegionSum sum{0, QualityDistributions(length_scale)};
        const std::size_t begin = r == 0 ? 0 : end[r - 1];
        add_cells(file_.mesh.vertices, std::span(sorted).subspan(begin, end[r] - begin), sum);
        regions.push_back(region_quality(file_.region_names[r], sum));
    }
    return regions;
}

MeshQuality MeasurableMesh::measure(double length_scale) const {
    MeshQuality quality;
    quality.name = path_;
    quality.cells = PartQuality(length_scale);
    if (run_) {
        measure_run(length_scale, quality);
        return quality;
    }
    quality.vertices = std::ssize(file_.mesh.vertices);
    quality.turned_tets = file_.turned_tets;
    quality.notes = file_.notes;
    add_quality(file_.mesh, {file_.facets, file_.is_interface}, length_scale, quality);
    quality.regions = regions_of_file(length_scale);
    return quality;
}

}  // namespace kerf
