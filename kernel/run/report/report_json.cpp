// A report as JSON. Seconds and bytes are the only values that differ between two runs of the same options. Numbers of
// nodes and parts that only describe are written with six digits, so that the report of thousands of parts can be read.
#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "base/core/version.h"
#include "files/io/json_rows.h"
#include "files/io/path_text.h"
#include "files/quality/quality_json.h"
#include "run/report/cut_json.h"
#include "run/report/inside/exceeded_bounds.h"
#include "run/report/inside/recovery_json.h"
#include "run/report/inside/sharp_places.h"
#include "run/report/repair_json.h"
#include "run/report/report.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json in_six_digits(const Vec3& v) { return {to_six_digits(v.x()), to_six_digits(v.y()), to_six_digits(v.z())}; }

Json rows_in_six_digits(const Eigen::Matrix3d& m) {
    Json json = Json::array();
    for (int i = 0; i < 3; ++i) json.push_back(in_six_digits(m.row(i).transpose()));
    return json;
}

Json columns(const Eigen::Matrix3d& m) {
    Json json = Json::array();
    for (int i = 0; i < 3; ++i) json.push_back(to_json(Vec3(m.col(i))));
    return json;
}

Json json_of_box(const Box& box) {
    Json corners = Json::array();
    for (const Vec3& corner : {box.min(), box.max()}) corners.push_back({corner.x(), corner.y(), corner.z()});
    return corners;
}

Json air_json(const Enclosure& enclosure) {
    Json json = {{"box", json_of_box(enclosure.box)},
                 {"bodies", json_of_box(enclosure.bodies)},
                 {"volume_of_bodies", enclosure.body_volume},
                 {"edge", enclosure.edge}};
    if (enclosure.wake) json["wake"] = {{"box", json_of_box(*enclosure.wake)}, {"edge", enclosure.wake_edge}};
    return json;
}

Json input_json(const Input& input) {
    Json json = {{"path", path_text(std::filesystem::absolute(input.path).lexically_normal().string())},
                 {"hash", input.file_hash},
                 {"vertices", input.vertices},
                 {"faces", input.facets},
                 {"faces_of_file", facets_of_file(input)},
                 {"components", input.components},
                 {"genus", input.genus},
                 {"volume", input.volume},
                 {"volume_of_file", volume_before_remeshing(input)},
                 {"area", input.area},
                 {"repairs", json_of_counts(input.tidied, input.ladder)}};
    json["repairs"]["facets_flipped"] = input.orientation.facets_flipped;
    json["repairs"]["shells_flipped"] = input.orientation.shells_flipped;
    for (const std::string& name : input.patch_names) json["patches"].push_back(path_text(name));
    for (const RegionIndex r : input.regions.ids()) {
        const InputRegion& region = input.regions[r];
        json["regions"].push_back(
            {{"name", path_text(input.complex.region_names()[r.value()])},
             {"faces", region.facets},
             {"components", region.components},
             {"volume", region.volume},
             {"volume_of_file", input.remeshed ? input.remeshed->volumes_before[r] : region.volume},
             {"area", region.area}});
    }
    if (!input.ladder.steps.empty()) json["repair"] = json_of_repair(input.ladder);
    if (!input.notes.empty()) json["notes"] = input.notes;
    if (input.moved_vertices > 0)
        json["optimisation"] = {{"vertices_moved", input.moved_vertices}, {"largest_move", input.largest_move}};
    if (input.wrapped)
        json["wrap"] = {{"gap", input.wrapped->gap},
                        {"offset", input.wrapped->offset},
                        {"facets_before", input.wrapped->facets_before},
                        {"facets_left_out", input.wrapped->left_out},
                        {"facets_visible", input.wrapped->seen},
                        {"facets", input.wrapped->facets},
                        {"distance_to_input", input.wrapped->distance_to_input},
                        {"distance_from_visible_input", input.wrapped->distance_from_input}};
    if (input.enclosure) json["air"] = air_json(*input.enclosure);
    if (input.remeshed)
        json["remeshing"] = {{"facets_before", input.remeshed->facets_before},
                             {"facets_kept", input.remeshed->facets_kept},
                             {"only_divided", input.remeshed->only_divided},
                             {"smallest_angle_before_deg", input.remeshed->angles_before.smallest},
                             {"smallest_angle_deg", input.remeshed->angles.smallest},
                             {"angle_1_percent_before_deg", input.remeshed->angles_before.first_percent},
                             {"angle_1_percent_deg", input.remeshed->angles.first_percent},
                             {"deviation", input.remeshed->deviation},
                             {"distance_to_input", input.remeshed->distance_to_input},
                             {"distance_from_input", input.remeshed->distance_from_input},
                             {"feature_edges", input.remeshed->feature_edges},
                             {"finer_share", input.remeshed->finer.sum()},
                             {"finer_by",
                              {{"deviation", input.remeshed->finer.bound},
                               {"features", input.remeshed->finer.features},
                               {"walls", input.remeshed->finer.walls}}},
                             {"facets_by",
                              {{"size", input.remeshed->facets_by.asked},
                               {"deviation", input.remeshed->facets_by.bound},
                               {"features", input.remeshed->facets_by.features},
                               {"walls", input.remeshed->facets_by.walls}}}};
    return json;
}

