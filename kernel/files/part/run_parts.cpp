// A finished run is read from its report and its files: the outline from the report, the counts of triangles, and the
// vertices and edges that parts share, from the surfaces of all parts, which are read once by the constructor. Then any
// part can be loaded alone. Interior vertices have no numbers in stored parts; the first number of each part is the
// count of interior vertices before it, behind the boundary vertices of the whole. A run of order 2 may have stored
// parts, which hold no nodes on edges: their numbers follow from counts in the report and the shared edges, their
// points are middles of edges but for those in the file of curved nodes. A solution has files of its own with its
// parts, but surfaces are those of the run. Each file is verified against the list of the report before it is read, and
// each number against the outline.
#include "files/part/run_parts.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "files/part/curved_nodes_file.h"
#include "files/part/inside/edge_node_reader.h"
#include "files/part/part_store.h"
#include "files/part/run_names.h"
#include "files/part/second_order_parts.h"
#include "files/part/solution_parts.h"
#include "files/part/vtu_reader.h"
#include "fill/mesh/verification.h"

namespace kerf {

namespace {

// Requires parts in the order of the tree, with numbers that can be.
void require_parts(const std::string& folder, const MeshOutline& outline) {
    if (outline.parts.empty()) fail_damaged_report(folder, "it names no parts");
    if (outline.order != 1 && outline.order != 2) fail_damaged_report(folder, "its order is neither 1 nor 2");
    std::int64_t held = 0;  // of all parts: each vertex once or more
    for (const PartExtent& part : outline.parts)
        if (part.id < root_node) fail_damaged_report(folder, fmt::format("there is no part {}", part.id.value()));
    for (const PartIndex index : outline.parts.ids()) {
        const PartExtent& part = outline.parts[index];
        if (outline.find(part.id) != index)
            fail_damaged_report(folder,
                                fmt::format("part {} does not stand in the order of the tree", part.id.value()));
        if (std::min({part.vertices, part.tets, part.edge_nodes}) < 0 ||
            std::max({part.vertices, part.tets, part.edge_nodes}) > std::numeric_limits<std::int32_t>::max())
            fail_damaged_report(folder, fmt::format("it has numbers of part {} that cannot be", part.id.value()));
        held += part.vertices;
    }
    for (const PartExtent& part : outline.parts)
        if (part.tets == 0)
            throw Error(ErrorCode::io,
                        fmt::format("Part {} of {} has no tetrahedra: kerf decompose makes none, and a run of kerf "
                                    "mesh that has not ended goes on by kerf mesh --resume {}.",
                                    part.id.value(), folder, folder));
    if (outline.vertices < 0 || outline.vertices > held)
        fail_damaged_report(folder, fmt::format("it has {} vertices, and its parts {}", outline.vertices, held));
}

// Returns the outline that the report tells; it does not count triangles.
MeshOutline outline_of(const std::string& folder, const nlohmann::json& report) {
    if (is_of_solution(report))
        throw Error(ErrorCode::usage,
                    fmt::format("{} is a solution of kerf solve, and here a run of kerf mesh is asked "
                                "for. Name {}, on which it stands.",
                                folder, mesh_in(folder)));
    MeshOutline outline;
    try {
        outline.vertices = report.at("totals").at("vertices");
        outline.order = report.at("totals").value("order", 1);
        RunNames names = RunNames::of_report(report);
        outline.patch_names = std::move(names.patches);
        outline.region_names = std::move(names.regions);
        outline.patch_types = std::move(names.patch_types);
        for (const auto& of_part : report.at("parts")) {
            outline.parts.push_back({of_part.at("id"), of_part.at("vertices"), of_part.at("tets")});
            PartExtent& extent = outline.parts.back();
            extent.edge_nodes = of_part.value("nodes", extent.vertices) - extent.vertices;
        }
    } catch (const nlohmann::json::exception& e) {
        fail_damaged_report(folder, e.what());
    }
    require_parts(folder, outline);
    return outline;
}

// Requires that a part has the edges that were told of it: the numbers of nodes on edges follow from them.
void require_edges(const EdgeTable& edges, const PartExtent& told, const Part& part) {
    const auto has_edge = [&](const UndirectedEdge& edge) { return edges.contains(undirected(edge[0], edge[1])); };
    const auto has_edges = [&](const SharedEdgeGroup& group) {
        return std::all_of(group.edges.begin(), group.edges.end(), has_edge);
    };
    if (std::ssize(edges) == told.edge_nodes &&
        std::all_of(part.shared_edges.begin(), part.shared_edges.end(), has_edges))
        return;
    throw Error(ErrorCode::io,
                fmt::format("The files of part {} do not belong together. Run kerf mesh again.", part.id.value()));
}

}  // namespace

RunParts::RunParts(std::string folder, std::string solution)
    : RunParts(folder, std::move(solution), read_report_json(folder)) {}

RunParts::RunParts(std::string folder, std::string solution, const nlohmann::json& report)
    : files_(folder, report), outline_(outline_of(folder, report)) {
    if (!solution.empty()) {
        solution_files_.emplace(solution, read_report_json(solution));
        outline_.values = read_value_names(part_file(PartIndex()));
        outline_.order = read_point_counts(part_file(PartIndex())).order;
    }
    std::vector<SharedVertices::Incidence> held;
    std::vector<SharedEdges::Incidence> told;
    std::vector<NodeId> ids;
    std::int64_t interior = 0;
    boundary_vertices_ = outline_.vertices;  // until it is known how many there are
    if (outline_.patch_names.empty())        // of an older version: each file has all
        outline_.patch_names = read_part(surface_file(PartIndex()), PartContent::surface).patch_names.names();
    for (PartExtent& extent : outline_.parts) {
        const PartIndex index(ids.size());
        ids.push_back(extent.id);
        Part surface = this->surface(index);
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            ++(surface.is_listed(f) ? extent.patch_facets : extent.interface_facets);
            if (!surface.is_interface(f)) continue;
            for (const std::int32_t v : surface.facets[f]) held.push_back({surface.global_id[v], index});
        }
        for (const std::int32_t v : surface.contact_vertices) held.push_back({surface.global_id[v], index});
        const std::vector<SharedEdges::Incidence> incidences_here = SharedEdges::incidences_of(surface);
        told.insert(told.end(), incidences_here.begin(), incidences_here.end());
        first_interior_ids_.push_back(interior);
        interior += extent.vertices - surface.mesh.boundary_vertex_count;
    }
    boundary_vertices_ = outline_.vertices - interior;
    if (boundary_vertices_ < 0) fail_damaged_report(files_.folder(), "it has fewer vertices than its parts");
    for (std::int64_t& first : first_interior_ids_) first += boundary_vertices_;
    shared_edges_ = SharedEdges(std::move(told), ids);
    shared_ = SharedVertices(std::move(held), ids);
    if (outline_.order == 2) number_edges();
}

