// Files for kerf-view of surfaces and meshes that are in memory. A mesh is taken apart
// (kerf/inside/parts_from_arrays.h) and written as the parts and the report of a run. It does not know its cuts, but
// numbers of parts are nodes of a binary tree, so that the tree above the parts follows from halving the numbers;
// counts are added up along it, and each inner node gets a plane between the centroids of its children, by which the
// viewer pulls parts apart. Of a surface with several regions OBJ holds no sides: its patches are divided into groups
// that each have the same pair of regions, and a JSON beside it names the pairs.
#include "kerf/viewed_files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include <nlohmann/json.hpp>

#include "base/core/ids.h"
#include "base/core/unique_name.h"
#include "files/io/json.h"
#include "files/io/obj_writer.h"
#include "files/io/path_text.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "files/io/text_file.h"
#include "files/part/vtu_writer.h"
#include "files/quality/quality_json.h"
#include "kerf/inside/array_edge_nodes.h"
#include "kerf/inside/parts_from_arrays.h"
#include "run/prepare/input.h"
#include "run/prepare/input_files.h"
#include "run/report/cut_json.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

// The counts of a part, which are added up over the parts below a node.
struct ViewedCounts {
    std::int64_t vertices = 0, facets = 0, tets = 0;
    double volume = 0;
    std::int32_t parts = 0;
    std::set<std::int32_t> regions;
    Vec3 sum = Vec3::Zero();  // sum of the points on the surfaces

    Vec3 centroid() const { return sum / vertices; }

    void add(const ViewedCounts& other) {
        vertices += other.vertices;
        facets += other.facets;
        tets += other.tets;
        volume += other.volume;
        parts += other.parts;
        regions.insert(other.regions.begin(), other.regions.end());
        sum += other.sum;
    }
};

ViewedCounts counts_of(const Part& part) {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t v = 0; v < part.mesh.boundary_vertex_count; ++v) sum += part.mesh.vertices[v];
    return {part.mesh.boundary_vertex_count,
            std::ssize(part.facets),
            part.tet_count(),
            enclosed_volume(part.mesh.vertices, part.facets),
            1,
            {part.region_of(0).value()},
            sum};
}

Json part_to_view(NodeId id, const ViewedCounts& part, bool has_regions) {
    Json json = {{"id", id},
                 {"rank", 0},
                 {"surface_vertices", part.vertices},
                 {"surface_faces", part.facets},
                 {"surface_volume", part.volume},
                 {"tets", part.tets}};
    if (has_regions) json["region"] = *part.regions.begin();
    return json;
}

// Returns a cut where one may have been, so that parts can be pulled apart: a mesh does not know its cuts.
CutSummary cut_between(const ViewedCounts& below, const ViewedCounts& above) {
    CutSummary cut;
    const Vec3 from = below.centroid(), to = above.centroid();
    cut.strategy = CutStrategy::first_try;
    cut.plane = Plane((from + to) / 2, from == to ? Vec3(Vec3::UnitX()) : Vec3((to - from).normalized()));
    return cut;
}