Json options_json(RunRequest request) {
    Json json = Json::object();
    for (const OptionField& field : option_fields(request))
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
                 {"parent", parent_of(node.id)},
                 {"children", node.is_divided() ? Json(halves_of(node.id)) : Json::array()},
                 {"level", level_of(node.id)},
                 {"leaves", node.leaves},
                 {"vertices", node.vertices},
                 {"faces", node.facets},
                 {"volume", node.mass.volume},
                 {"centroid", to_json(node.mass.centroid)},
                 {"inertia", rows_in_six_digits(node.mass.inertia)},
                 {"eigenvalues", in_six_digits(node.mass.eigenvalues)},
                 {"axes", columns(node.mass.axes)}};
    if (node.regions > 1) json["regions"] = node.regions;
    if (node.cut_tried) json["cut"] = json_of_cut(node);
    return json;
}

// The improvement. Its gain a second is that of the angle below which a hundredth of the cells lies.
Json improvement_json(const Improvement& done, const ImprovedAngles& angles, double seconds) {
    if (!angles.known()) return nullptr;
    const double gain = angles.p1_after_deg - angles.p1_before_deg;
    return {{"removed_edges", done.removed_edges},
            {"moved_vertices", done.moved_vertices},
            {"new_vertices", done.new_vertices},
            {"bad_cells_before", done.bad_cells_before},
            {"bad_cells_after", done.bad_cells_after},
            {"min_dihedral_deg_before", to_six_digits(angles.min_before_deg)},
            {"min_dihedral_deg_after", to_six_digits(angles.min_after_deg)},
            {"p1_dihedral_deg_before", to_six_digits(angles.p1_before_deg)},
            {"p1_dihedral_deg_after", to_six_digits(angles.p1_after_deg)},
            {"seconds", to_six_digits(seconds)},
            {"p1_dihedral_deg_per_second", seconds > 0 ? to_six_digits(gain / seconds) : 0}};
}

Json part_json(const PartReport& part, const std::string& wanted_mesher) {
    Json json = {
        {"id", part.id},
        {"rank", part.rank},
        {"worker", part.worker},
        {"vertices", part.result.vertices},
        {"nodes", std::max(part.mesh_nodes, part.result.vertices)},
        {"tets", part.result.tets},
        {"min_dihedral_deg", part.result.tets > 0 ? Json(to_six_digits(part.result.worst.smallest_deg)) : Json()},
        {"volume", part.result.laws.volume},
        {"surface_vertices", part.surface_vertices},
        {"surface_faces", part.surface_facets},
        {"surface_volume", part.surface_volume},
        {"load", to_six_digits(part.load)},
        {"interface_area", part.interface_area},
        {"neighbours", part.neighbours},
        {"mesher", part.result.mesher.empty() ? wanted_mesher : part.result.mesher},
        {"attempts", part.attempts},
        {"seconds", to_six_digits(part.seconds)},
        {"load_seconds", to_six_digits(part.result.load_seconds)},
        {"mesh_seconds", to_six_digits(part.result.mesh_seconds)},
        {"verify_seconds", to_six_digits(part.result.verify_seconds)},
        {"store_seconds", to_six_digits(part.result.store_seconds)},
        {"peak_rss_bytes", part.result.peak_rss_bytes}};
    if (!part.failures.empty()) json["failures"] = part.failures;
    add_way(part, json);
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
    for (const PartReport& part : report.parts) {
        json.push_back(part_json(part, report.request.mesher.name));
        if (!report.input.regions.empty()) json.back()["region"] = part.region.value();
    }
    return json;
}

