// Neighbours and quality of the arrays of a mesh. Everything is computed with numbers of 32 bits, as in the kernel;
// larger meshes are refused. Neighbours are found by matching faces, quality cell by cell in groups of 256. The texts
// of `kerf quality` need parts: `MeasuredParts` takes rows of equal `part` as one, with its boundary found by matching
// faces, and knows of a boundary triangle whether another part is behind it, but not which, since quality asks for no
// more.
#include <algorithm>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "files/quality/compared_quality.h"
#include "fill/mesh/faces.h"
#include "kerf/inside/array_edge_nodes.h"
#include "kerf/inside/array_points.h"
#include "kerf/kerf.h"

namespace kerf {

namespace {

constexpr double TetQuality::*measure_members[] = {&TetQuality::min_dihedral_deg,
                                                   &TetQuality::max_dihedral_deg,
                                                   &TetQuality::radius_edge,
                                                   &TetQuality::aspect,
                                                   &TetQuality::shape,
                                                   &TetQuality::volume,
                                                   &TetQuality::min_edge,
                                                   &TetQuality::max_edge};
static_assert(std::size(measure_members) == quality_measures.size());

void require_measurable(const MeshArrays& mesh) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (mesh.vertices.size() > most || mesh.tets.size() > most)
        throw Error(ErrorCode::usage, fmt::format("A mesh of {} vertices and {} tetrahedra is measured part by part in "
                                                  "its run folder, not in memory.",
                                                  mesh.vertices.size(), mesh.tets.size()));
}

// The parts of the arrays, as far as measures of quality ask for them: of a boundary triangle it is known whether
// another part lies behind it, but not which. Keeps a reference to the arrays.
class MeasuredParts : public PartSource {
 public:
    explicit MeasuredParts(const MeshArrays& mesh) : mesh_(mesh) {
        outline_.vertices = vertex_count_of(mesh);
        outline_.region_names = mesh.region_names;
        for (std::int64_t begin = 0, end = 0; begin < std::ssize(mesh.part); begin = end) {
            while (end < std::ssize(mesh.part) && mesh.part[end] == mesh.part[begin]) ++end;
            first_.push_back(begin);
            outline_.parts.push_back({NodeId(mesh.part[begin]), 0, end - begin});
        }
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            if (mesh.sides[t][1] < 0) outer_.push_back(sorted(mesh.triangles[t]));
        std::sort(outer_.begin(), outer_.end());
    }

    const MeshOutline& outline() const override { return outline_; }

    Part load(PartIndex index) const override {
        const PartExtent& extent = outline_.parts[index];
        Part part;
        part.id = extent.id;
        part.regions = {{0, RegionIndex(mesh_.region[first_[index]])}};
        std::vector<std::int32_t> number(mesh_.vertices.size(), -1);
        for (std::size_t t = first_[index]; t < first_[index] + extent.tets; ++t) {
            Tetrahedron& tet = part.mesh.tets.emplace_back();
            for (std::size_t i = 0; i < 4; ++i) tet[i] = local_number(mesh_.tets[t][i], number, part);
        }
        add_facets(part);
        return part;
    }

 private:
    using Corners = std::array<std::int64_t, 3>;

    static Corners sorted(Corners corners) {
        std::sort(corners.begin(), corners.end());
        return corners;
    }

    std::int32_t local_number(std::int64_t vertex, std::vector<std::int32_t>& number, Part& part) const {
        std::int32_t& local = number[vertex];
        if (local < 0) {
            local = count_of(part.global_id);
            part.global_id.push_back(vertex);
            const auto& [x, y, z] = mesh_.vertices[vertex];
            part.mesh.vertices.emplace_back(x, y, z);
        }
        return local;
    }

    void add_facets(Part& part) const {
        match_faces(
            part.mesh, [](FaceSide, FaceSide) {},
            [&](FaceSide side) {
                const Tetrahedron& tet = part.mesh.tets[side.tet()];
                const auto& [a, b, c] = tet_faces[side.corner()];
                part.facets.push_back({tet[a], tet[b], tet[c]});
                const Corners corners =
                    sorted({part.global_id[tet[a]], part.global_id[tet[b]], part.global_id[tet[c]]});
                part.neighbour.push_back(std::binary_search(outer_.begin(), outer_.end(), corners) ? NodeId::none()
                                                                                                   : no_node);
            });
    }

    const MeshArrays& mesh_;
    MeshOutline outline_;
    Array<PartIndex, std::size_t> first_;  // first tetrahedron of each part
    std::vector<Corners> outer_;           // triangles with nothing in front, ascending
};

}  // namespace

std::vector<std::array<std::int64_t, 4>> neighbours_of(const MeshArrays& mesh) {
    require_measurable(mesh);
    std::vector<Tetrahedron> tets(mesh.tets.size());
    std::transform(mesh.tets.begin(), mesh.tets.end(), tets.begin(), narrowed<4>);
    std::vector<std::array<std::int64_t, 4>> neighbours(tets.size(), {-1, -1, -1, -1});
    const auto join = [&](FaceSide a, FaceSide b) {
        neighbours[a.tet().value()][a.corner()] = b.tet().value();
        neighbours[b.tet().value()][b.corner()] = a.tet().value();
    };
    match_faces(mesh.vertices.size(), tets, join, [](FaceSide) {});
    return neighbours;
}

std::vector<double> cell_quality(const MeshArrays& mesh, const std::string& measure) {
    const auto found = std::find_if(quality_measures.begin(), quality_measures.end(),
                                    [&](const Measure& each) { return option_name(each) == measure; });
    if (found == quality_measures.end()) {
        std::vector<std::string> names;
        for (const Measure& each : quality_measures) names.push_back(option_name(each));
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' is no measure of cells. There are {}.", measure, fmt::join(names, ", ")));
    }
    require_measurable(mesh);
    const auto member = measure_members[found - quality_measures.begin()];
    const std::vector<Vec3> points = to_points(mesh.vertices);
    constexpr std::size_t at_once = 256;
    std::array<Tetrahedron, at_once> cells;
    std::array<TetQuality, at_once> measured;
    std::vector<double> values(mesh.tets.size());
    for (std::size_t begin = 0; begin < values.size(); begin += at_once) {
        const std::size_t count = std::min(at_once, values.size() - begin);
        std::transform(&mesh.tets[begin], &mesh.tets[begin] + count, cells.begin(), narrowed<4>);
        measure_cells(points, std::span(cells).first(count), std::span(measured).first(count));
        for (std::size_t i = 0; i < count; ++i) values[begin + i] = measured[i].*member;
    }
    return values;
}

QualityTexts quality_texts(const MeshArrays& mesh) {
    require_measurable(mesh);
    Box box;
    for (const auto& [x, y, z] : std::span(mesh.vertices).first(vertex_count_of(mesh))) box.extend(Vec3(x, y, z));
    const double diagonal = box.diagonal().norm();
    const MeasurableMesh measurable(std::make_unique<MeasuredParts>(mesh), "mesh", diagonal);
    const ComparedQuality quality{measurable.measure(diagonal), {}};
    return {to_text(quality, QualityDetail::brief), to_json(quality, {})};
}

}  // namespace kerf
