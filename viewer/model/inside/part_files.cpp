// A measure that the file of a part holds is read alone, without the cells. Only else are cells read, or those at hand
// taken, and the measure is computed. Files of a run under way (".part") and runs of other formats have no such arrays,
// nor global numbers of interior vertices, which are -1 then. Surfaces of parts are joined by the global numbers of
// their vertices, never by coordinates; a facet whose neighbour lies below the same node is inside and left out. The
// interface of a facet is that of the lowest common ancestor of the two parts, which follows from their numbers alone,
// since the children of node n are 2n and 2n + 1. The worst cells are gathered in a heap of fixed size, one part in
// memory at a time; a second pass over the few parts that have some of them finds their centres. Every file is checked
// by checked_file() before it is read.
#include "viewer/model/inside/part_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/io/run_folder.h"
#include "files/part/part_ranges.h"
#include "files/part/run_parts.h"
#include "files/part/vtu_reader.h"
#include "fill/mesh/adjacency.h"
#include "fill/mesh/quality.h"
#include "fill/mesh/verification.h"
#include "viewer/model/inside/checked_files.h"
#include "viewer/model/inside/part_edges.h"

namespace kerf::view {

namespace {

std::vector<char> tets_at_interfaces(const Part& file) {
    std::vector<char> is_on_interface(file.mesh.vertices.size(), 0);
    for (std::size_t f = 0; f < file.facets.size(); ++f)
        if (file.is_interface(f))
            for (const std::int32_t v : file.facets[f]) is_on_interface[v] = 1;
    std::vector<char> at_interface;
    at_interface.reserve(file.mesh.tets.size());
    for (const Tetrahedron& tet : file.mesh.tets)
        at_interface.push_back(
            std::any_of(tet.begin(), tet.end(), [&](std::int32_t v) { return is_on_interface[v] != 0; }));
    return at_interface;
}

double measure(const TetQuality& quality, ColorBy color) {
    switch (color) {
        case ColorBy::min_dihedral:
            return quality.min_dihedral_deg;
        case ColorBy::radius_edge:
            return quality.radius_edge;
        case ColorBy::aspect:
            return quality.aspect;
        case ColorBy::shape:
            return quality.shape;
        case ColorBy::volume:
            return quality.volume;
        case ColorBy::edge_length:
            return quality.max_edge;
        default:
            return std::numeric_limits<double>::quiet_NaN();
    }
}

float value_of_tet(const std::vector<Vec3>& p, const Tetrahedron& t, ColorBy color) {
    return static_cast<float>(measure(tet_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]), color));
}

std::vector<float> values_of_tets(const TetMesh& mesh, ColorBy color) {
    std::vector<float> values;
    values.reserve(mesh.tets.size());
    for (const Tetrahedron& tet : mesh.tets) values.push_back(value_of_tet(mesh.vertices, tet, color));
    return values;
}

std::vector<float> origins_of_tets(std::int64_t count, std::int64_t core_tets) {
    std::vector<float> origins;
    origins.reserve(count);
    for (std::int64_t i = 0; i < count; ++i) origins.push_back(static_cast<float>(origin_of(i, core_tets)));
    return origins;
}

// Whether a file has arrays of measures; the files of parts that are not finished, or of runs in other formats, have
// none.
bool has_arrays(const std::string& path) { return path.ends_with(".vtu"); }

std::string checked_part(const std::string& folder, NodeId part) {
    return checked_file(folder, path_of_part_in(folder, part));
}

Part read_checked_part(const std::string& folder, NodeId part) {
    const std::string path = checked_part(folder, part);
    Part file = load_part_file(path, 0);
    require_ranges(file, path);
    return file;
}

Part read_checked_surface(const std::string& folder, NodeId part) {
    const std::string path = checked_file(folder, "parts/" + part_surface_file_name(part));
    Part file = read_part(path);
    require_ranges(file, path);
    return file;
}

}  // namespace

std::string part_file_of(const std::string& folder, NodeId part) { return path_of_part(folder, part); }

NodeId common_ancestor(NodeId a, NodeId b) {
    while (a != b) {
        NodeId& lower = a > b ? a : b;
        lower = parent_of(lower);
    }
    return a;
}

