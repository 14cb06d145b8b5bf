// Nothing of the run that wrote the files is trusted but the plan of its parts in report.json. The hashes tell any
// change since then; all that follows from the mesh is computed again, in case somebody has computed the hashes again.
// Each part is checked by itself, on threads (run/run/inside/part_files_check.h), and only its boundary is kept:
// vertices, interface triangles and pieces of input facets of all parts are then sorted and compared, so that memory
// follows the surface. These laws of the whole are left out where a part cannot be read, as each of them would only
// repeat that.
#include "run/run/verify_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "base/core/threads.h"
#include "base/core/version.h"
#include "files/io/file_bytes.h"
#include "files/io/folder_files.h"
#include "files/io/json.h"
#include "files/io/listed_files.h"
#include "files/io/path_text.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "files/part/run_names.h"
#include "files/part/run_parts.h"
#include "files/part/solution_parts.h"
#include "files/part/vtu_reader.h"
#include "files/part/vtu_writer.h"
#include "run/prepare/remeshing.h"
#include "run/prepare/surface_nodes.h"
#include "run/run/inside/edge_node_check.h"
#include "run/run/inside/input_pieces.h"
#include "run/run/inside/number_distance.h"
#include "run/run/inside/part_files_check.h"
#include "run/run/inside/reported_options.h"
#include "run/work/mesh_hash.h"

namespace kerf {

namespace {

std::string read_report(const std::string& folder) {
    const std::string path = folder + "/report.json";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        const bool is_interrupted = std::filesystem::exists(RunFolder::saved_run_file(folder), ignored);
        throw Error(ErrorCode::io, fmt::format("{} is not a finished run: {}.", folder,
                                               is_interrupted ? "it was interrupted, and kerf mesh --resume " + folder +
                                                                    " goes on with it"
                                                              : "it holds no report.json"));
    }
    return read_file(path);
}

struct ComparedFiles {
    std::vector<std::string> differences;
    std::vector<std::string> other_files;       // paths of files that are missing or changed
    std::map<std::string, std::string> hashes;  // by path: as the files are now
};

// The files of a folder are those of its report's list, each with its hash.
ComparedFiles compare_files(const std::string& folder, const std::string& report_text) {
    ComparedFiles compared;
    const auto differs = [&](std::string what) { compared.differences.push_back(std::move(what)); };
    if (!is_sealed(report_text)) {
        differs("report.json is not as the run has written it");
        compared.other_files.push_back("report.json");
    }
    const std::vector<std::string> present = list_files(folder);
    const std::vector<RunFile> listed = files_of_report(parse_json(report_text));
    std::vector<std::optional<RunFile>> found(listed.size());
    for_each_on_threads(listed.size(), [&](std::size_t i) {
        if (std::binary_search(present.begin(), present.end(), listed[i].path))
            found[i] = describe_file(folder, listed[i].path);
    });
    std::vector<std::string> known = {"report.json"};
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const RunFile& file = listed[i];
        known.push_back(file.path);
        const bool is_other = !found[i] || found[i]->bytes != file.bytes || found[i]->hash != file.hash;
        if (is_other) differs(file.path + (found[i] ? " is not as the run has written it" : " is missing"));
        if (is_other) compared.other_files.push_back(file.path);
        if (found[i]) compared.hashes[file.path] = found[i]->hash;
    }
    std::sort(known.begin(), known.end());
    for (const std::string& file : present)
        if (!std::binary_search(known.begin(), known.end(), file) && !file.ends_with('/') &&
            !(file.starts_with("work/") && is_named_like_run_file(file)))  // a kill may have left it
            differs(file + " is no file of the run");
    return compared;
}

// Whether an error says that a file is not as the run has written it, whatever its hash is.
bool is_damage(const Error& error) { return error.code() == ErrorCode::io || error.code() == ErrorCode::verification; }

struct CheckedPart {
    std::optional<PartFindings> found;
    std::string why_not = {};  // reason why it cannot be read
};

CheckedPart checked_part(const PartFilesCheck& check, const nlohmann::json& of_report) {
    try {
        return {check(of_report)};
    } catch (const Error& error) {
        if (!is_damage(error)) throw;
        return {{}, error.what()};
    }
}

// Returns the beginning of the paths of all files of a part.
std::string stem_of_part_files(NodeId part) {
    const std::string name = part_file_name(part);
    return "parts/" + name.substr(0, name.rfind('.') + 1);
}

class FolderVerifier {
 public:
    FolderVerifier(const std::string& folder, const VerifyOptions& options)
        : folder_(folder),
          options_(options),
          report_text_(read_report(folder)),
          report_(parse_json(report_text_)),
          is_of_this_version_(report_.at("kerf") == version),
          order_(report_.at("totals").value("order", 1)),
          names_(RunNames::of_report(report_)) {}

