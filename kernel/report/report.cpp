#include "report/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/number_text.h"
#include "core/version.h"
#include "core/words.h"
#include "io/path_text.h"
#include "quality/quality_json.h"
#include "report/cut_json.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json rows(const Eigen::Matrix3d& m) {
    Json json = Json::array();
    for (int i = 0; i < 3; ++i) json.push_back(to_json(Vec3(m.row(i).transpose())));
    return json;
}

Json columns(const Eigen::Matrix3d& m) { return rows(m.transpose()); }

Json input_json(const Input& input) {
    Json json = {{"path", path_text(std::filesystem::absolute(input.path).lexically_normal().string())},
                 {"hash", input.file_hash},
                 {"vertices", input.vertices},
                 {"faces", input.facets},
                 {"components", input.components},
                 {"genus", input.genus},
                 {"volume", input.volume},
                 {"area", input.area},
                 {"repairs",
                  {{"vertices_welded", input.repairs.welded_vertices},
                   {"vertices_unused", input.repairs.unused_vertices},
                   {"facets_dropped", input.repairs.dropped_facets},
                   {"vertices_merged", input.repairs.merged_vertices},
                   {"facets_removed", input.repairs.removed_facets},
                   {"holes_filled", input.repairs.filled_holes},
                   {"facets_added", input.repairs.added_facets},
                   {"facets_flipped", input.orientation.facets_flipped},
                   {"shells_flipped", input.orientation.shells_flipped}}}};
    if (!input.notes.empty()) json["notes"] = input.notes;
    if (input.moved_vertices > 0)
        json["optimisation"] = {{"vertices_moved", input.moved_vertices}, {"largest_move", input.largest_move}};
    if (input.remeshed)
        json["remeshing"] = {{"facets_before", input.remeshed->facets_before},
                             {"smallest_angle_before_deg", input.remeshed->smallest_angle_before_deg},
                             {"smallest_angle_deg", input.remeshed->smallest_angle_deg},
                             {"deviation", input.remeshed->deviation},
                             {"distance_to_input", input.remeshed->distance_to_input},
                             {"distance_from_input", input.remeshed->distance_from_input},
                             {"feature_edges", input.remeshed->feature_edges}};
    return json;
}

Json options_json(RunOptions options) {
    Json json = Json::object();
    for (const OptionField& field : option_fields(options))
        json[field.name] = std::visit(
            [](const auto& value) -> Json {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, OptionField::Choice>)
                    return value.names[value.get()];
                else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string*>)
                    return path_text(*value);
                else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Length*>)
                    return value->is_percent() ? Json(value->text()) : Json(value->number());
                else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, OptionField::List>) {
                    Json items = Json::array();
                    for (const std::string& item : *value) items.push_back(path_text(item));
                    return items;
                } else
                    return *value;
            },
            field.value);
    return json;
}

Json node_json(const TreeNode& node) {
    Json json = {{"id", node.id},
                 {"parent", node.id / 2},
                 {"children", node.cut_made ? Json{2 * node.id, 2 * node.id + 1} : Json::array()},
                 {"level", static_cast<int>(std::log2(node.id))},
                 {"leaves", node.leaves},
                 {"vertices", node.vertices},
                 {"faces", node.facets},
                 {"volume", node.mass.volume},
                 {"centroid", to_json(node.mass.centroid)},
                 {"inertia", rows(node.mass.inertia)},
                 {"eigenvalues", to_json(node.mass.eigenvalues)},
                 {"axes", columns(node.mass.axes)}};
    if (node.cut_tried) json["cut"] = json_of_cut(node);
    return json;
}

// What it has gained a second is told by what a hundredth of the cells has at most.
Json improvement_json(const Improvement& done, const ImprovedAngles& angles, double seconds) {
    if (!angles.known()) return nullptr;
    const double gain = angles.p1_after_deg - angles.p1_before_deg;
    return {{"removed_edges", done.removed_edges},
            {"moved_vertices", done.moved_vertices},
            {"new_vertices", done.new_vertices},
            {"bad_cells_before", done.bad_cells_before},
            {"bad_cells_after", done.bad_cells_after},
            {"min_dihedral_deg_before", angles.min_before_deg},
            {"min_dihedral_deg_after", angles.min_after_deg},
            {"p1_dihedral_deg_before", angles.p1_before_deg},
            {"p1_dihedral_deg_after", angles.p1_after_deg},
            {"seconds", seconds},
            {"p1_dihedral_deg_per_second", seconds > 0 ? gain / seconds : 0}};
}

