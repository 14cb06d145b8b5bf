// The checks here are those that let readers index by the numbers of a file without a check of their own. Global
// numbers are dense: vertices on the boundary of any part come first, then the interior vertices part after part, one
// run each, then the nodes on edges. So interior numbers need a single comparison each, and only those of the boundary
// are sorted to find one that is there twice. Whether the mesh obeys its laws is verify_mesh()'s question.
#include "files/part/part_ranges.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw Error(ErrorCode::verification,
                fmt::format("{} is damaged: {}. Copy the run again, or run kerf mesh again.", path, what));
}

void require_finite(const std::vector<Vec3>& points, const std::string& path) {
    for (std::size_t v = 0; v < points.size(); ++v)
        if (!points[v].allFinite()) fail(path, fmt::format("a coordinate of vertex {} is no number", v));
}

void require_neighbours(const Part& part, const MeshOutline& outline, const std::string& path) {
    std::vector<NodeId> told = part.neighbour;
    std::sort(told.begin(), told.end());
    told.erase(std::unique(told.begin(), told.end()), told.end());
    for (const NodeId id : told)
        if (id.is_valid() && (id == part.id || !outline.find(id)))
            fail(path,
                 fmt::format("a triangle lies between it and part {}, which is no other part of the run", id.value()));
}

// Requires numbers of the boundary from those that come first, each once, and of the inside one after the other.
void require_numbers(const Part& part, const PartStanding& standing, const std::string& path) {
    const std::int64_t boundary = part.mesh.boundary_vertex_count;
    std::vector<std::int64_t> ids(part.global_id.begin(), part.global_id.begin() + boundary);
    std::sort(ids.begin(), ids.end());
    if (!ids.empty() && (ids.front() < 0 || ids.back() >= standing.boundary_vertices))
        fail(path, fmt::format("a vertex of its boundary has the global number {}",
                               ids.front() < 0 ? ids.front() : ids.back()));
    if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
        fail(path, fmt::format("two of its vertices have the global number {}", *twice));
    for (std::int64_t v = boundary; v < std::ssize(part.global_id); ++v)
        if (part.global_id[v] != standing.first_interior_id + v - boundary)
            fail(path, fmt::format("a vertex of its inside has the global number {}", part.global_id[v]));
}

void require_counts(const Part& part, const PartExtent& told, PartContent content, const std::string& path) {
    const std::int64_t vertices = content == PartContent::surface ? part.mesh.boundary_vertex_count : told.vertices;
    const bool has_tets = content == PartContent::all || content == PartContent::cells;
    if (std::ssize(part.global_id) != vertices || (has_tets && part.tet_count() != told.tets))
        fail(path, "it has other numbers of vertices and tetrahedra than report.json");
    if (content != PartContent::vertices && part.id != told.id)
        fail(path, fmt::format("it says that it is part {}, not {}", part.id.value(), told.id.value()));
}

}  // namespace

void require_names(const Part& part, const MeshOutline& outline, const std::string& path) {
    if (!part.patch_names.agrees_with(outline.patch_names) || !part.region_names.agrees_with(outline.region_names))
        fail(path, "it has other names of patches or regions than report.json");
}

void require_ranges(const Part& part, const std::string& path) {
    require_finite(part.mesh.vertices, path);
    require_finite(part.edge_nodes.points, path);
    const auto is_negative = [](std::int64_t id) { return id < 0; };
    if (std::any_of(part.global_id.begin(), part.global_id.end(), is_negative) ||
        std::any_of(part.edge_nodes.global_id.begin(), part.edge_nodes.global_id.end(), is_negative))
        fail(path, "a node has a global number below zero");
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const bool may_have_none = part.patch[f] == -1 && !part.is_of_input(f);
        if (!may_have_none && !part.patch_names.has(part.patch[f]))
            fail(path, fmt::format("triangle {} lies in patch {}, which has no name", f, part.patch[f]));
        if (part.facet[f] < -1 || part.neighbour[f] < NodeId::none() || part.neighbour[f] == no_node ||
            (part.is_on_outer_boundary(f) && !part.is_of_input(f)))
            fail(path, fmt::format("triangle {} lies neither on the surface nor beside a part", f));
    }
}

void require_edge_numbers(const Part& part, const MeshOutline& outline, const std::string& path) {
    std::vector<std::int64_t> ids = part.edge_nodes.global_id;
    std::sort(ids.begin(), ids.end());
    if (!ids.empty() && (ids.front() < outline.vertices || ids.back() >= outline.nodes()))
        fail(path, fmt::format("a node on an edge has the global number {}",
                               ids.front() < outline.vertices ? ids.front() : ids.back()));
    if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
        fail(path, fmt::format("two of its nodes have the global number {}", *twice));
}

void require_ranges(const Part& part, PartContent content, const PartStanding& standing, const std::string& path) {
    require_ranges(part, path);
    if (content != PartContent::vertices) require_names(part, standing.outline, path);
    require_counts(part, standing.outline.parts[standing.index], content, path);
    require_neighbours(part, standing.outline, path);
    require_numbers(part, standing, path);
    require_edge_numbers(part, standing.outline, path);
}

}  // namespace kerf
