#include "part/run_parts.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/file_bytes.h"
#include "io/json.h"
#include "io/run_folder.h"
#include "mesh/verification.h"
#include "part/curved_nodes_file.h"
#include "part/edge_node_reader.h"
#include "part/part_store.h"
#include "part/second_order_parts.h"
#include "part/vtu_reader.h"

namespace kerf {

namespace {

nlohmann::json read_report(const std::string& folder) {
    const std::string path = folder + "/report.json";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw Error(ErrorCode::io,
                    fmt::format("{} is not a finished run: it holds no report.json. Name the folder that "
                                "kerf mesh -o was given.",
                                folder));
    return parse_json(read_file(path));
}

// What the report says of the whole; triangles are not counted in it.
MeshOutline read_outline(const std::string& folder) {
    MeshOutline outline;
    try {
        const nlohmann::json report = read_report(folder);
        outline.vertices = report.at("totals").at("vertices");
        outline.order = report.at("totals").value("order", 1);
        for (const auto& of_part : report.at("parts")) {
            outline.parts.push_back({of_part.at("id"), of_part.at("vertices"), of_part.at("tets")});
            PartExtent& extent = outline.parts.back();
            extent.edge_nodes = of_part.value("nodes", extent.vertices) - extent.vertices;
        }
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::io,
                    fmt::format("{}/report.json is damaged: {}. Run kerf mesh again.", folder, e.what()));
    }
    for (const PartExtent& part : outline.parts)
        if (part.tets == 0)
            throw Error(ErrorCode::io,
                        fmt::format("Part {} of {} has no tetrahedra: kerf decompose makes none, and a run of kerf "
                                    "mesh that has not ended goes on by kerf mesh --resume {}.",
                                    part.id, folder, folder));
    return outline;
}

// The numbers of nodes on edges follow from what was told of these.
void require_edges(const EdgeTable& edges, const PartExtent& told, const Part& part) {
    const auto has_edge = [&](const UndirectedEdge& edge) { return edges.contains(undirected(edge[0], edge[1])); };
    const auto has_edges = [&](const SharedEdgeGroup& group) {
        return std::all_of(group.edges.begin(), group.edges.end(), has_edge);
    };
    if (std::ssize(edges) == told.edge_nodes &&
        std::all_of(part.shared_edges.begin(), part.shared_edges.end(), has_edges))
        return;
    throw Error(ErrorCode::io,
                fmt::format("The files of part {} do not belong together. Run kerf mesh again.", part.id));
}

}  // namespace

RunParts::RunParts(std::string folder, std::string solution)
    : folder_(std::move(folder)), solution_(std::move(solution)), outline_(read_outline(folder_)) {
    if (!solution_.empty()) {
        outline_.values = read_value_names(path_of_part(solution_, outline_.parts.front().id));
        outline_.order = read_point_counts(path_of_part(solution_, outline_.parts.front().id)).order;
    }
    std::vector<SharedVertices::Incidence> held;
    std::vector<SharedEdges::Incidence> told;
    std::vector<NodeId> ids;
    std::int64_t interior = 0;
    for (PartExtent& extent : outline_.parts) {
        const PartIndex index(ids.size());
        ids.push_back(extent.id);
        Part surface = read_part(folder_ + "/parts/" + part_surface_file_name(extent.id));
        for (std::size_t f = 0; f < surface.facets.size(); ++f) {
            ++(surface.is_listed(f) ? extent.patch_facets : extent.interface_facets);
            if (!surface.is_interface(f)) continue;
            for (const std::int32_t v : surface.facets[f]) held.push_back({surface.global_id[v], index});
        }
        for (const std::int32_t v : surface.contact_vertices) held.push_back({surface.global_id[v], index});
        const std::vector<SharedEdges::Incidence> incidences_here = SharedEdges::incidences_of(surface);
        told.insert(told.end(), incidences_here.begin(), incidences_here.end());
        outline_.patch_names = std::move(surface.patch_names);
        outline_.region_names = std::move(surface.region_names);
        first_interior_ids_.push_back(interior);
        interior += extent.vertices - surface.mesh.boundary_vertex_count;
    }
    for (std::int64_t& first : first_interior_ids_) first += outline_.vertices - interior;
    shared_edges_ = SharedEdges(std::move(told), ids);
    shared_ = SharedVertices(std::move(held), ids);
    if (outline_.order == 2) number_edges();
}

// Of a part it has to be known how many edges it has, and which of them it shares.
void RunParts::number_edges() {
    if (is_stored(PartIndex())) curved_nodes_ = read_curved_nodes(curved_nodes_file(folder_));
    std::vector<EdgeNumbers::OfPart> told;
    for (const PartIndex index : outline_.parts.ids()) {
        PartExtent& extent = outline_.parts[index];
        if (!is_stored(index)) extent.edge_nodes = read_point_counts(part_file(index)).on_edges;
        const Part surface = read_part(folder_ + "/parts/" + part_surface_file_name(extent.id));
        told.push_back(EdgeNumbers::told_by(extent.id, shared_edges_.groups_of(surface), extent.edge_nodes, outline_));
    }
    edge_numbers_ = EdgeNumbers(outline_, told);
    outline_.edge_nodes = edge_numbers_.total();
}

std::string RunParts::part_file(PartIndex index) const {
    return path_of_part(parts_folder(), outline_.parts[index].id);
}

Part RunParts::load(PartIndex index) const {
    Part part = load_part(parts_folder(), outline_.parts[index].id, first_interior_ids_[index]);
    part.shared = shared_.groups_of(index, std::span(part.global_id).first(part.mesh.boundary_vertex_count));
    part.shared_edges = shared_edges_.groups_of(part);
    if (!solution_.empty()) part.values = read_values(part_file(index));
    if (outline_.order == 2 && is_stored(index)) {
        require_edges(EdgeTable(part.mesh.tets, part.mesh.vertices.size()), outline_.parts[index], part);
        add_edge_nodes(edge_numbers_, curved_nodes_, part);
    }
    return part;
}

Part RunParts::load_only(PartIndex index, PartContent content) const {
    const bool needs_all = outline_.order == 2 && is_stored(index);  // nodes follow from cells and vertices
    if (content == PartContent::all || needs_all) return load(index);
    const NodeId id = outline_.parts[index].id;
    if (content != PartContent::surface) return load_part(parts_folder(), id, first_interior_ids_[index], content);
    Part surface = read_part(folder_ + "/parts/" + part_surface_file_name(id), content);
    if (outline_.order == 2) add_edge_nodes_of_surface(part_file(index), surface);
    return surface;
}

std::string path_of_part(const std::string& folder, NodeId id) {
    const std::string vtu = folder + "/parts/" + part_file_name(id);
    const std::string stored = folder + "/parts/" + stored_part_file_name(id);
    std::error_code ignored;
    return std::filesystem::exists(vtu, ignored) || !std::filesystem::exists(stored, ignored) ? vtu : stored;
}

Part load_part(const std::string& folder, NodeId id, std::int64_t first_interior_id, PartContent content) {
    const std::string path = path_of_part(folder, id);
    if (path.ends_with(".part")) return read_stored_part(path, first_interior_id, content);
    Part part = read_part(path, content);
    if (content == PartContent::all || content == PartContent::cells)
        part.tet_at_facet = tets_at_facets(part.mesh, part.facets);
    return part;
}

}  // namespace kerf
