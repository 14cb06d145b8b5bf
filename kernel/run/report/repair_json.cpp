// Each function makes the object that its declaration lists, key by key, from the values of reports. Preparations are
// told as sums among the counts of what goes from every surface, all other steps one by one with the places of their
// actions. What is not known, as a distance that could not be proven, is null.
#include "run/report/repair_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "files/io/json.h"
#include "files/io/path_text.h"
#include "run/report/repair_text.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

Json json_of_action(const RepairAction& action) {
    const bool is_measured = *action.measure != '\0', is_refused = *action.refused_because != '\0';
    Json places = Json::array();
    for (const RepairPlace& place : action.places) {
        Json& json = places.emplace_back(
            Json{{"where", {place.where.x(), place.where.y(), place.where.z()}}, {"facets", place.facets}});
        if (is_measured) json["value"] = place.measure;
    }
    Json json = {{"what", action.many}, {"count", action.count}, {"done", !is_refused}};
    if (is_refused) json["refused_because"] = action.refused_because;
    if (is_measured) json["measure"] = action.measure;
    json["places"] = std::move(places);
    return json;
}

Json json_of_measures(const SoupMeasures& measures) {
    return {{"faces", measures.facets},
            {"area", measures.area},
            {"volume", measures.volume ? Json(*measures.volume) : Json(nullptr)}};
}

// The distance, or null where none could be proven.
Json distance_json(double distance) { return std::isfinite(distance) ? Json(distance) : Json(nullptr); }

}  // namespace

nlohmann::ordered_json json_of_repair(const RepairReport& report) {
    Json steps = Json::array();
    for (const StepReport& step : report.steps) {
        Json actions = Json::array();
        for (const RepairAction& action : step.actions) actions.push_back(json_of_action(action));
        steps.push_back({{"step", name(step.kind)}, {"largest_move", step.largest_move}, {"actions", actions}});
    }
    return {{"bound", report.bound},
            {"diagonal", report.diagonal},
            {"largest_move", report.largest_move()},
            {"steps", std::move(steps)}};
}

nlohmann::ordered_json json_of_counts(const TidyCounts& tidied, const RepairReport& ladder) {
    return {{"vertices_welded", tidied.welded_vertices},
            {"vertices_unused", tidied.unused_vertices},
            {"facets_dropped", tidied.dropped_facets},
            {"vertices_merged", ladder.done_by(RepairKind::merge)},
            {"facets_removed", ladder.done_by(RepairKind::largest)},
            {"holes_filled", ladder.done_by(RepairKind::span)},
            {"facets_added", ladder.preparation(RepairKind::span).added_facets}};
}

std::string to_json(const RepairReport& report) { return json_text(json_of_repair(report)) + "\n"; }

nlohmann::ordered_json json_of_remedy(const Remedy& remedy, const std::string& path) {
    const InputOptions& options = remedy.options;
    return {{"repair", options.wrap ? Json(nullptr) : Json(options.repairs.plan)},
            {"tried", remedy.was_tried},
            {"largest_move", remedy.largest_move},
            {"wrap_distance", remedy.wrap_distance},
            {"voids", options.voids == Voids::parity ? Json("parity") : Json(nullptr)},
            {"caps", remedy.caps},
            {"losses", remedy.losses},
            {"command", path_text(command_of(remedy, path))}};
}

std::string to_json(const RepairedFile& repaired) {
    const CheckedSoup& checked = repaired.checked;
    const RepairMeasures& measures = repaired.measures;
    Json counts = Json::object();
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (const std::int64_t n = checked.diagnosis.counts[k]) counts[name(static_cast<DefectKind>(k))] = n;
    Json json = {{"input", path_text(repaired.input)},
                 {"output", path_text(repaired.output)},
                 {"can_be_meshed", repaired.can_be_meshed},
                 {"unchanged", repaired.is_unchanged},
                 {"copied", repaired.is_copy},
                 {"repair", json_of_repair(checked.ladder)},
                 {"before", json_of_measures(measures.before)},
                 {"after", json_of_measures(measures.after)},
                 {"faces_changed", measures.changed_facets},
                 {"faces_added", measures.added_facets},
                 {"faces_lost", measures.lost_facets},
                 {"distance_of_changed", distance_json(measures.distance_of_changed)},
                 {"distance_of_added", distance_json(measures.distance_of_added)},
                 {"counts", std::move(counts)}};
    if (repaired.remedy) json["remedy"] = json_of_remedy(*repaired.remedy, repaired.input);
    return json_text(json, 2) + "\n";
}

}  // namespace kerf