Json part_json(const PartReport& part, const std::string& wanted_mesher) {
    Json json = {{"id", part.id},
                 {"rank", part.rank},
                 {"worker", part.worker},
                 {"vertices", part.result.vertices},
                 {"tets", part.result.tets},
                 {"volume", part.result.laws.volume},
                 {"surface_vertices", part.surface_vertices},
                 {"surface_faces", part.surface_facets},
                 {"surface_volume", part.surface_volume},
                 {"load", part.load},
                 {"interface_area", part.interface_area},
                 {"neighbours", part.neighbours},
                 {"mesher", part.result.mesher.empty() ? wanted_mesher : part.result.mesher},
                 {"attempts", part.attempts},
                 {"seconds", part.seconds},
                 {"load_seconds", part.result.load_seconds},
                 {"mesh_seconds", part.result.mesh_seconds},
                 {"verify_seconds", part.result.verify_seconds},
                 {"store_seconds", part.result.store_seconds},
                 {"peak_rss_bytes", part.result.peak_rss_bytes}};
    if (!part.failures.empty()) json["failures"] = part.failures;
    if (!part.remedy.empty()) json["remedy"] = part.remedy;
    if (!part.result.way.empty()) json["way"] = part.result.way;
    if (part.result.core_tets) json["core_tets"] = part.result.core_tets;
    if (part.result.angles.known())
        json["improvement"] =
            improvement_json(part.result.improvement, part.result.angles, part.result.improve_seconds);
    if (!part.interruption.empty()) json["interruption"] = part.interruption;
    if (part.timed_out)
        json["note"] = "An attempt ran out of time, so the bytes may differ from those of an undisturbed run.";
    if (part.resumed) json["resumed"] = true;
    if (part.result.code) json["error"] = part.result.message;
    return json;
}

Json parts_json(const RunReport& report) {
    Json json = Json::array();
    for (const PartReport& part : report.parts) json.push_back(part_json(part, report.options.mesher.name));
    return json;
}

Json totals_json(const RunReport& report) {
    double interface_area = 0;
    for (const TreeNode& node : report.nodes) interface_area += node.interface_area;
    double volume = 0;
    for (const PartReport& part : report.parts)
        volume += report.options.volume ? part.result.laws.volume : part.surface_volume;
    return {{"vertices", report.vertices},
            {"tets", report.tets},
            {"volume", volume},
            {"interface_area", interface_area},
            {"split_facets", report.split_facets},
            {"read_seconds", report.seconds.read},
            {"decompose_seconds", report.seconds.decompose},
            {"prepare_seconds", report.seconds.prepare},
            {"mesh_seconds", report.seconds.mesh},
            {"mesher_seconds", report.worker_seconds.mesher},
            {"verify_seconds", report.worker_seconds.verify},
            {"store_seconds", report.worker_seconds.store},
            {"start_seconds", report.worker_seconds.start},
            {"idle_seconds", report.worker_seconds.idle},
            {"write_seconds", report.seconds.write},
            {"hash_seconds", report.seconds.hash},
            {"wall_seconds", report.seconds.wall},
            {"imbalance", report.imbalance},
            {"peak_rss_bytes", report.peak_rss_bytes}};
}

ImprovedAngles angles_of(const RunReport& report) { return {report.improvement, report.quality}; }

Json ratios_json(const RatioCounts& ratios) {
    return {{"edges", ratios.count()},       {"share_obeyed", ratios.share_obeyed()}, {"p1", ratios.percentile(0.01)},
            {"p10", ratios.percentile(0.1)}, {"median", ratios.percentile(0.5)},      {"p90", ratios.percentile(0.9)},
            {"p99", ratios.percentile(0.99)}};
}