// Numbers the edges from the count of edges of each part, and from those that it shares.
void RunParts::number_edges() {
    if (is_stored(PartIndex())) curved_nodes_ = read_curved_nodes(files_.verified(curved_nodes_name));
    std::vector<EdgeNumbers::OfPart> told;
    for (const PartIndex index : outline_.parts.ids()) {
        PartExtent& extent = outline_.parts[index];
        if (!is_stored(index)) extent.edge_nodes = read_point_counts(part_file(index)).on_edges;
        told.push_back(
            EdgeNumbers::told_by(extent.id, shared_edges_.groups_of(surface(index)), extent.edge_nodes, outline_));
    }
    edge_numbers_ = EdgeNumbers(outline_, told);
    outline_.edge_nodes = edge_numbers_.total();
}

PartStanding RunParts::standing(PartIndex index) const {
    const bool is_known = std::cmp_less(index.value(), first_interior_ids_.size());  // else surfaces are being read
    return {outline_, index, boundary_vertices_, is_known ? first_interior_ids_[index] : 0};
}

bool RunParts::is_stored(PartIndex index) const {
    return path_of_part(files_of_parts().folder(), outline_.parts[index].id).ends_with(".part");
}

std::string RunParts::part_file(PartIndex index) const {
    const ListedFiles& files = files_of_parts();
    return files.verified(path_of_part_in(files.folder(), outline_.parts[index].id));
}

std::string RunParts::surface_file(PartIndex index) const {
    return files_.verified("parts/" + part_surface_file_name(outline_.parts[index].id));
}

Part RunParts::surface(PartIndex index, PartContent content) const {
    const std::string path = surface_file(index);
    Part surface = read_part(path, content);
    require_ranges(surface, PartContent::surface, standing(index), path);
    return surface;
}

Part RunParts::load(PartIndex index) const {
    const std::string path = part_file(index);
    Part part = load_part_file(path, first_interior_ids_[index]);
    require_ranges(part, PartContent::all, standing(index), path);
    part.shared = shared_.groups_of(index, std::span(part.global_id).first(part.mesh.boundary_vertex_count));
    part.shared_edges = shared_edges_.groups_of(part);
    if (solution_files_) part.values = read_values(path);
    if (outline_.order == 2 && is_stored(index)) {
        require_edges(EdgeTable(part.mesh.tets, part.mesh.vertices.size()), outline_.parts[index], part);
        add_edge_nodes(edge_numbers_, curved_nodes_, part);
    }
    return part;
}

Part RunParts::load_only(PartIndex index, PartContent content) const {
    const bool needs_all = outline_.order == 2 && is_stored(index);  // nodes follow from cells and vertices
    if (content == PartContent::all || needs_all) return load(index);
    if (content != PartContent::surface) {
        const std::string path = part_file(index);
        Part part = load_part_file(path, first_interior_ids_[index], content);
        require_ranges(part, content, standing(index), path);
        return part;
    }
    Part surface = this->surface(index, content);
    if (outline_.order == 2) {
        const std::string path = part_file(index);
        add_edge_nodes_of_surface(path, surface);
        require_edge_numbers(surface, outline_, path);
    }
    return surface;
}

std::string path_of_part_in(const std::string& folder, NodeId id) {
    std::string vtu = "parts/" + part_file_name(id), stored = "parts/" + stored_part_file_name(id);
    std::error_code ignored;
    const bool has_vtu = std::filesystem::exists(folder + "/" + vtu, ignored);
    return has_vtu || !std::filesystem::exists(folder + "/" + stored, ignored) ? vtu : stored;
}

std::string path_of_part(const std::string& folder, NodeId id) { return folder + "/" + path_of_part_in(folder, id); }

Part load_part(const std::string& folder, NodeId id, std::int64_t first_interior_id, PartContent content) {
    return load_part_file(path_of_part(folder, id), first_interior_id, content);
}

Part load_part_file(const std::string& path, std::int64_t first_interior_id, PartContent content) {
    if (path.ends_with(".part")) return read_stored_part(path, first_interior_id, content);
    Part part = read_part(path, content);
    if (content == PartContent::all || content == PartContent::cells)
        part.tet_at_facet = tets_at_facets(part.mesh, part.facets);
    return part;
}

}  // namespace kerf