NodeSurface read_part_surface(const std::string& folder, NodeId part, std::vector<std::string>* patch_names) {
    Part file = read_checked_surface(folder, part);
    if (patch_names) *patch_names = file.patch_names.filled();
    NodeSurface surface;
    surface.interface_of.reserve(file.facets.size());
    for (std::size_t f = 0; f < file.neighbour.size(); ++f)
        surface.interface_of.push_back(
            !file.is_interface(f) || file.is_wall(f) ? no_node : common_ancestor(part, file.neighbour[f]));
    surface.vertices = std::move(file.mesh.vertices);
    surface.facets = std::move(file.facets);
    surface.patch = std::move(file.patch);
    surface.neighbour = std::move(file.neighbour);
    surface.facet_number = std::move(file.facet);
    surface.vertex_number = std::move(file.global_id);
    return surface;
}

void add_edge_nodes(const std::string& folder, NodeId part, NodeSurface& surface) {
    const Part file = read_checked_part(folder, part);
    if (file.facets.size() != surface.facets.size())
        throw Error(ErrorCode::io, fmt::format("{} has {} triangles, but its surface {}.", part_file_of(folder, part),
                                               file.facets.size(), surface.facets.size()));
    add_edges(file, surface);
}

NodeSurface join_part_surfaces(const std::string& folder, NodeId node, const std::vector<PartBelow>& parts) {
    NodeSurface whole;
    std::unordered_map<std::int64_t, std::int32_t> vertex_of_number;
    const auto vertex = [&](const NodeSurface& part, std::int32_t v) {
        const auto [place, is_new] = vertex_of_number.try_emplace(part.vertex_number[v], count_of(whole.vertices));
        if (is_new) {
            whole.vertices.push_back(part.vertices[v]);
            whole.vertex_number.push_back(part.vertex_number[v]);
        }
        return place->second;
    };
    for (const auto& [id, at_hand] : parts) {
        const std::shared_ptr<const NodeSurface> part =
            at_hand ? at_hand : std::make_shared<const NodeSurface>(read_part_surface(folder, id));
        for (std::size_t f = 0; f < part->facets.size(); ++f) {
            if (part->neighbour[f].is_valid() && lies_below(part->neighbour[f], node)) continue;
            const Triangle& t = part->facets[f];
            whole.facets.push_back({vertex(*part, t[0]), vertex(*part, t[1]), vertex(*part, t[2])});
            whole.patch.push_back(part->patch[f]);
            whole.interface_of.push_back(part->interface_of[f]);
            whole.facet_number.push_back(part->facet_number[f]);
        }
    }
    return whole;
}

PartCells read_part_cells(const PartSource& source) {
    Part file = read_checked_part(source.nodes.empty() ? source.folder : source.nodes, source.part);
    connect_tets(file.mesh);
    PartCells cells;
    add_edges(file, cells);
    cells.part = source.part;
    cells.core_tets = source.core_tets;
    cells.tet_at_facet = std::move(file.tet_at_facet);
    cells.at_interface = tets_at_interfaces(file);
    cells.vertices = std::move(file.mesh.vertices);
    cells.boundary_vertex_count = file.mesh.boundary_vertex_count;
    cells.tets = std::move(file.mesh.tets);
    cells.neighbours = std::move(file.mesh.neighbours);
    cells.vertex_number = std::move(file.global_id);
    if (!has_arrays(part_file_of(source.folder, source.part)))  // nor numbers for who does not know all other parts
        std::fill(cells.vertex_number.begin() + cells.boundary_vertex_count, cells.vertex_number.end(), -1);
    return cells;
}

const char* stored_array(ColorBy color) {
    switch (color) {
        case ColorBy::min_dihedral:
            return "MinDihedralAngle";
        case ColorBy::radius_edge:
            return "RadiusEdgeRatio";
        case ColorBy::aspect:
            return "AspectRatio";
        case ColorBy::shape:
            return "Shape";
        default:
            return nullptr;
    }
}

