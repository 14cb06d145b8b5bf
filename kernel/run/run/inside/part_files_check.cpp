// A part is checked against itself. Its boundary triangles are taken as a surface, and verify_mesh() proves that its
// cells fill that; whether this surface is the one of the input and of the neighbours can be told only with all parts,
// so that boundary vertices, pieces of input facets and interface triangles are kept for it in PartFindings. Arrays and
// headers that follow from the mesh are not compared one by one: the bytes that the mesh would be written as are
// hashed, and their hash must be that of the file. Files may hold any numbers, so that a cell with a vertex twice, or a
// number at the end of its range, must not break the check itself. Triangles are rotated to their smallest vertex, and
// those of interfaces oriented as in the part with the smaller number, so that both sides of one have the same name.
#include "run/run/inside/part_files_check.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "files/part/vtu_reader.h"
#include "files/part/vtu_writer.h"
#include "fill/mesh/verification.h"

namespace kerf {

namespace {

// The boundary of a part as a surface. Its keys hold no more than the file: the facet of the input, or that there is
// none.
SurfaceArrays surface_of(const Part& part) {
    constexpr NodeId some_cut = root_node;
    SurfaceArrays surface;
    surface.vertices.assign(part.mesh.vertices.begin(), part.mesh.vertices.begin() + part.mesh.boundary_vertex_count);
    surface.facets = part.facets;
    surface.patch = part.patch;
    for (const std::int32_t facet : part.facet)
        surface.facet_key.push_back(facet >= 0 ? make_key(input_node, facet) : make_key(some_cut, 0));
    return surface;
}

bool is_vtu(const std::string& path) { return path.ends_with(".vtu"); }

bool has_repeated_vertex(const Tetrahedron& t) {
    return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

void check_boundary_arrays(const Part& part, PartFindings& found) {
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const bool is_between = part.is_interface(f), has_facet = part.is_of_input(f);
        const bool may_be_both = !part.region_names.empty();  // a wall
        const bool is_something = is_between != has_facet || (is_between && may_be_both);
        if (is_something && (!has_facet || part.patch_names.has(part.patch[f]))) continue;
        found.differences.push_back(found.file + " has a boundary triangle without a patch or facet of the input");
        return;
    }
}

void keep_boundary(const Part& part, PartFindings& found) {
    for (std::int32_t v = 0; v < part.mesh.boundary_vertex_count; ++v)
        found.boundary.push_back({part.global_id[v], part.mesh.vertices[v]});
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const Triangle& t = part.facets[f];
        const NamedTriangle g = rotated_to_smallest({part.global_id[t[0]], part.global_id[t[1]], part.global_id[t[2]]});
        if (part.is_of_input(f) || !part.is_interface(f))
            found.pieces.push_back({part.facet[f], part.region_of(0), part.patch[f], g});
        if (part.is_interface(f))
            found.interfaces.push_back({part.id < part.neighbour[f] ? g : reversed(g), part.id, part.neighbour[f]});
    }
}

void keep_interior(const Part& part, PartFindings& found) {
    const std::int64_t boundary = part.mesh.boundary_vertex_count, count = std::ssize(part.global_id) - boundary;
    if (!is_vtu(found.file)) found.unnumbered_interior = count;
    if (!is_vtu(found.file) || count == 0) return;
    const std::int64_t first = part.global_id[boundary];
    for (std::int64_t i = 1; i < count; ++i)
        found.laws.misnumbered += part.global_id[boundary + i - 1] == std::numeric_limits<std::int64_t>::max() ||
                                  part.global_id[boundary + i] != part.global_id[boundary + i - 1] + 1;
    found.interior.push_back({first, count});
}

void add_laws(const MeshLaws& of_mesh, RunVerification& laws) {
    laws.inverted_tets += of_mesh.inverted_tets;
    laws.tets_without_volume += of_mesh.tets_without_volume;
    laws.input_faces_missing += of_mesh.missing_facets;
    laws.extra_boundary_faces += of_mesh.extra_boundary_faces + of_mesh.mismatched_neighbours;
}

}  // namespace

PartFindings PartFilesCheck::operator()(const nlohmann::json& of_report) const {
    const auto leaf = of_report.at("id").get<NodeId>();
    const std::string path = path_of_part(folder_, leaf);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw Error(ErrorCode::io, fmt::format("{} is missing: the part was not meshed. Run kerf mesh again.", path));
    PartFindings found{.file = path.substr(folder_.size() + 1)};
    const auto differs = [&](std::string what) { found.differences.push_back(std::move(what)); };
    Part part = load_part(folder_, leaf, 0);
    found.is_whole = order_ == 1 || is_vtu(found.file) || stored_;
    if (order_ == 2 && !is_vtu(found.file) && stored_)
        part.edge_nodes = stored_->load(stored_->outline().index_of(leaf)).edge_nodes;
    SurfaceArrays surface = surface_of(part);
    const MeshLaws laws = verify_mesh(part.mesh, surface);
    add_laws(laws, found.laws);
    found.laws.tets_zero_parts += part.mesh.tets.empty();
    found.tets = part.tet_count();
    found.volume = laws.volume;
    found.patch_names = part.patch_names;
    found.region_names = part.region_names;
    if (part.id != leaf) differs(fmt::format("{} says that it is part {}", found.file, part.id.value()));
    if (of_report.at("tets") != part.mesh.tets.size() || of_report.at("vertices") != part.mesh.vertices.size())
        differs(fmt::format("report.json has other numbers of part {}", leaf.value()));
    if (found.is_whole && part.order() != order_) differs(fmt::format("{} is of order {}", found.file, part.order()));
    if (part.order() == 2) found.edge_nodes.add(part);
    check_boundary_arrays(part, found);
    if (part.regions.size() > 1) differs(found.file + " has cells of several regions");
    found.hash = {leaf.value(), hash_part(part)};
    if (is_of_this_version_ && found.is_whole) check_what_follows(part, found);
    keep_boundary(part, found);
    keep_interior(part, found);
    return found;
}

// Checks the arrays that follow from the mesh, and all headers: the bytes of the file are those that the mesh would be
// written as.
void PartFilesCheck::check_what_follows(const Part& part, PartFindings& found) const {
    const bool is_valid = std::none_of(part.mesh.tets.begin(), part.mesh.tets.end(), has_repeated_vertex);
    if (is_vtu(found.file) && is_valid &&
        hash_of_file(found.file) != hash_text(hash_of_part(part, read_layout(folder_ + "/" + found.file))))
        found.differences.push_back(found.file + " has arrays that do not follow from its mesh");
    const std::string surface = "parts/" + part_surface_file_name(NodeId(found.hash.leaf));
    std::error_code ignored;
    if (!std::filesystem::exists(folder_ + "/" + surface, ignored)) return;  // the list of files says so
    if (hash_of_file(surface) != hash_text(hash_of_part_surface(part)))
        found.differences.push_back(surface + " is not the surface of its part");
}

std::string PartFilesCheck::hash_of_file(const std::string& path) const {
    const auto known = file_hashes_.find(path);
    return known != file_hashes_.end() ? known->second : describe_file(folder_, path).hash;
}

}  // namespace kerf