Json totals_json(const RunReport& report) {
    double interface_area = 0;
    for (const TreeNode& node : report.cut.nodes) interface_area += node.interface_area;
    double volume = 0;
    for (const PartReport& part : report.parts)
        volume += report.request.volume ? part.result.laws.volume : part.surface_volume;
    return {{"vertices", report.mesh.vertices},
            {"order", report.request.order},
            {"nodes", std::max(report.mesh.nodes, report.mesh.vertices)},
            {"curved_nodes", report.mesh.curved_nodes},
            {"tets", report.mesh.tets},
            {"volume", volume},
            {"interface_area", interface_area},
            {"split_facets", report.cut.split_facets},
            {"parts_by_way", report.mesh.parts_by_way},
            {"parts_by_tetgen", report.mesh.parts_by_tetgen},
            {"recovery", json_of_recovery(report.mesh.recovery)},
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

Json ratios_json(const RatioCounts& ratios) {
    return {{"edges", ratios.count()},       {"share_obeyed", ratios.share_obeyed()}, {"p1", ratios.percentile(0.01)},
            {"p10", ratios.percentile(0.1)}, {"median", ratios.percentile(0.5)},      {"p90", ratios.percentile(0.9)},
            {"p99", ratios.percentile(0.99)}};
}

// The ratios of lengths that edges have to lengths that were asked for.
Json sizes_json(const RunReport& report) {
    const SizeRatios& ratios = report.mesh.sizes;
    if (ratios.empty()) return nullptr;
    Json patches = Json::object();
    for (const auto& [patch, edges] : ratios.by_patch) patches[report.input.patch_names[patch]] = ratios_json(edges);
    Json json = {{"mean", ratios.mean()},
                 {"inside", ratios_json(ratios.inside)},
                 {"interfaces", ratios.interfaces.count() > 0 ? ratios_json(ratios.interfaces) : Json()},
                 {"patches", patches}};
    if (const SizeOptions& wanted = report.request.sizes; wanted.meaning == SizeMeaning::bound)
        json["share_beyond_bound"] = ratios.share_from(1 / wanted.mean_over_size());
    const std::vector<std::string> solids = report.size.solids();
    for (std::size_t i = 0; i < std::min(solids.size(), ratios.cells_in_solids.size()); ++i)
        json["solids"].push_back({{"solid", solids[i]}, {"tets", ratios.cells_in_solids[i]}});
    return json;
}

Json bounds_json(const RunReport& report) {
    Json json = Json::array();
    for (const ExceededBound& each : exceeded_bounds(report))
        json.push_back(
            {{"option", each.option}, {"bound", each.bound}, {"tets", each.cells}, {"largest", each.largest}});
    return json;
}

Json cells_json(const RunReport& report) {
    if (!report.found_size) return nullptr;
    const FoundSize& found = *report.found_size;
    return {{"asked", found.cells},
            {"size", found.size > 0 ? Json(found.size) : Json()},
            {"forecast", std::llround(found.tets)},
            {"remeshings", found.remeshings}};
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

Json curve_json(const CurveReport& curve, double seconds) {
    return {{"surface_edges", curve.surface_edges},
            {"curved_edges", curve.curved_edges},
            {"straightened_edges", curve.straightened_edges},
            {"moved_nodes", curve.moved_nodes},
            {"curved_cells", curve.curved_cells},
            {"worst_scaled_jacobian", curve.worst_scaled_jacobian},
            {"volume_gain", curve.volume_gain},
            {"seconds", seconds}};
}

Json sharp_json(const RunReport& report) {
    Json places = Json::array();
    std::int64_t cells = 0;
    for (const SharpPlace& place : sharp_places(report)) {
        cells += place.cells.count;
        Json json = {{"cause", name_of(place.cause)},
                     {"tets", place.cells.count},
                     {"min_dihedral_deg", place.cells.angle_deg},
                     {"point", to_json(place.cells.place)},
                     {"part", place.part}};
        if (!place.region.empty()) json["region"] = path_text(place.region);
        if (!place.patch.empty()) json["patch"] = path_text(place.patch);
        if (place.cells.measure > 0) json["measure"] = place.cells.measure;
        json["why"] = path_text(why(place));
        json["way_out"] = place.way_out;
        places.push_back(std::move(json));
    }
    return {{"below_deg", WorstCells::bound_deg}, {"tets", cells}, {"places", places}};
}

Json notes_json(const RunReport& report) {
    Json json = Json::array();
    for (const std::string& note : notes_of(report)) json.push_back(path_text(note));
    return json;
}

Json file_json(const RunFile& file) { return {{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}}; }

template <class T>
Json array_of(const std::vector<T>& items, Json (*convert)(const T&)) {
    Json json = Json::array();
    for (const T& item : items) json.push_back(convert(item));
    return json;
}

Json verification_json(const RunVerification& laws) {
    Json json = {{"passed", laws.passed},
                 {"volume_rel_error", laws.volume_rel_error},
                 {"volume_rel_bound", laws.volume_rel_bound}};
    for (const RunLaw& law : run_laws)
        if (!law.is_of_files) json[law.name] = laws.*law.count;
    return json;
}

}  // namespace

std::string to_json(const RunReport& report) {
    Json json = {
        {"schema", 1},
        {"kerf", version},
        {"input", input_json(report.input)},
        {"options", options_json(report.request)},
        {"tree", array_of(report.cut.nodes, node_json)},
        {"parts", parts_json(report)},
        {"totals", totals_json(report)},
        {"quality", quality_json(report.mesh.quality)},
        {"forced", forced_json(report.mesh.quality.angles)},
        {"sharp", sharp_json(report)},
        {"bounds", bounds_json(report)},
        {"notes", notes_json(report)},
        {"improvement", improvement_json(report.mesh.improvement, {report.mesh.improvement, report.mesh.quality},
                                         report.mesh.improve_seconds)},
        {"cells", cells_json(report)},
        {"sizes", sizes_json(report)},
        {"verification", verification_json(report.verification)},
        {"reference", reference_json(report)},
        {"mesh_hash", report.mesh.hash},
        {"files", array_of(report.folder.files, file_json)},
        {"exit_code", report.exit_code}};
    if (report.curve) json["curve"] = curve_json(*report.curve, report.seconds.curve);
    return sealed(text_with_rows(json));
}

}  // namespace kerf