// Length got over length asked.
Json sizes_json(const RunReport& report) {
    const SizeRatios& ratios = report.sizes;
    if (ratios.empty()) return nullptr;
    Json patches = Json::object();
    for (const auto& [patch, edges] : ratios.by_patch)
        patches[report.input->patch_names[static_cast<std::size_t>(patch)]] = ratios_json(edges);
    return {{"inside", ratios_json(ratios.inside)},
            {"interfaces", ratios.interfaces.count() > 0 ? ratios_json(ratios.interfaces) : Json()},
            {"patches", patches}};
}

Json reference_json(const RunReport& report) {
    if (!report.reference) return nullptr;
    const PartResult& whole = report.reference->outcome.result;
    if (whole.code) return {{"error", whole.message}};
    return {{"vertices", whole.vertices},
            {"tets", whole.tets},
            {"seconds", report.reference->outcome.seconds},
            {"peak_rss_bytes", whole.peak_rss_bytes},
            {"quality", quality_json(whole.quality.all)}};
}

Json file_json(const RunFile& file) { return {{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}}; }

template <class T>
Json array_of(const std::vector<T>& items, Json (*convert)(const T&)) {
    Json json = Json::array();
    for (const T& item : items) json.push_back(convert(item));
    return json;
}

std::string rungs_text(const std::vector<TreeNode>& nodes) {
    std::vector<int> counts(static_cast<std::size_t>(Rung::whole) + 1, 0);
    int cuts = 0;
    for (const TreeNode& node : nodes)
        if (node.cut_tried) {
            ++counts[static_cast<int>(node.rung)];
            ++cuts;
        }
    std::string text = fmt::format("{} cut{}", cuts, cuts == 1 ? "" : "s");
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i]) text += fmt::format(", {} {}", counts[i], in_words(name(static_cast<Rung>(i))));
    return text;
}

}  // namespace

bool RunVerification::all_hold() const {
    return volume_rel_error <= volume_rel_bound && input_faces_missing == 0 && extra_boundary_faces == 0 &&
           unmatched_interface_faces == 0 && inverted_tets == 0 && tets_zero_parts == 0;
}

std::string to_json(const RunReport& report) {
    const RunVerification& v = report.verification;
    Json json = {{"schema", 1},
                 {"kerf", version},
                 {"input", input_json(*report.input)},
                 {"options", options_json(report.options)},
                 {"tree", array_of(report.nodes, node_json)},
                 {"parts", parts_json(report)},
                 {"totals", totals_json(report)},
                 {"quality", quality_json(report.quality)},
                 {"improvement", improvement_json(report.improvement, angles_of(report), report.improve_seconds)},
                 {"sizes", sizes_json(report)},
                 {"verification",
                  {{"passed", v.passed},
                   {"volume_rel_error", v.volume_rel_error},
                   {"volume_rel_bound", v.volume_rel_bound},
                   {"input_faces_missing", v.input_faces_missing},
                   {"extra_boundary_faces", v.extra_boundary_faces},
                   {"unmatched_interface_faces", v.unmatched_interface_faces},
                   {"inverted_tets", v.inverted_tets},
                   {"tets_zero_parts", v.tets_zero_parts}}},
                 {"reference", reference_json(report)},
                 {"mesh_hash", report.mesh_hash},
                 {"files", array_of(report.files, file_json)},
                 {"exit_code", report.exit_code}};
    return sealed(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

// What was done to the surface, without the welding of equal vertices.
std::string repairs_text(const Input& input) {
    const InputRepairs& r = input.repairs;
    std::string text;
    const auto add = [&](std::int64_t count, const char* what) {
        if (count) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), what);
    };
    add(r.dropped_facets, "superfluous facets dropped");
    add(input.orientation.facets_flipped, "facets turned");
    add(input.orientation.shells_flipped, "shells turned");
    add(r.merged_vertices, "vertices merged");
    add(r.removed_facets, "facets of smaller components removed");
    add(r.filled_holes, "holes filled");
    return text;
}

