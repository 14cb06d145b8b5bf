// Nothing of the run that wrote the files is trusted but the plan of its parts in report.json.
#include "run/verify_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/file_bytes.h"
#include "io/run_folder.h"
#include "io/vtu_reader.h"
#include "mesh/adjacency.h"
#include "run/oriented_triangle.h"
#include "surface/facet_cover.h"

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

// A boundary triangle that lies on a facet of the input: the facet itself, or a piece of it.
struct InputPiece {
    std::int32_t facet;
    NamedTriangle vertices;
    bool operator<(const InputPiece& o) const { return std::tie(facet, vertices) < std::tie(o.facet, o.vertices); }
};

nlohmann::json read_report(const std::string& folder) {
    const std::string path = folder + "/report.json";
    if (!std::filesystem::exists(path))
        throw Error(ErrorCode::io, fmt::format("{} is not a finished run: it holds no report.json.", folder));
    try {
        return nlohmann::json::parse(read_file(path));
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::io, fmt::format("{} is damaged: {}.", path, e.what()));
    }
}

class FolderVerifier {
 public:
    explicit FolderVerifier(const std::string& folder) : folder_(folder), report_(read_report(folder)) {}

    FolderVerification run() {
        for (const auto& part : report_.at("parts")) check_part(part.at("id").get<std::int32_t>());
        check_shared_vertices();
        check_interfaces();
        check_numbering();
        check_input();
        summarise();
        return std::move(result_);
    }

 private:
    void check_part(std::int32_t leaf);
    void keep_boundary(const PartFile& part);
    void check_shared_vertices();
    void check_interfaces();
    void check_numbering();
    void check_input();
    bool is_facet(const Surface& input, std::int32_t facet, std::span<const InputPiece> pieces) const;
    void summarise();

    std::string folder_;
    nlohmann::json report_;
    FolderVerification result_;
    double volume_ = 0;
    std::vector<PlacedVertex> boundary_;                  // of all parts; after check_shared_vertices() each once
    std::vector<std::array<std::int64_t, 2>> interiors_;  // first and last + 1 number of every part
    std::vector<InputPiece> pieces_;
    std::vector<InterfaceFacet> interfaces_;
};

void FolderVerifier::check_part(std::int32_t leaf) {
    const std::string path = folder_ + "/parts/" + part_file_name(leaf);
    if (!std::filesystem::exists(path))
        throw Error(ErrorCode::io, fmt::format("{} is missing: the part was not meshed. Run kerf mesh again.", path));
    PartFile part = read_part(path);
    SurfaceArrays surface;
    surface.vertices.assign(part.mesh.vertices.begin(), part.mesh.vertices.begin() + part.mesh.boundary_vertex_count);
    surface.facets = part.facets;
    connect_tets(part.mesh);
    const MeshLaws laws = verify_mesh(part.mesh, surface);
    result_.laws.inverted_tets += laws.inverted_tets;
    result_.laws.input_faces_missing += laws.missing_facets;
    result_.laws.extra_boundary_faces += laws.extra_boundary_faces + laws.mismatched_neighbours;
    result_.laws.tets_zero_parts += part.mesh.tets.empty();
    result_.tets += static_cast<std::int64_t>(part.mesh.tets.size());
    ++result_.parts;
    volume_ += laws.volume;
    keep_boundary(part);
}

void FolderVerifier::keep_boundary(const PartFile& part) {
    const auto boundary = static_cast<std::size_t>(part.mesh.boundary_vertex_count);
    for (std::size_t v = 0; v < boundary; ++v) boundary_.push_back({part.global_id[v], part.mesh.vertices[v]});
    if (boundary < part.global_id.size()) {
        const std::int64_t first = part.global_id[boundary];
        const auto count = static_cast<std::int64_t>(part.global_id.size() - boundary);
        for (std::int64_t i = 0; i < count; ++i)
            result_.misnumbered += part.global_id[boundary + static_cast<std::size_t>(i)] != first + i;
        interiors_.push_back({first, first + count});
    }
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const Triangle& t = part.facets[f];
        const NamedTriangle g = rotated_to_smallest({part.global_id[t[0]], part.global_id[t[1]], part.global_id[t[2]]});
        if (part.neighbour[f] < 0)
            pieces_.push_back({part.facet[f], g});
        else
            interfaces_.push_back({part.part < part.neighbour[f] ? g : reversed(g), part.part, part.neighbour[f]});
    }
}