std::vector<float> values_of_cells(const PartCells& cells, ColorBy color) {
    if (color == ColorBy::kind) return {cells.at_interface.begin(), cells.at_interface.end()};
    if (color == ColorBy::origin) return origins_of_tets(cells.tets.size(), cells.core_tets);
    std::vector<float> values;
    values.reserve(cells.tets.size());
    for (const Tetrahedron& tet : cells.tets) values.push_back(value_of_tet(cells.vertices, tet, color));
    return values;
}

std::vector<float> read_values_of_cells(const PartSource& source, ColorBy color, const PartCells* cells) {
    const std::string path = checked_part(source.folder, source.part);
    if (const char* array = stored_array(color); array && has_arrays(path) && has_cell_values(path, array))
        return read_cell_values(path, array, 0, read_cell_counts(path).tets);
    if (cells) return values_of_cells(*cells, color);
    const Part file = read_checked_part(source.folder, source.part);
    if (color == ColorBy::origin) return origins_of_tets(file.mesh.tets.size(), source.core_tets);
    if (color != ColorBy::kind) return values_of_tets(file.mesh, color);
    const std::vector<char> at_interface = tets_at_interfaces(file);
    return {at_interface.begin(), at_interface.end()};
}

std::vector<float> read_values_at_facets(const PartSource& source, ColorBy color, const PartCells* cells) {
    const std::string path = checked_part(source.folder, source.part);
    if (const char* array = stored_array(color); array && has_arrays(path) && has_cell_values(path, array)) {
        const PartCellCounts counts = read_cell_counts(path);
        return read_cell_values(path, array, counts.tets, counts.facets);
    }
    PartCells read;
    if (!cells) cells = &(read = read_part_cells(source));
    const std::vector<float> all = values_of_cells(*cells, color);
    std::vector<float> values;
    values.reserve(cells->tet_at_facet.size());
    for (const std::int32_t tet : cells->tet_at_facet)
        values.push_back(tet < 0 ? std::numeric_limits<float>::quiet_NaN() : all[tet]);
    return values;
}

std::vector<WorstCell> find_worst_cells(const std::string& folder, const std::vector<NodeId>& parts, ColorBy color,
                                        std::size_t count, const std::function<bool()>& is_stale) {
    const bool small_is_bad = color == ColorBy::min_dihedral || color == ColorBy::shape;
    const auto is_worse = [&](const WorstCell& a, const WorstCell& b) {
        if (a.value != b.value) return (a.value < b.value) == small_is_bad;
        return a.part != b.part ? a.part < b.part : a.cell < b.cell;
    };
    std::vector<WorstCell> worst;  // a heap with the best of them in front
    for (const NodeId part : parts) {
        if (is_stale()) return {};
        const std::vector<float> values = read_values_of_cells({folder, part}, color, nullptr);
        for (std::int32_t i = 0; i < count_of(values); ++i) {
            if (std::isnan(values[i])) continue;
            const WorstCell cell{part, i, values[i], Vec3::Zero()};
            if (worst.size() == count && (count == 0 || !is_worse(cell, worst.front()))) continue;
            if (worst.size() == count) {
                std::pop_heap(worst.begin(), worst.end(), is_worse);
                worst.pop_back();
            }
            worst.push_back(cell);
            std::push_heap(worst.begin(), worst.end(), is_worse);
        }
    }
    std::sort_heap(worst.begin(), worst.end(), is_worse);
    for (const NodeId part : parts) {
        const auto is_in_part = [part](const WorstCell& cell) { return cell.part == part; };
        if (std::none_of(worst.begin(), worst.end(), is_in_part)) continue;
        if (is_stale()) return {};
        const Part file = read_checked_part(folder, part);
        for (WorstCell& cell : worst) {
            if (!is_in_part(cell)) continue;
            for (const std::int32_t v : file.mesh.tets.at(cell.cell)) cell.center += file.mesh.vertices[v] / 4;
        }
    }
    return worst;
}

Eigen::AlignedBox3d box_of_parts(const std::string& folder, const std::vector<NodeId>& parts) {
    Eigen::AlignedBox3d box;
    for (const NodeId part : parts)
        for (const Vec3& p : read_checked_surface(folder, part).mesh.vertices) box.extend(p);
    return box;
}

}  // namespace kerf::view