// "part 13: tolerance 1e-06; part 14: another order of the vertices; and 2 more".
std::string remedies_text(const RunReport& report) {
    constexpr std::size_t limit = 3;
    std::vector<std::string> all;
    for (const PartReport& part : report.parts)
        if (part.result.code == 0 && !part.remedy.empty())
            all.push_back(fmt::format("part {}: {}", part.id, part.remedy));
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(limit, all.size()));
    const std::string more = all.size() > limit ? fmt::format("; and {} more", all.size() - limit) : "";
    return fmt::format("{}{}", fmt::join(all.begin(), end, "; "), more);
}

// What was repeated because workers were killed, and what may be otherwise because they were too slow.
std::string disturbances_text(const RunReport& report) {
    const auto count = [&](auto is_so) { return std::count_if(report.parts.begin(), report.parts.end(), is_so); };
    const auto killed = count([](const PartReport& part) { return !part.interruption.empty(); });
    const auto late = count([](const PartReport& part) { return part.timed_out; });
    std::string text;
    if (killed > 0) text = fmt::format("{} part{} again after the worker was killed", killed, killed == 1 ? "" : "s");
    if (late > 0)
        text += fmt::format("{}{} part{} after a time-out, whose bytes may differ from an undisturbed run",
                            text.empty() ? "" : "; ", late, late == 1 ? "" : "s");
    return text;
}

// The whole in one piece beside the parts.
std::string reference_text(const RunReport& report) {
    const PartOutcome& whole = report.reference->outcome;
    if (whole.result.code) return "the whole could not be meshed in one piece: " + whole.result.message;
    const Distribution& dihedral = whole.result.quality.all.measures[0];
    return fmt::format("{} tetrahedra in one piece in {:.2f} s; dihedral min {:.1f}, 1 % {:.1f}, median {:.1f} deg",
                       grouped(whole.result.tets), whole.seconds, dihedral.min(), dihedral.percentile(0.01),
                       dihedral.percentile(0.5));
}

std::string improvement_text(const RunReport& report) {
    const ImprovedAngles angles = angles_of(report);
    return fmt::format("dihedral 1 % {:.1f} -> {:.1f}, min {:.1f} -> {:.1f} deg; {:.2f} s in all workers",
                       angles.p1_before_deg, angles.p1_after_deg, angles.min_before_deg, angles.min_after_deg,
                       report.improve_seconds);
}

// Where the seconds went.
std::string time_text(const RunReport& report) {
    const StageSeconds& s = report.seconds;
    std::string text = fmt::format("{:.2f} s: read {:.2f}, decompose {:.2f}", s.wall, s.read, s.decompose);
    if (!report.options.volume) return text;
    const WorkerSeconds& w = report.worker_seconds;
    return text + fmt::format(
                      ", prepare {:.2f}, mesh {:.2f} (mesher {:.2f}, verify {:.2f}, store {:.2f}, start {:.2f}, "
                      "idle {:.2f}), write {:.2f}, hash {:.2f}",
                      s.prepare, s.mesh, w.mesher, w.verify, w.store, w.start, w.idle, s.write, s.hash);
}

std::string remeshing_text(const InputRemeshing& done) {
    return fmt::format(
        "from {} facets; smallest angle {:.3g} deg from {:.3g}; largest distances {:.2g} and {:.2g} of "
        "{:.2g}",
        grouped(done.facets_before), done.smallest_angle_deg, done.smallest_angle_before_deg, done.distance_to_input,
        done.distance_from_input, done.deviation);
}

namespace {

// Of all cuts together.
struct InterfaceTotals {
    double section_area = 0, area = 0, angle_deg = 180;
};

InterfaceTotals interface_totals(const std::vector<TreeNode>& nodes) {
    InterfaceTotals totals;
    for (const TreeNode& node : nodes) {
        totals.section_area += node.section_area;
        totals.area += node.interface_area;
        if (node.cut_made) totals.angle_deg = std::min(totals.angle_deg, node.quality.angle_deg);
    }
    return totals;
}

class ReportLines {
 public:
    void add(const char* label, const std::string& value) {
        if (!value.empty()) text_ += fmt::format("{:<11} {}\n", label, value);
    }
    const std::string& text() const { return text_; }