// The same number means the same coordinates, bit for bit.
void FolderVerifier::check_shared_vertices() {
    std::stable_sort(boundary_.begin(), boundary_.end(),
                     [](const PlacedVertex& a, const PlacedVertex& b) { return a.id < b.id; });
    std::size_t kept = 0;
    for (const PlacedVertex& v : boundary_) {
        if (kept > 0 && boundary_[kept - 1].id == v.id)
            result_.moved_vertices += boundary_[kept - 1].point != v.point;
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
        result_.wrong_neighbours += a.neighbour != b.part || b.neighbour != a.part;
    }
}

// Boundary numbers fill [0, n), interior ranges follow without a gap.
void FolderVerifier::check_numbering() {
    auto next = static_cast<std::int64_t>(boundary_.size());
    if (!boundary_.empty()) result_.misnumbered += boundary_.back().id + 1 - next;
    std::sort(interiors_.begin(), interiors_.end());
    for (const auto& [first, last] : interiors_) {
        result_.misnumbered += std::abs(first - next);
        next = last;
    }
    result_.vertices = next;
}

// True if the pieces are the facet itself, or cover it with new vertices on the way.
bool FolderVerifier::is_facet(const Surface& input, std::int32_t facet, std::span<const InputPiece> pieces) const {
    const Triangle t = input.vertices(facet);
    if (pieces.size() == 1) return pieces[0].vertices == rotated_to_smallest({t[0], t[1], t[2]});
    std::vector<std::array<Vec3, 3>> corners;
    for (const InputPiece& piece : pieces) {
        std::array<Vec3, 3>& corner = corners.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
            corner[i] = std::lower_bound(boundary_.begin(), boundary_.end(), piece.vertices[i],
                                         [](const PlacedVertex& v, std::int64_t id) { return v.id < id; })
                            ->point;
    }
    return covers({input.point(t[0]), input.point(t[1]), input.point(t[2])}, corners);
}

InputOptions input_options_of(const nlohmann::json& options) {
    InputOptions of_input;
    for (const OptionField& field : input_option_fields(of_input))
        if (const auto value = options.find(field.name); value != options.end())
            field.set_text(value->is_string() ? value->get<std::string>() : value->dump());
    return of_input;
}

// The facets that are no interface must be those of the input, each once, at the same coordinates.
void FolderVerifier::check_input() {
    const std::string path = report_.at("input").at("path");
    Input input;
    try {
        input = read_input(path, input_options_of(report_.at("options")));
    } catch (const Error& e) {
        result_.notes.push_back(fmt::format("The facets were not compared with the input: {}", e.what()));
        return;
    }
    std::sort(pieces_.begin(), pieces_.end());
    auto next = std::find_if(pieces_.begin(), pieces_.end(), [](const InputPiece& p) { return p.facet >= 0; });
    result_.laws.extra_boundary_faces += next - pieces_.begin();
    for (std::int32_t f = 0; f < input.surface.facet_count(); ++f) {
        const auto first = next;
        while (next != pieces_.end() && next->facet == f) ++next;
        result_.laws.input_faces_missing += !is_facet(input.surface, f, {first, next});
    }
    result_.laws.extra_boundary_faces += pieces_.end() - next;
    for (const PlacedVertex& v : boundary_)
        if (v.id < input.vertices)
            result_.moved_vertices += input.surface.point(static_cast<std::int32_t>(v.id)) != v.point;
}

void FolderVerifier::summarise() {
    RunVerification& laws = result_.laws;
    const double volume = report_.at("input").at("volume");
    laws.volume_rel_error = std::abs(volume_ - volume) / volume;
    laws.passed =
        laws.all_hold() && result_.moved_vertices == 0 && result_.misnumbered == 0 && result_.wrong_neighbours == 0;
}

}  // namespace

FolderVerification verify_folder(const std::string& folder) {
    try {
        return FolderVerifier(folder).run();
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::io, fmt::format("{}/report.json is damaged: {}.", folder, e.what()));
    }
}

}  // namespace kerf