Json node_to_view(NodeId id, const std::map<NodeId, ViewedCounts>& nodes) {
    const ViewedCounts& below = nodes.at(id);
    const Vec3 centroid = below.centroid();
    const bool is_part = !nodes.contains(child_of(id, 0));
    Json json = {{"id", id},
                 {"children", is_part ? Json::array() : Json(halves_of(id))},
                 {"leaves", below.parts},
                 {"regions", below.regions.size()},
                 {"vertices", below.vertices},
                 {"faces", below.facets},
                 {"volume", below.volume},
                 {"centroid", {centroid.x(), centroid.y(), centroid.z()}},
                 {"eigenvalues", {0, 0, 0}},
                 {"axes", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    if (!is_part) json["cut"] = json_of_cut(cut_between(nodes.at(child_of(id, 0)), nodes.at(child_of(id, 1))));
    return json;
}

Json report_to_view(const MeshArrays& mesh, const std::map<NodeId, ViewedCounts>& parts) {
    std::map<NodeId, ViewedCounts> nodes;
    for (const auto& [id, part] : parts)
        for (NodeId node = id; node >= root_node; node = parent_of(node)) nodes[node].add(part);
    Json tree = Json::array(), of_parts = Json::array(), regions = Json::array();
    for (const auto& [id, counts] : nodes) tree.push_back(node_to_view(id, nodes));
    for (const auto& [id, part] : parts) of_parts.push_back(part_to_view(id, part, !mesh.region_names.empty()));
    for (const std::string& name : mesh.region_names) regions.push_back({{"name", path_text(name)}});
    const Json input = {{"path", name_of_arrays},
                        {"faces", mesh.triangles.size()},
                        {"vertices", vertex_count_of(mesh)},
                        {"volume", nodes.at(root_node).volume},
                        {"regions", regions}};
    return {{"input", input},
            {"options", Json::object()},
            {"tree", tree},
            {"parts", of_parts},
            {"totals", {{"tets", mesh.tets.size()}, {"vertices", vertex_count_of(mesh)}}},
            {"quality", quality_json(PartQuality(1))},
            {"exit_code", 0}};
}

// Patches, divided into groups where they bound several pairs of regions, and the regions of each group.
struct WallGroups {
    std::vector<std::int32_t> group;  // of each facet
    std::vector<std::string> names;   // of groups; without blanks, which OBJ cannot hold
    Json regions = Json::object();    // as read_named_walls() takes it
};

WallGroups group_walls(const Complex& complex, const std::vector<std::string>& patch_names) {
    WallGroups walls;
    std::map<std::tuple<std::int32_t, RegionIndex, RegionIndex>, std::int32_t> known;  // patch and regions
    std::set<std::string> taken;
    const auto side = [&](RegionIndex region) {
        return region.is_valid() ? Json(complex.region_names()[region.value()]) : Json(nullptr);
    };
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const auto [low, high] = std::minmax({complex.sides(f).back, complex.sides(f).front});
        const auto next = count_of(walls.names);
        const auto [group, is_new] = known.insert({{complex.patch(f), low, high}, next});
        walls.group.push_back(group->second);
        if (!is_new) continue;
        std::string name = patch_names[complex.patch(f)];
        std::replace(name.begin(), name.end(), ' ', '_');
        walls.names.push_back(unique_name(name, taken));
        walls.regions[walls.names.back()] = {side(low), side(high)};
    }
    return walls;
}

}  // namespace

void write_surface_to_view(const ClosedSurface& surface, const std::string& path) {
    const Complex& complex = surface.input().complex;
    SurfaceArrays arrays = complex.arrays();
    std::vector<std::string> names = surface.patch_names();
    if (complex.region_count() > 1) {
        WallGroups walls = group_walls(complex, names);
        write_text_file(walls_path(path), json_text(walls.regions));
        arrays.patch = std::move(walls.group);
        names = std::move(walls.names);
    }
    write_obj(path, arrays.vertices, arrays.facets, arrays.patch, names);
}

void write_mesh_to_view(const MeshArrays& mesh, const std::string& folder) {
    if (mesh.tets.empty()) throw Error(ErrorCode::usage, "The mesh has no tetrahedra: there is nothing to be seen.");
    std::map<NodeId, ViewedCounts> parts;
    Json files = Json::array();
    const auto list = [&](const std::string& path) {
        const RunFile file = describe_file(folder, path);
        files.push_back({{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}});
    };
    for_each_part_of(mesh, [&](const Part& part) {
        parts[part.id] = counts_of(part);
        const std::string of_part = "parts/" + part_file_name(part.id);
        const std::string of_surface = "parts/" + part_surface_file_name(part.id);
        const std::string file = folder + "/" + of_part;
        std::error_code error;
        std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
        if (error) throw Error(ErrorCode::io, folder + ": the folder cannot be made: " + error.message() + ".");
        write_part(file, part, {.has_regions = !mesh.region_names.empty()});
        write_part_surface(folder + "/" + of_surface, part);
        list(of_part);
        list(of_surface);
    });
    Json report = report_to_view(mesh, parts);
    report["files"] = std::move(files);
    write_text_file(folder + "/report.json", sealed(json_text(report, 2) + "\n"));
}

}  // namespace kerf