 private:
    std::string text_;
};

void add_input(ReportLines& lines, const RunReport& report, bool all) {
    const Input& input = *report.input;
    if (all)
        lines.add("input",
                  fmt::format("{}: {} facets, {} shell{}, genus {}, volume {:.6g}", input.path, grouped(input.facets),
                              input.components, input.components == 1 ? "" : "s", input.genus, input.volume));
    lines.add("repaired", repairs_text(input));
    for (const std::string& note : input.notes) lines.add("note", note);
    if (input.moved_vertices > 0)
        lines.add("optimised", fmt::format("{} vertices moved by {:.3g} at most", grouped(input.moved_vertices),
                                           input.largest_move));
    if (input.remeshed) lines.add("remeshed", remeshing_text(*input.remeshed));
}

void add_cuts(ReportLines& lines, const RunReport& report) {
    lines.add("parts", fmt::format("{} of {} wanted; {}", report.parts.size(), report.options.decompose.parts,
                                   rungs_text(report.nodes)));
    if (report.split_facets > 0)
        lines.add("split", fmt::format("{} facets, where no contour of edges exists (--surface keep forbids it)",
                                       grouped(report.split_facets)));
    const InterfaceTotals totals = interface_totals(report.nodes);
    if (totals.section_area > 0)
        lines.add("interfaces", fmt::format("area {:.6g}, {:.3f} of the plane sections; smallest angle {:.1f} deg",
                                            totals.area, totals.area / totals.section_area, totals.angle_deg));
}

void add_way(ReportLines& lines, const RunReport& report) {
    lines.add("retried", remedies_text(report));
    lines.add("disturbed", disturbances_text(report));
    const auto resumed = std::count_if(report.parts.begin(), report.parts.end(), std::mem_fn(&PartReport::resumed));
    if (resumed > 0) lines.add("continued", fmt::format("{} parts were finished by an interrupted run", resumed));
}

void add_mesh(ReportLines& lines, const RunReport& report, bool all) {
    const std::string parts =
        all ? "" : fmt::format(", {} part{}", report.parts.size(), report.parts.size() == 1 ? "" : "s");
    lines.add("mesh",
              fmt::format("{} tetrahedra, {} vertices{}", grouped(report.tets), grouped(report.vertices), parts));
    if (all && !report.improvement.is_empty()) lines.add("improved", improvement_text(report));
    if (all && !report.sizes.empty())
        lines.add("sizes",
                  size_text(report.sizes, report.input->patch_names, !report.options.mesher.size.is_constant()));
    const Distribution& dihedral = report.quality.all.measures[0];
    const Distribution& ratio = report.quality.all.measures[2];
    lines.add("quality", fmt::format("dihedral min {:.1f}, 1 % {:.1f}, median {:.1f} deg; radius-edge max {:.2f}",
                                     dihedral.min(), dihedral.percentile(0.01), dihedral.percentile(0.5), ratio.max()));
}

std::string ranks_text(const RunReport& report) {
    return fmt::format("{} rank{} x {} worker{}", report.ranks, report.ranks == 1 ? "" : "s", report.options.workers,
                       report.options.workers == 1 ? "" : "s");
}

std::string processes_text(const RunReport& report) {
    return fmt::format("{}, imbalance {:.2f}, peak memory {} MB", ranks_text(report), report.imbalance,
                       report.peak_rss_bytes >> 20);
}

}  // namespace

std::string to_text(const RunReport& report, ReportDetail detail) {
    const bool all = detail == ReportDetail::all, meshed = report.options.volume;
    ReportLines lines;
    add_input(lines, report, all);
    if (all || !meshed) add_cuts(lines, report);
    add_way(lines, report);
    if (meshed) add_mesh(lines, report, all);
    if (report.reference) lines.add("reference", reference_text(report));
    lines.add("time", all ? time_text(report) : fmt::format("{:.2f} s on {}", report.seconds.wall, ranks_text(report)));
    if (all) lines.add("processes", processes_text(report));
    lines.add("verified",
              fmt::format("{}; volume error {:.1e}", report.verification.passed ? "yes, every law holds" : "NO",
                          report.verification.volume_rel_error));
    if (all) lines.add("mesh hash", report.mesh_hash);
    return lines.text();
}

}  // namespace kerf
