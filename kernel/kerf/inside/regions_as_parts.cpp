// A mesh of arrays becomes a source of parts, one for each region, so that the writers of files, which know parts,
// write it. The arrays have no keys: a vertex is known by its row, and the vertices on the boundary of a region, which
// are listed first in its part, tell what parts share. Parts are numbered as leaves of a tree of one depth, so that no
// number is the ancestor of another. A wall is a triangle of both parts, listed by one of them, and seen from outside
// by each: in the part in front its corners are in the other order. Parts are made anew each time that they are loaded,
// and the constructor loads each once, to count its vertices and nodes.
#include "kerf/inside/regions_as_parts.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/export/whole_mesh.h"
#include "fill/mesh/verification.h"
#include "kerf/inside/array_edge_nodes.h"

namespace kerf {

namespace {

// Returns a triangle as it is seen from outside of the part, which is behind it or in front of it.
std::array<std::int64_t, 3> seen_from(const std::array<std::int64_t, 3>& triangle, bool is_behind) {
    if (is_behind) return triangle;
    return {triangle[0], triangle[2], triangle[1]};
}

void require_32_bits(const MeshArrays& mesh) {
    const std::int64_t most = std::max({std::ssize(mesh.vertices), std::ssize(mesh.tets), std::ssize(mesh.triangles)});
    if (most > most_of_32_bits)
        throw Error(ErrorCode::usage, fmt::format("The mesh has {} tetrahedra, more than are written from memory. Mesh "
                                                  "into a folder, and merge that.",
                                                  mesh.tets.size()));
}

}  // namespace

RegionsAsParts::RegionsAsParts(const MeshArrays& mesh) : mesh_(mesh) {
    const std::size_t region_count = std::max<std::size_t>(1, mesh.region_names.size());
    // Parts are leaves of a tree of one depth, so that no number is the ancestor of another.
    const std::size_t first_leaf = std::bit_ceil(region_count);
    outline_.vertices = vertex_count_of(mesh);
    outline_.order = mesh.quadratic_tets.empty() ? 1 : 2;
    outline_.edge_nodes = mesh.edge_nodes;
    outline_.patch_names = mesh.patch_names;
    outline_.region_names = mesh.region_names;
    require_32_bits(mesh);
    std::vector<std::int64_t> tets(region_count, 0);
    for (const std::int32_t region : mesh.region) ++tets[region];
    std::vector<SharedVertices::Incidence> held;
    std::vector<NodeId> ids;
    for (std::size_t r = 0; r < region_count; ++r) {
        part_of_region_.push_back(tets[r] > 0 ? NodeId(first_leaf + r) : NodeId::none());
        if (tets[r] == 0) continue;
        const PartIndex index(ids.size());
        ids.push_back(part_of_region_[RegionIndex(r)]);
        regions_.push_back(RegionIndex(r));
        for (const std::int64_t v : boundary_vertices_of(RegionIndex(r))) held.push_back({v, index});
        outline_.parts.push_back({ids.back(), 0, tets[r]});
    }
    for (const auto& [behind, in_front] : mesh.sides) {
        const NodeId here = part_of_region_[RegionIndex(behind)];
        const NodeId beyond = in_front < 0 ? NodeId::none() : part_of_region_[RegionIndex(in_front)];
        const bool is_listed_here = is_listed_triangle(0, here, beyond);
        PartExtent& own = outline_.parts[outline_.index_of(here)];
        ++(is_listed_here ? own.patch_facets : own.interface_facets);
        if (!beyond.is_valid()) continue;
        PartExtent& other = outline_.parts[outline_.index_of(beyond)];
        ++(is_listed_here ? other.interface_facets : other.patch_facets);
    }
    shared_ = SharedVertices(std::move(held), ids);
    for (const PartIndex index : outline_.parts.ids()) {
        const Part part = load(index);
        outline_.parts[index].vertices = part.vertex_count();
        outline_.parts[index].edge_nodes = std::ssize(part.edge_nodes.points);
    }
}

// Returns the vertices on the boundary of a region, ascending.
std::vector<std::int64_t> RegionsAsParts::boundary_vertices_of(RegionIndex region) const {
    std::vector<std::int64_t> vertices;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f)
        if (mesh_.sides[f][0] == region.value() || mesh_.sides[f][1] == region.value())
            vertices.insert(vertices.end(), mesh_.triangles[f].begin(), mesh_.triangles[f].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

Part RegionsAsParts::load(PartIndex index) const {
    const RegionIndex region = regions_[index];
    Part part;
    part.id = outline_.parts[index].id;
    part.patch_names = outline_.patch_names;
    part.region_names = NameTable::of_part(outline_.region_names, {region.value()});
    if (!outline_.region_names.empty()) part.regions = {{0, region}};
    part.global_id = boundary_vertices_of(region);
    part.mesh.boundary_vertex_count = count_of(part.global_id);
    std::vector<std::size_t> rows;
    std::vector<std::int32_t> place(mesh_.vertices.size(), -1);
    for (std::size_t v = 0; v < part.global_id.size(); ++v) place[part.global_id[v]] = v;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
        if (mesh_.region[t] != region.value()) continue;
        rows.push_back(t);
        Tetrahedron& tet = part.mesh.tets.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) {
            const std::int64_t id = mesh_.tets[t][i];
            if (place[id] < 0) {
                place[id] = count_of(part.global_id);
                part.global_id.push_back(id);
            }
            tet[i] = place[id];
        }
    }
    for (const std::int64_t id : part.global_id)
        part.mesh.vertices.emplace_back(mesh_.vertices[id][0], mesh_.vertices[id][1], mesh_.vertices[id][2]);
    take_edge_nodes(mesh_, rows, part);
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f)
        for (const int side : {0, 1}) {
            if (mesh_.sides[f][side] != region.value()) continue;
            const std::int32_t beyond = mesh_.sides[f][1 - side];
            Triangle& facet = part.facets.emplace_back();
            const std::array<std::int64_t, 3> corners = seen_from(mesh_.triangles[f], side == 0);
            for (std::size_t i = 0; i < 3; ++i) facet[i] = place[corners[i]];
            part.patch.push_back(mesh_.patch[f]);
            part.facet.push_back(f);
            part.neighbour.push_back(beyond < 0 ? NodeId::none() : part_of_region_[RegionIndex(beyond)]);
        }
    part.tet_at_facet = tets_at_facets(part.mesh, part.facets);
    part.shared = shared_.groups_of(index, std::span(part.global_id).first(part.mesh.boundary_vertex_count));
    return part;
}

}  // namespace kerf