    FolderVerification run() {
        check_files();
        check_parts();
        if (unread_parts_ == 0) {
            check_pvtu();
            check_shared_vertices();
            check_interfaces();
            check_numbering();
            check_edge_nodes();
            if (!options_.without_input) check_input();
            summarise();
        }
        return std::move(result_);
    }

 private:
    void differs(std::string what) { result_.differences.push_back(std::move(what)); }
    void check_files();
    void check_parts();
    std::unique_ptr<const RunParts> stored_parts();
    void cannot_read(const std::vector<std::string>& files, const std::string& why);
    void take(PartFindings found);
    void end_if_cancelled() const;
    void check_pvtu();
    void check_totals();
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
    bool is_of_this_version_;  // another version may write the same mesh with other headers
    int order_;
    FolderVerification result_;
    double volume_ = 0;
    std::vector<PlacedVertex> boundary_;  // vertices of all parts; after check_shared_vertices() each once
    std::vector<std::array<std::int64_t, 2>> interiors_;  // first number and count of every part
    std::int64_t unnumbered_interior_ = 0;  // vertices inside, of files that leave their numbers to the reader
    std::vector<InputPiece> pieces_;
    std::vector<InterfaceFacet> interfaces_;
    RunNames names_;
    std::vector<PartHash> hashes_;                    // in the order of the report
    std::map<std::string, std::string> file_hashes_;  // by path: as the files are now
    std::vector<std::string> other_files_;            // paths of files that are missing or changed
    std::int64_t unread_parts_ = 0;
    EdgeNodeCheck edge_nodes_;
};

void FolderVerifier::check_files() {
    ComparedFiles compared = compare_files(folder_, report_text_);
    result_.differences = std::move(compared.differences);
    file_hashes_ = std::move(compared.hashes);
    other_files_ = std::move(compared.other_files);
}

void FolderVerifier::end_if_cancelled() const {
    if (options_.is_cancelled && options_.is_cancelled())
        throw Error(ErrorCode::cancelled, "The verification was cancelled.");
}

// Notes a file that cannot be read as a difference, unless that follows from another one: a file whose path begins with
// one of `files`, without which it cannot be read, is missing or changed.
void FolderVerifier::cannot_read(const std::vector<std::string>& files, const std::string& why) {
    const auto is_needed = [&](const std::string& path) {
        return std::any_of(files.begin(), files.end(), [&](const std::string& file) { return path.starts_with(file); });
    };
    if (std::none_of(other_files_.begin(), other_files_.end(), is_needed)) differs(why);
}

// The parts with their nodes on edges, of a run of order 2 without VTU. Null for other runs, and where files that are
// needed for it are damaged.
std::unique_ptr<const RunParts> FolderVerifier::stored_parts() {
    const nlohmann::json& parts = report_.at("parts");
    const auto is_stored = [&](const auto& part) { return path_of_part(folder_, part.at("id")).ends_with(".part"); };
    if (order_ != 2 || std::none_of(parts.begin(), parts.end(), is_stored)) return nullptr;
    try {
        return std::make_unique<RunParts>(folder_);
    } catch (const Error& error) {
        if (!is_damage(error)) throw;
        cannot_read({"report.json", "parts/"}, error.what());
        return nullptr;
    }
}

// Checks each part by itself, on threads; findings are taken in the order of the report, each as soon as all before it
// are there.
void FolderVerifier::check_parts() {
    const nlohmann::json& parts = report_.at("parts");
    const std::unique_ptr<const RunParts> stored = stored_parts();
    const PartFilesCheck check(folder_, order_, is_of_this_version_, file_hashes_, stored.get());
    const auto caller = std::this_thread::get_id();  // the only one that may ask who waits
    std::mutex mutex;
    std::vector<std::optional<CheckedPart>> checked(parts.size());
    std::size_t next = 0;
    for_each_on_threads(parts.size(), [&](std::size_t i) {
        if (std::this_thread::get_id() == caller) end_if_cancelled();
        CheckedPart of_part = checked_part(check, parts[i]);
        const std::lock_guard lock(mutex);
        checked[i] = std::move(of_part);
        for (; next < checked.size() && checked[next]; ++next) {
            CheckedPart here = *std::exchange(checked[next], {});
            unread_parts_ += !here.found || !here.found->is_whole;
            if (here.found)
                take(*std::move(here.found));
            else
                cannot_read({stem_of_part_files(parts[next].at("id"))}, here.why_not);
        }
    });
    if (unread_parts_ > 0)
        differs(fmt::format("{} of {} parts cannot be read: laws of the whole were not checked", unread_parts_,
                            parts.size()));
}

