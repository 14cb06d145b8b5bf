// Nothing of the run that wrote the files is trusted but the plan of its parts in report.json. The hashes tell any
// change since then; what follows from the mesh is computed again, in case somebody has computed the hashes again.
#include "run/verify_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/version.h"
#include "io/file_bytes.h"
#include "io/folder_files.h"
#include "io/path_text.h"
#include "io/run_folder.h"
#include "io/run_manifest.h"
#include "mesh/quality.h"
#include "part/run_parts.h"
#include "part/vtu_reader.h"
#include "part/vtu_writer.h"
#include "prepare/oriented_triangle.h"
#include "prepare/remeshing.h"
#include "prepare/surface_nodes.h"
#include "run/edge_node_check.h"
#include "run/input_pieces.h"
#include "run/reported_options.h"
#include "work/mesh_hash.h"

namespace kerf {

namespace {

struct PlacedVertex {
    std::int64_t id;
    Vec3 point;
};

struct InterfaceFacet {
    NamedTriangle vertices;  // oriented as in the part with the smaller number
    std::int32_t part, neighbour;
};

std::string read_report(const std::string& folder) {
    const std::string path = folder + "/report.json";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw Error(ErrorCode::io, fmt::format("{} is not a finished run: it holds no report.json.", folder));
    return read_file(path);
}

// The keys say only what the file has: the facet of the input, or that there is none.
SurfaceArrays surface_of(const Part& part) {
    constexpr NodeId some_cut = 1;
    SurfaceArrays surface;
    surface.vertices.assign(part.mesh.vertices.begin(), part.mesh.vertices.begin() + part.mesh.boundary_vertex_count);
    surface.facets = part.facets;
    surface.patch = part.patch;
    for (const std::int32_t facet : part.facet)
        surface.facet_key.push_back(facet >= 0 ? make_key(0, facet) : make_key(some_cut, 0));
    return surface;
}

bool is_vtu(const std::string& path) { return path.ends_with(".vtu"); }

bool has_repeated_vertex(const Tetrahedron& t) {
    return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

class FolderVerifier {
 public:
    FolderVerifier(const std::string& folder, const VerifyOptions& options)
        : folder_(folder),
          options_(options),
          report_text_(read_report(folder)),
          report_(nlohmann::json::parse(report_text_)),
          is_of_this_version_(report_.at("kerf") == version),
          order_(report_.at("totals").value("order", 1)) {}

    FolderVerification run() {
        check_files();
        for (const auto& part : report_.at("parts")) {
            if (options_.is_cancelled && options_.is_cancelled())
                throw Error(ErrorCode::cancelled, "The verification was cancelled.");
            check_part(part);
        }
        check_pvtu();
        check_shared_vertices();
        check_interfaces();
        check_numbering();
        check_edge_nodes();
        if (!options_.without_input) check_input();
        summarise();
        return std::move(result_);
    }

 private:
    void differs(std::string what) { result_.differences.push_back(std::move(what)); }
    void check_files();
    void check_part(const nlohmann::json& of_report);
    void check_boundary_arrays(const Part& part, const std::string& path);
    void check_what_follows(const Part& part, const std::string& path, const std::string& surface_path);
    void check_pvtu();
    void check_totals();
    void keep_boundary(const Part& part);
    void keep_interior(const Part& part, bool is_numbered);
    void check_shared_vertices();
    void check_interfaces();
    void check_numbering();
    void check_input();
    Vec3 point_of(std::int64_t vertex) const;
    void check_edge_nodes();
    void summarise();

    std::string folder_;
    VerifyOptions options_;
    std::string report_text_;
    nlohmann::json report_;
    bool is_of_this_version_;  // another one may write the same mesh with other headers
    int order_;
    FolderVerification result_;
    double volume_ = 0;
    std::vector<PlacedVertex> boundary_;                  // of all parts; after check_shared_vertices() each once
    std::vector<std::array<std::int64_t, 2>> interiors_;  // first and last + 1 number of every part
    std::int64_t unnumbered_interior_ = 0;                // vertices of files that leave the numbers to who reads them
    std::vector<InputPiece> pieces_;
    std::vector<InterfaceFacet> interfaces_;
    std::vector<std::string> patch_names_, region_names_;  // of the first part
    std::vector<PartHash> hashes_;                         // in the order of the report
    std::unique_ptr<const RunParts> stored_;               // of order 2 without VTU: who knows the nodes on edges
    EdgeNodeCheck edge_nodes_;
};

// The files are those of the list, each with its hash.
void FolderVerifier::check_files() {
    if (!is_sealed(report_text_)) differs("report.json is not as the run has written it");
    std::vector<std::string> present = list_files(folder_), listed = {"report.json"};
    for (const auto& of_report : report_.at("files")) {
        const RunFile file{of_report.at("path"), of_report.at("bytes"), of_report.at("hash")};
        listed.push_back(file.path);
        if (!std::binary_search(present.begin(), present.end(), file.path)) {
            differs(file.path + " is missing");
            continue;
        }
        const RunFile now = describe_file(folder_, file.path);
        if (now.bytes != file.bytes || now.hash != file.hash) differs(file.path + " is not as the run has written it");
    }
    std::sort(listed.begin(), listed.end());
    for (const std::string& file : present)
        if (!std::binary_search(listed.begin(), listed.end(), file) && !file.ends_with('/') &&
            !(file.starts_with("work/") && is_named_like_run_file(file)))  // a kill may have left it
            differs(file + " is no file of the run");
}

void FolderVerifier::check_part(const nlohmann::json& of_report) {
    const auto leaf = of_report.at("id").get<std::int32_t>();
    const std::string path = path_of_part(folder_, leaf), name = path.substr(folder_.size() + 1);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw Error(ErrorCode::io, fmt::format("{} is missing: the part was not meshed. Run kerf mesh again.", path));
    Part part = load_part(folder_, leaf, 0);
    if (order_ == 2 && !is_vtu(name)) {
        if (!stored_) stored_ = std::make_unique<const RunParts>(folder_);
        part.edge_nodes = stored_->load(stored_->outline().index_of(leaf)).edge_nodes;
    }
    SurfaceArrays surface = surface_of(part);
    const MeshLaws laws = verify_mesh(part.mesh, surface);
    result_.laws.inverted_tets += laws.inverted_tets;
    result_.laws.input_faces_missing += laws.missing_facets;
    result_.laws.extra_boundary_faces += laws.extra_boundary_faces + laws.mismatched_neighbours;
    result_.laws.tets_zero_parts += part.mesh.tets.empty();
    result_.tets += static_cast<std::int64_t>(part.mesh.tets.size());
    ++result_.parts;
    volume_ += laws.volume;
    if (part.id != leaf) differs(fmt::format("{} says that it is part {}", name, part.id));
    if (of_report.at("tets") != part.mesh.tets.size() || of_report.at("vertices") != part.mesh.vertices.size())
        differs(fmt::format("report.json has other numbers of part {}", leaf));
    if (part.order() != order_) differs(fmt::format("{} is of order {}", name, part.order()));
    if (part.order() == 2) edge_nodes_.add(part);
    check_boundary_arrays(part, name);
    if (hashes_.empty()) {
        patch_names_ = part.patch_names;
        region_names_ = part.region_names;
    }
    if (part.patch_names != patch_names_) differs(name + " has other names of patches than the parts before it");
    if (part.region_names != region_names_) differs(name + " has other names of regions than the parts before it");
    if (part.regions.size() > 1) differs(name + " has cells of several regions");
    hashes_.push_back({leaf, hash_part(part)});
    if (is_of_this_version_) check_what_follows(part, name, "parts/" + part_surface_file_name(leaf));
    keep_boundary(part);
    keep_interior(part, is_vtu(name));
}

void FolderVerifier::check_boundary_arrays(const Part& part, const std::string& path) {
    const auto patches = static_cast<std::int32_t>(part.patch_names.size());
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const bool is_between = part.is_interface(f), has_facet = part.is_of_input(f);
        const bool may_be_both = !part.region_names.empty();  // a wall
        const bool is_something = is_between != has_facet || (is_between && may_be_both);
        if (is_something && (!has_facet || (part.patch[f] >= 0 && part.patch[f] < patches))) continue;
        differs(fmt::format("{} has a boundary triangle without a patch or facet of the input", path));
        return;
    }
}

// The arrays that follow from the mesh, and all headers: the bytes are those that the mesh would be written as.
void FolderVerifier::check_what_follows(const Part& part, const std::string& path, const std::string& surface_path) {
    const bool is_valid = std::none_of(part.mesh.tets.begin(), part.mesh.tets.end(), has_repeated_vertex);
    if (is_vtu(path) && is_valid &&
        describe_file(folder_, path).hash != hash_text(hash_of_part(part, read_layout(folder_ + "/" + path))))
        differs(path + " has arrays that do not follow from its mesh");
    std::error_code ignored;
    if (!std::filesystem::exists(folder_ + "/" + surface_path, ignored)) return;  // the list of files says so
    if (describe_file(folder_, surface_path).hash != hash_text(hash_of_part_surface(part)))
        differs(surface_path + " is not the surface of its part");
}

void FolderVerifier::check_pvtu() {
    std::vector<std::string> pieces;
    for (const auto& part : report_.at("parts")) pieces.push_back("parts/" + part_file_name(part.at("id")));
    const std::string path = folder_ + "/mesh.pvtu";
    std::error_code ignored;
    if (!is_of_this_version_ || !std::filesystem::exists(path, ignored)) return;
    const VtuLayout layout = pieces.empty() ? VtuLayout() : read_layout(folder_ + "/" + pieces.front());
    if (read_file(path) != pvtu_text(pieces, layout)) differs("mesh.pvtu does not name the parts");
}

// What the report says of the whole.
void FolderVerifier::check_totals() {
    const auto& totals = report_.at("totals");
    if (totals.at("tets") != result_.tets || totals.at("vertices") != result_.vertices ||
        std::abs(totals.at("volume").get<double>() - volume_) > 1e-12 * std::abs(volume_))
        differs("report.json has other totals than the parts");
    if (is_of_this_version_ && report_.at("mesh_hash") != hash_of_parts(hashes_))
        differs("report.json has another mesh_hash than the parts");
    if (report_.at("exit_code") != 0 || report_.at("verification").at("passed") != true)
        differs("report.json is that of a run that has failed");
}

void FolderVerifier::keep_boundary(const Part& part) {
    const auto boundary = static_cast<std::size_t>(part.mesh.boundary_vertex_count);
    for (std::size_t v = 0; v < boundary; ++v) boundary_.push_back({part.global_id[v], part.mesh.vertices[v]});
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const Triangle& t = part.facets[f];
        const NamedTriangle g = rotated_to_smallest({part.global_id[t[0]], part.global_id[t[1]], part.global_id[t[2]]});
        if (part.is_of_input(f) || !part.is_interface(f))
            pieces_.push_back({part.facet[f], part.region_of(0).value(), part.patch[f], g});
        if (part.is_interface(f))
            interfaces_.push_back({part.id < part.neighbour[f] ? g : reversed(g), part.id, part.neighbour[f]});
    }
}

void FolderVerifier::keep_interior(const Part& part, bool is_numbered) {
    const auto boundary = static_cast<std::size_t>(part.mesh.boundary_vertex_count);
    const auto count = static_cast<std::int64_t>(part.global_id.size() - boundary);
    if (!is_numbered) unnumbered_interior_ += count;
    if (!is_numbered || count == 0) return;
    const std::int64_t first = part.global_id[boundary];
    for (std::int64_t i = 0; i < count; ++i)
        result_.laws.misnumbered += part.global_id[boundary + static_cast<std::size_t>(i)] != first + i;
    interiors_.push_back({first, first + count});
}

// The same number means the same coordinates, bit for bit.
void FolderVerifier::check_shared_vertices() {
    std::stable_sort(boundary_.begin(), boundary_.end(),
                     [](const PlacedVertex& a, const PlacedVertex& b) { return a.id < b.id; });
    std::size_t kept = 0;
    for (const PlacedVertex& v : boundary_) {
        if (kept > 0 && boundary_[kept - 1].id == v.id)
            result_.laws.moved_vertices += boundary_[kept - 1].point != v.point;
        else
            boundary_[kept++] = v;
    }
    boundary_.resize(kept);
}

// Every interface triangle lies on two parts in opposite orientation, and each names the other.
void FolderVerifier::check_interfaces() {
    std::sort(interfaces_.begin(), interfaces_.end(), [](const InterfaceFacet& a, const InterfaceFacet& b) {
        return std::tie(a.vertices, a.part) < std::tie(b.vertices, b.part);
    });
    for (std::size_t i = 0, j = 0; i < interfaces_.size(); i = j) {
        while (j < interfaces_.size() && interfaces_[j].vertices == interfaces_[i].vertices) ++j;
        if (j - i != 2) {
            result_.laws.unmatched_interface_faces += static_cast<std::int64_t>(j - i);
            continue;
        }
        const InterfaceFacet &a = interfaces_[i], &b = interfaces_[i + 1];
        result_.laws.wrong_neighbours += a.neighbour != b.part || b.neighbour != a.part;
    }
}

// Boundary numbers fill [0, n), interior ranges follow without a gap.
void FolderVerifier::check_numbering() {
    auto next = static_cast<std::int64_t>(boundary_.size());
    if (!boundary_.empty()) result_.laws.misnumbered += boundary_.back().id + 1 - next;
    std::sort(interiors_.begin(), interiors_.end());
    for (const auto& [first, last] : interiors_) {
        result_.laws.misnumbered += std::abs(first - next);
        next = last;
    }
    result_.vertices = next + unnumbered_interior_;
}

void FolderVerifier::check_edge_nodes() {
    edge_nodes_.finish(result_.vertices, result_.laws);
    result_.nodes = result_.vertices + edge_nodes_.count();
    result_.curved_nodes = edge_nodes_.curved();
    const auto& totals = report_.at("totals");
    if (totals.value("nodes", result_.vertices) != result_.nodes) differs("report.json has another number of nodes");
    if (result_.curved_nodes > totals.value("curved_nodes", std::int64_t{0}))
        differs(fmt::format("{} nodes are not in the middle of their edges, more than report.json has",
                            result_.curved_nodes));
}

// Of one that the parts have on their boundaries.
Vec3 FolderVerifier::point_of(std::int64_t vertex) const {
    return std::lower_bound(boundary_.begin(), boundary_.end(), vertex,
                            [](const PlacedVertex& v, std::int64_t id) { return v.id < id; })
        ->point;
}

// The facets that are no interface must be those of the input, each once, at the same coordinates and in its patch.
void FolderVerifier::check_input() {
    const auto& of_report = report_.at("input");
    Input input;
    try {
        RunOptions options = options_of_report(report_.at("options"));
        options.input_options.cad.on_faces = options.has_curved_edges();
        options.input = options_.input.empty() ? path_of_text(of_report.at("path")) : options_.input;
        input = options_.surface ? *options_.surface : read_input(options.input, options.input_options);
        if (of_report.at("hash") != input.file_hash) {
            result_.not_compared = input.path + " is not what the run has read: its bytes are others.";
            return;
        }
        input = remesh_where_asked(std::move(input), options);
        if (input.is_cad) make_surface_nodes(input, {}, options);  // moves vertices onto the faces
    } catch (const Error& e) {
        result_.not_compared = e.what();
        return;
    }
    std::sort(pieces_.begin(), pieces_.end());
    auto next = std::find_if(pieces_.begin(), pieces_.end(), [](const InputPiece& p) { return p.facet >= 0; });
    result_.laws.extra_boundary_faces += next - pieces_.begin();
    std::int64_t wrong_patches = 0;
    for (std::int32_t f = 0; f < input.complex.facet_count(); ++f) {
        const auto first = next;
        for (; next != pieces_.end() && next->facet == f; ++next)
            wrong_patches += next->patch != input.complex.patch(f);
        result_.laws.input_faces_missing += count_missing_sides(
            input.complex, f, {first, next}, [this](std::int64_t vertex) { return point_of(vertex); });
    }
    if (wrong_patches > 0)
        differs(fmt::format("{} boundary triangles are in other patches than the input", wrong_patches));
    if (patch_names_ != input.patch_names) differs("the parts have other names of patches than the input");
    if (!std::ranges::equal(region_names_, input.complex.region_names()))
        differs("the parts have other names of regions than the input");
    result_.laws.extra_boundary_faces += pieces_.end() - next;
    for (const PlacedVertex& v : boundary_)
        if (v.id < input.vertices)
            result_.laws.moved_vertices += input.complex.point(static_cast<std::int32_t>(v.id)) != v.point;
}

void FolderVerifier::summarise() {
    check_totals();
    RunVerification& laws = result_.laws;
    const double volume = report_.at("input").at("volume");
    laws.volume_rel_error = std::abs(volume_ - volume) / volume;
    constexpr double bound_of_older_reports = 1e-10;
    laws.volume_rel_bound = report_.at("verification").value("volume_rel_bound", bound_of_older_reports);
    laws.passed = laws.all_hold() && result_.differences.empty();
}

}  // namespace

FolderVerification verify_folder(const std::string& folder, const VerifyOptions& options) {
    try {
        return FolderVerifier(folder, options).run();
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::io, fmt::format("{}/report.json is damaged: {}.", folder, e.what()));
    }
}

}  // namespace kerf