void FolderVerifier::take(PartFindings found) {
    for (std::string& difference : found.differences) differs(std::move(difference));
    for (const RunLaw& law : run_laws) result_.laws.*law.count += found.laws.*law.count;
    ++result_.parts;
    result_.tets += found.tets;
    volume_ += found.volume;
    if (names_.patches.empty()) names_.patches = found.patch_names.names();
    if (!found.patch_names.agrees_with(names_.patches))
        differs(found.file + " has other names of patches than the run");
    if (!found.region_names.agrees_with(names_.regions))
        differs(found.file + " has other names of regions than the run");
    hashes_.push_back(found.hash);
    boundary_.insert(boundary_.end(), found.boundary.begin(), found.boundary.end());
    pieces_.insert(pieces_.end(), found.pieces.begin(), found.pieces.end());
    interfaces_.insert(interfaces_.end(), found.interfaces.begin(), found.interfaces.end());
    interiors_.insert(interiors_.end(), found.interior.begin(), found.interior.end());
    unnumbered_interior_ += found.unnumbered_interior;
    edge_nodes_.add(found.edge_nodes);
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

// Compares the totals of the report with those of the parts.
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

// Vertices of the same number must have the same coordinates, bit for bit.
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

// Every interface triangle must lie on two parts in opposite orientation, and each must name the other.
void FolderVerifier::check_interfaces() {
    sort_on_threads(interfaces_, [](const InterfaceFacet& a, const InterfaceFacet& b) {
        return std::tie(a.vertices, a.part, a.neighbour) < std::tie(b.vertices, b.part, b.neighbour);
    });
    for (std::size_t i = 0, j = 0; i < interfaces_.size(); i = j) {
        while (j < interfaces_.size() && interfaces_[j].vertices == interfaces_[i].vertices) ++j;
        if (j - i != 2) {
            result_.laws.unmatched_interface_faces += j - i;
            continue;
        }
        const InterfaceFacet &a = interfaces_[i], &b = interfaces_[i + 1];
        result_.laws.wrong_neighbours += a.neighbour != b.part || b.neighbour != a.part;
    }
}

// The numbers of boundary vertices must fill [0, n), and the ranges of the parts' inner ones follow without a gap.
void FolderVerifier::check_numbering() {
    std::int64_t next = std::ssize(boundary_);
    if (!boundary_.empty())
        result_.laws.misnumbered +=
            number_distance(boundary_.front().id, 0) + number_distance(boundary_.back().id, next - 1);
    std::sort(interiors_.begin(), interiors_.end());
    for (const auto& [first, count] : interiors_) {
        result_.laws.misnumbered += number_distance(first, next);
        next += count;
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

// The place of a vertex that some part has on its boundary.
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
        RunRequest options = options_of_report(report_.at("options"));
        options.input_options.cad.on_faces = options.has_curved_edges();
        options.input = options_.input.empty() ? path_of_text(of_report.at("path")) : options_.input;
        input = options_.surface ? *options_.surface : read_input(options.input, options.input_options);
        if (of_report.at("hash") != input.file_hash) {
            result_.not_compared = input.path + " is not what the run has read: its bytes are others.";
            return;
        }
        input = remesh_where_asked(std::move(input), options);
        result_.laws.changed_volumes = count_changed_volumes(input);
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
    if (names_.patches != input.patch_names) differs("the run has other names of patches than the input");
    if (!std::ranges::equal(names_.regions, input.complex.region_names()))
        differs("the run has other names of regions than the input");
    result_.laws.extra_boundary_faces += pieces_.end() - next;
    for (const PlacedVertex& v : boundary_)
        if (v.id >= 0 && v.id < input.vertices) result_.laws.moved_vertices += input.complex.point(v.id) != v.point;
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

// The folder of the solution, if it is one. A run whose report is damaged counts as a run: all of its differences are
// told.
std::optional<std::string> find_solution(const std::string& folder) {
    const std::string path = folder + "/report.json";
    std::error_code ignored;
    const bool is_run = std::filesystem::exists(path, ignored) && !is_of_solution(parse_json_or_null(read_file(path)));
    return is_run ? std::nullopt : find_solution_folder(folder);
}

FolderVerification verify_solution(const std::string& folder, const VerifyOptions& options) {
    const std::string text = read_report(folder);
    const std::string mesh = mesh_of_solution(folder);
    FolderVerification found = FolderVerifier(mesh, options).run();
    found.mesh = mesh;
    found.solution_differences = compare_files(folder, text).differences;
    if (parse_json(text).at("exit_code") != 0)
        found.solution_differences.push_back("report.json is that of a solution that did not reach its tolerance");
    return found;
}

}  // namespace

FolderVerification verify_folder(const std::string& folder, const VerifyOptions& options) {
    try {
        if (const std::optional<std::string> solution = find_solution(folder))
            return verify_solution(*solution, options);
        return FolderVerifier(folder, options).run();
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::verification,
                    fmt::format("{}/report.json is damaged: {}. Copy the run again, or run kerf mesh again.", folder,
                                e.what()));
    }
}

}  // namespace kerf
